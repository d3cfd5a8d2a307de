// Clear values as the planes hold them.
#pragma once

#include <cstdint>

#include "ninebit/raster/surface.h"

namespace ninebit {

// A window depth clamped to [0, 1], as the nearest code, halves up. NaN becomes 0.
[[nodiscard]] std::uint32_t depth_code(DepthStencilFormat format, double depth);

// The low bits of a stencil value.
[[nodiscard]] std::uint8_t stencil_value(DepthStencilFormat format, int stencil);

}  // namespace ninebit
