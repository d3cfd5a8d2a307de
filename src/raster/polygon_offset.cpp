#include "src/raster/polygon_offset.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ninebit {

DepthPlane depth_plane(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  const std::int64_t bx = b.x_q4 - a.x_q4, by = b.y_q4 - a.y_q4, cx = c.x_q4 - a.x_q4, cy = c.y_q4 - a.y_q4;
  const std::int64_t bz = std::int64_t{b.z24} - a.z24, cz = std::int64_t{c.z24} - a.z24;
  return {.area = bx * cy - by * cx, .dx = bz * cy - cz * by, .dy = bx * cz - cx * bz};
}

std::int32_t polygon_offset_z24(const PolygonOffset& offset, OffsetSlope slope, const DepthPlane& plane,
                                const WindowDepth& depth) {
  // Per pixel: numerators within 2^48, which doubles hold exactly.
  const auto area = static_cast<double>(std::abs(plane.area));
  const std::int64_t dx = 16 * std::abs(plane.dx), dy = 16 * std::abs(plane.dy);
  double m = static_cast<double>(std::max(dx, dy)) / area;
  if (slope == OffsetSlope::root) {
    const double x = static_cast<double>(dx) / area, y = static_cast<double>(dy) / area;
    m = std::sqrt(x * x + y * y);
  }
  const double sum = static_cast<double>(offset.factor) * m +
                     static_cast<double>(offset.units) * static_cast<double>(depth.step_z24());
  constexpr double kLimit = 0x1p25;
  return static_cast<std::int32_t>(std::floor(std::clamp(sum, -kLimit, kLimit) + 0.5));
}

}  // namespace ninebit
