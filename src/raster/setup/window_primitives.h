// Primitives in the window, ready for the tiles: integer positions and depths, and where their vertices' values are.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "src/raster/surface/raw_vector.h"

namespace ninebit {

// `pixel` is a triangle that draws a single pixel, whose depth has already been found.
enum class SetupKind : std::uint8_t { triangle, line, point, pixel };

// Pixels that a primitive may draw, both ends included, among those that may be drawn at all.
struct PixelBounds {
  std::int16_t left = 0;
  std::int16_t bottom = 0;
  std::int16_t right = 0;
  std::int16_t top = 0;
  [[nodiscard]] bool empty() const { return left > right || bottom > top; }
};

inline constexpr std::uint32_t kNoWeights = 0xFFFFFFFF;

// Window positions of three corners in 1/16 pixel (less with fewer subpixel bits, scaled up), of 20 bits each: a
// corner's word has its x above the low part of its y, the last word the high parts of all y.
struct PackedPositions {
  static constexpr int kLow = 12, kHigh = 8;  // bits of y
  std::array<std::uint32_t, 4> word{};

  [[nodiscard]] std::int32_t x(std::size_t i) const { return static_cast<std::int32_t>(word[i]) >> kLow; }
  [[nodiscard]] std::int32_t y(std::size_t i) const {
    const std::uint32_t high = word[3] << (24 - kHigh * i), low = word[i] << (32 - kLow) >> kHigh;
    return static_cast<std::int32_t>((high & 0xFF000000U) | low) >> (32 - kLow - kHigh);
  }
  // Sets a corner whose position has not been set before.
  void set(std::size_t i, std::int32_t x, std::int32_t y) {
    word[i] = (static_cast<std::uint32_t>(x) << kLow) | (static_cast<std::uint32_t>(y) & ((1U << kLow) - 1));
    word[3] |= ((static_cast<std::uint32_t>(y) >> kLow) & 0xFF) << (kHigh * i);
  }
};

// Offsets have this many fraction bits below window depth; all of them are 0 where the profile rounds offsets.
inline constexpr int kOffsetBits = 16;

// An offset as primitives hold it: the depth on a primitive is `whole` + floor(plane + fraction / 2^kOffsetBits). The
// half that rounds depths to nearest is part of the fraction (rules 20 and 28). Where depths are real numbers, `whole`
// has the bits of a float, which is added to them.
struct SetupOffset {
  std::int32_t whole = 0;
  std::uint16_t fraction = 0;
  constexpr SetupOffset() = default;
  constexpr SetupOffset(std::int64_t offset_q16, bool cuts) {
    const std::int64_t sum = offset_q16 + (cuts ? 0 : (1 << kOffsetBits) / 2);
    whole = static_cast<std::int32_t>(sum >> kOffsetBits);
    fraction = static_cast<std::uint16_t>(sum & ((1 << kOffsetBits) - 1));
  }
  constexpr explicit SetupOffset(float number) : whole(std::bit_cast<std::int32_t>(number)) {}
};

// A triangle (counter-clockwise in the window, y up), a line from its first corner to its second, or a point. Bounds
// that the integer arithmetic relies on: positions lie within 8,192 pixels of the viewport's centre, so differences of
// positions stay within 2^18 sixteenths of a pixel, edge functions, areas and squared lengths within 2^37, and these ×
// window depth within 2^61.
//
// Large meshes are read from memory, so it is packed into three quarters of a cache line.
struct alignas(16) SetupPrimitive {
  PixelBounds box;          // of a `pixel`: that pixel
  std::uint32_t primitive;  // number of the GL primitive in the draw call
  SetupKind kind;
  bool front_facing;
  std::uint16_t fraction;            // of SetupOffset
  std::array<std::uint32_t, 3> z24;  // WindowDepth::corner_of(); of a `pixel` three times the depth there
  std::int32_t offset_z24;           // SetupOffset::whole
  PackedPositions position;          // of a wide line of diamonds: moved to its lowest line; of a point its centre

  void set(const SetupOffset& offset) {
    offset_z24 = offset.whole;
    fraction = offset.fraction;
  }
  // The fraction, rounded down, of `parts`, into which the primitive's plane divides a whole number; at most 2^38.
  [[nodiscard]] std::int64_t fraction_of(std::int64_t parts) const { return (parts * fraction) >> kOffsetBits; }
  [[nodiscard]] std::array<std::int32_t, 3> x_q4() const { return {position.x(0), position.x(1), position.x(2)}; }
  [[nodiscard]] std::array<std::int32_t, 3> y_q4() const { return {position.y(0), position.y(1), position.y(2)}; }
};
static_assert(sizeof(SetupPrimitive) == 48);

// Further values of a primitive's corners, for its fragments.
struct alignas(32) SetupCorners {
  std::array<float, 3> inv_w;
  std::uint32_t weights;                // index into SetupBlock::weights, or kNoWeights: not clipped
  std::array<std::uint32_t, 3> vertex;  // numbers of the vertices before clipping; all three are valid in any kind
  std::array<std::uint8_t, 3> corner;   // which of `vertex` each corner is (clipped ones: see weights)
};

// One block of a draw call's primitives after setup, in order.
struct SetupBlock {
  RawVector<SetupPrimitive> primitives;
  RawVector<SetupCorners> corners;  // of each primitive; none where SetupContext does not need them
  // For each that was clipped, its corners in barycentric coordinates of `vertex` (column = corner).
  std::vector<glm::mat3> weights;

  // `p` must be an element of `primitives`.
  [[nodiscard]] const SetupCorners& corners_of(const SetupPrimitive& p) const {
    return corners[static_cast<std::size_t>(&p - primitives.data())];
  }
  // The matrix of a clipped primitive's corners, or null if it was not clipped.
  [[nodiscard]] const glm::mat3* weights_of(const SetupCorners& c) const {
    return c.weights == kNoWeights ? nullptr : &weights[c.weights];
  }
};

}  // namespace ninebit
