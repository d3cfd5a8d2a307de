// The polygon offset, factor × m + units × r, of one polygon (OpenGL 1.3, 3.5.5).
#pragma once

#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/pipeline_state.h"
#include "src/raster/window_depth.h"
#include "src/raster/window_transform.h"

namespace ninebit {

// A triangle's depth plane as exact fractions: window depth changes by dx / area for 1/16 pixel in x, dy / area in y.
// Within |dx|, |dy| <= 2^43.
struct DepthPlane {
  std::int64_t area = 0;  // twice the triangle's, in square sixteenths of a pixel; negative: clockwise
  std::int64_t dx = 0;
  std::int64_t dy = 0;
};
[[nodiscard]] DepthPlane depth_plane(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);

// The offset in window depth, rounded to nearest, halves up: in doubles, m from exact differences of depth over the
// area, then factor × m, then units × r added, then the rounding. It stays within ±2^25, far beyond which every sum is
// clamped. The plane has an area; factor and units are finite.
[[nodiscard]] std::int32_t polygon_offset_z24(const PolygonOffset& offset, OffsetSlope slope, const DepthPlane& plane,
                                              const WindowDepth& depth);

}  // namespace ninebit
