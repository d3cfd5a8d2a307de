// The polygon offset, factor × m + units × r, of one polygon (OpenGL 1.3, 3.5.5).
#pragma once

#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/pipeline_state.h"
#include "src/raster/setup/window_depth.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

// A triangle's depth plane as exact fractions: window depth changes by dx / area for 1/16 pixel in x, dy / area in y.
// Within |dx|, |dy| <= 2^43, |area| <= 2^38.
struct DepthPlane {
  std::int64_t area = 0;  // twice the triangle's, in square sixteenths of a pixel; negative: clockwise
  std::int64_t dx = 0;
  std::int64_t dy = 0;
};
[[nodiscard]] DepthPlane depth_plane(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);

// The offset stays within ± this in window depth, far beyond which every sum of depth and offset is clamped.
inline constexpr std::int32_t kLargestOffset = 1 << 25;

// A double's factor × m + units × r is within kOffsetError × (|factor × m| + |units × r| + 1) of the exact sum: m, the
// product, the sum, these bounds and the half that is added are eight roundings or fewer, of 2^-53 each.
inline constexpr double kOffsetError = 0x1p-49;

// The offset in window depth: the exact sum, rounded to nearest, halves up, and clamped to ±kLargestOffset. Doubles
// bound the sum; where both bounds do not round to the same number, whole numbers decide. The plane has an area; factor
// and units are finite.
[[nodiscard]] std::int32_t polygon_offset_z24(const PolygonOffset& offset, OffsetSlope slope, const DepthPlane& plane,
                                              const WindowDepth& depth);

}  // namespace ninebit
