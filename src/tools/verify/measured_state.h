// Shared by the drawings of measured rows.
#pragma once

#include <cstdint>

#include "ninebit/raster/rasterizer.h"

namespace ninebit::tools {

// AARRGGBB, or RRGGBB, whose alpha is 0.
[[nodiscard]] inline ColorBytes color_of(std::uint32_t digits) {
  const auto byte = [digits](unsigned shift) { return static_cast<std::uint8_t>(digits >> shift); };
  return {byte(16), byte(8), byte(0), byte(24)};
}

// The picture's blend of a value by its alpha over another one (rule 19).
[[nodiscard]] inline int shown_over(int value, int alpha, int under) {
  return (2 * (alpha * value + (255 - alpha) * under) + 255) / 510;
}

// Without tests.
[[nodiscard]] inline PipelineState plain_state(const HardwareProfile& profile) {
  PipelineState state;
  state.profile = profile;
  state.depth_test.enabled = false;
  return state;
}

}  // namespace ninebit::tools
