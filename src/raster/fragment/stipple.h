// Which pixels a stipple pattern draws (OpenGL 1.3, 3.5.2; rule 45).
#pragma once

#include <cstddef>

#include "ninebit/raster/pipeline_state.h"

namespace ninebit {

// Whether the pattern has pixel (x, y) of the target, neither negative.
[[nodiscard]] constexpr bool has_pixel(const StipplePattern& pattern, int x, int y) {
  const auto byte = static_cast<std::size_t>(4 * (y % 32) + x % 32 / 8);
  return ((pattern[byte] >> (7 - x % 8)) & 1) != 0;
}

}  // namespace ninebit
