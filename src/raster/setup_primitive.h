// Primitives in the window, ready for the tiles: integer positions and depths, and where their vertices' values are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "src/raster/raw_vector.h"

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

// A triangle (counter-clockwise in the window, y up), a line from its first corner to its second, or a point. Bounds
// that the integer arithmetic relies on: positions lie within 8,192 pixels of the viewport's centre, so differences of
// positions stay within 2^18 sixteenths of a pixel, edge functions, areas and squared lengths within 2^37, and these ×
// window depth within 2^61.
//
// One line of the cache. What is asked of a `pixel` first comes first.
struct alignas(64) SetupPrimitive {
  PixelBounds box;          // of a `pixel`: that pixel
  std::uint32_t pixel_z24;  // of a `pixel`: the window depth there
  std::uint32_t primitive;  // number of the GL primitive in the draw call
  std::int32_t offset_z24;  // polygon offset
  SetupKind kind;
  bool front_facing;
  std::array<std::uint32_t, 3> z24;  // window depth, see window_depth.h
  std::array<std::int32_t, 3> x_q4;  // window position in 1/16 pixel (less with fewer subpixel bits, scaled up)
  std::array<std::int32_t, 3> y_q4;  // of a wide line: already moved to its lowest line; of a point: its lower left
};

// What a primitive's fragments take from its corners besides.
struct alignas(32) SetupCorners {
  std::array<float, 3> inv_w;
  std::uint32_t weights;                // index into SetupBlock::weights, or kNoWeights: not clipped
  std::array<std::uint32_t, 3> vertex;  // numbers of the vertices before clipping; all three are valid in any kind
  std::array<std::uint8_t, 3> corner;   // which of `vertex` each corner is (clipped ones: see weights)
};

// What one block of primitives of a draw call became, in order.
struct SetupBlock {
  RawVector<SetupPrimitive> primitives;
  RawVector<SetupCorners> corners;  // of each primitive; none where SetupContext does not need them
  // For each that was clipped, its corners in barycentric coordinates of `vertex` (column = corner).
  std::vector<glm::mat3> weights;

  // Of one of the primitives.
  [[nodiscard]] const SetupCorners& corners_of(const SetupPrimitive& p) const {
    return corners[static_cast<std::size_t>(&p - primitives.data())];
  }
  // The corners' matrix of one that was clipped, or null.
  [[nodiscard]] const glm::mat3* weights_of(const SetupCorners& c) const {
    return c.weights == kNoWeights ? nullptr : &weights[c.weights];
  }
};

}  // namespace ninebit
