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

// The square of the distance from which on pixel lights count: half floats cannot tell nearer points apart.
inline constexpr float kSmallestSquare = 0x1p-50F;

// Points with a normal that light falls upon. Places beyond the last receiver are not read for anything that counts.
struct Receivers {
  static constexpr std::size_t kCapacity = 64;
  using Lane = std::array<float, kCapacity>;
  std::array<Lane, 3> position{};
  std::array<Lane, 3> normal{};      // unit length
  Lane s{}, t{};                     // place in the map in texels; any float
  Lane cosine{}, sine{};             // of the turn of the pattern
  std::array<Lane, 3> irradiance{};  // the answer
};

// For the first `count` receivers x, n the sum over the samples of
//   weight × flux × max(0, n_p · (x - x_p)) × max(0, n · (x_p - x)) / |x - x_p|^4,
// where sample i is the texel under (s, t) + kernel × the turned offset i. Samples outside the map, and pixel lights
// whose distance squared is below kSmallestSquare, add nothing. Each receiver's sum is taken in the order of the
// samples, so that it has the same bits whatever the vectors' length.
void gather(const PixelLights& lights, const GatherPattern& pattern, float kernel, std::size_t count,
            Receivers& receivers);

}  // namespace ninebit
