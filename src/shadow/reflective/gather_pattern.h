// The sample pattern: where a pixel takes pixel lights from the reflective shadow map, and their weights.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/frame/settings.h"

namespace ninebit {

// Offsets in the unit disc, to be multiplied by the kernel's radius.
struct GatherPattern {
  SamplePattern kind = SamplePattern::poisson;
  std::vector<float> x, y;
  // polar: the square of each sample's radius. poisson: empty, because the weight is the square of the offset's x after
  // the pattern has been rotated at the pixel.
  std::vector<float> weight{};

  // The sum of all weights; for poisson, its mean over all rotations.
  [[nodiscard]] double total_weight() const;
};

// A pattern of settings.samples samples. It is the same on every machine: it is made with integers, square roots and
// products only.
//
// poisson: on a grid of 2^-15, each point is the random candidate in the disc that is farthest from all points before
// it. polar: the Hammersley points (i + 1/2) / n and the radical inverse of i as radius and angle.
[[nodiscard]] GatherPattern make_pattern(const ReflectiveSettings& settings);

// Cosine and sine of the angle by which a pixel rotates the Poisson disk: a hash of its window coordinates, so that it
// stays the same from frame to frame. All directions are equally likely.
[[nodiscard]] glm::vec2 pixel_turn(std::uint32_t x, std::uint32_t y);

// Gathering indirect light: the sum over the pixel lights of a pattern, for many receivers at a time.

// Every texel of a reflective shadow map as a small light: position x, y, z, normal x, y, z and flux red, green, blue,
// one after the other. A texel without a surface has zeros.
struct PixelLights {
  static constexpr std::size_t kStride = 9;
  int size = 0;  // texels a side
  std::vector<float> values{};
};

// Pixel lights at a smaller squared distance add nothing: half floats cannot represent such small distances.
inline constexpr float kSmallestSquare = 0x1p-50F;

// Points that receive light, and their normals. Entries beyond the last receiver do not affect any result.
struct Receivers {
  static constexpr std::size_t kCapacity = 64;
  using Lane = std::array<float, kCapacity>;
  std::array<Lane, 3> position{};
  std::array<Lane, 3> normal{};      // unit length
  Lane s{}, t{};                     // position in the map in texels; any float
  Lane cosine{}, sine{};             // of the pattern's rotation
  std::array<Lane, 3> irradiance{};  // the output of gather()
};

// Computes, for the first `count` receivers x, n, the sum over the samples of
//   weight × flux × max(0, n_p · (x - x_p)) × max(0, n · (x_p - x)) / |x - x_p|^4,
// where sample i is the texel under (s, t) + kernel × the rotated offset i. Samples outside the map, and pixel lights
// whose squared distance is below kSmallestSquare, add nothing. Each receiver's sum is taken in the order of the
// samples, so its bits do not depend on the vector length.
void gather(const PixelLights& lights, const GatherPattern& pattern, float kernel, std::size_t count,
            Receivers& receivers);

}  // namespace ninebit
