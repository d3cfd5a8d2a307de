// Gathering indirect light: the sum over the pixel lights of a pattern, for many receivers at a time.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/shadow/reflective/gather_pattern.h"

namespace ninebit {

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
