#include "src/raster/setup/line_rectangle.h"

#include <algorithm>
#include <cstdlib>

#include "src/raster/setup/pixel_span.h"

namespace ninebit {
namespace {

// Whether a side that runs in the direction (dx, dy), with the inner side to its left, draws the centres on it. A
// side that is level or upright follows the top-left rule of polygons. The corners of other sides are not exact on the
// chip, and all centres that pictures show on one fell to the right.
bool draws_its_centres(std::int64_t dx, std::int64_t dy) {
  if (dx == 0) return dy < 0;
  return dy == 0 ? dx < 0 : dy > 0;
}

}  // namespace

LineRectangle::LineRectangle(const SetupPrimitive& line, int width_eighths) {
  const std::int64_t x = line.x_q4()[0], y = line.y_q4()[0];
  const std::int64_t dx = line.x_q4()[1] - x, dy = line.y_q4()[1] - y;
  const std::int64_t larger = std::max(std::abs(dx), std::abs(dy)), smaller = std::min(std::abs(dx), std::abs(dy));
  const std::int64_t across = width_eighths * (2 * larger + smaller);  // 2 |d| |h|
  const std::int64_t along = 2 * (dx * dx + dy * dy);
  // How far inside of each side the line's beginning lies.
  const std::array<std::int64_t, 4> inside{across, along, across, 0};
  std::int64_t side_x = dx, side_y = dy;
  for (std::size_t i = 0; i < 4; ++i) {
    Side& side = sides_[i];
    side.value = inside[i] + 2 * (side_x * (8 - y) - side_y * (8 - x)) - (draws_its_centres(side_x, side_y) ? 0 : 1);
    side.step_x = -32 * side_y;
    side.step_y = 32 * side_x;
    const std::int64_t turned_x = -side_y;
    side_y = side_x;
    side_x = turned_x;
  }
}

bool LineRectangle::span(int y, int& first, int& last) const {
  std::int64_t low = first, high = last;
  for (const Side& side : sides_) {
    if (!keep_inside(side.value + side.step_y * y, side.step_x, low, high)) return false;
  }
  first = static_cast<int>(low);
  last = static_cast<int>(high);
  return low <= high;
}

}  // namespace ninebit
