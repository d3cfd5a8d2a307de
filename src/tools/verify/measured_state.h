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

// Without tests.
[[nodiscard]] inline PipelineState plain_state(const HardwareProfile& profile) {
  PipelineState state;
  state.profile = profile;
  state.depth_test.enabled = false;
  return state;
}

}  // namespace ninebit::tools
