// Coverage of smoothed polygons and lines by eight samples (rule 47).
#pragma once

#include <array>
#include <cstdint>

namespace ninebit {

// A sample's place relative to the pixel's centre, in sixteenths of a pixel, y up.
struct CoverageSample {
  int x_q4 = 0;
  int y_q4 = 0;
};

// Sample i lies i/8 to the right of the pixel's upper left corner and (3 i mod 8)/8 below it.
inline constexpr std::array<CoverageSample, 8> kCoverageSamples = [] {
  std::array<CoverageSample, 8> samples{};
  for (int i = 0; i < 8; ++i) samples[static_cast<std::size_t>(i)] = {2 * i - 8, 8 - 2 * (3 * i % 8)};
  return samples;
}();

// How far samples lie from the centre at most, in x and in y.
inline constexpr int kCoverageReach_q4 = 8;

// The coverage of a pixel with so many samples inside, as an alpha byte.
[[nodiscard]] constexpr std::uint8_t coverage_byte(int inside) {
  return static_cast<std::uint8_t>((255 * inside) >> 3);
}

}  // namespace ninebit
