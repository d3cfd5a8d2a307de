#include "src/raster/setup/line_walk.h"

#include <algorithm>
#include <cstdlib>

#include "src/raster/surface/floor_divider.h"

namespace ninebit {

LineWalk::LineWalk(const SetupPrimitive& line)
    : x_major_(std::abs(line.x_q4()[1] - line.x_q4()[0]) >= std::abs(line.y_q4()[1] - line.y_q4()[0])) {
  const std::array<std::int32_t, 3> along = x_major_ ? line.x_q4() : line.y_q4();
  const std::array<std::int32_t, 3> across = x_major_ ? line.y_q4() : line.x_q4();
  major_ = {along[0], along[1]};
  minor_ = {across[0], across[1]};
  forward_ = major_[1] > major_[0];
  length_ = std::abs(major_[1] - major_[0]);
  rise_ = forward_ ? minor_[1] - minor_[0] : minor_[0] - minor_[1];
  first_ = static_cast<int>((std::min(major_[0], major_[1]) >> 4) - 1);
  last_ = static_cast<int>((std::max(major_[0], major_[1]) >> 4) + 1);
}

bool LineWalk::is_past(std::size_t end, std::int64_t centre_major, std::int64_t centre_minor) const {
  const std::int64_t along = major_[end] - centre_major, across = minor_[end] - centre_minor;
  const bool is_beyond_centre = forward_ ? along > 0 : along <= 0;
  const std::int64_t distance = std::abs(along) + std::abs(across);
  const bool is_inside = distance < 8 || (distance == 8 && (x_major_ ? along : across) > 0);
  return is_beyond_centre && !is_inside;
}

bool LineWalk::pixel_at(int major, int& minor) const {
  const std::int64_t centre = std::int64_t{16} * major + 8;
  // The line's place on the minor axis, times length_.
  const std::int64_t place = minor_[0] * length_ + rise_ * (centre - major_[0]);
  const std::int64_t pixel =
      x_major_ && rise_ > 0 ? floor_divide(place, 16 * length_) : ceil_divide(place, 16 * length_) - 1;
  minor = static_cast<int>(pixel);
  const std::int64_t centre_minor = 16 * pixel + 8;
  return !is_past(0, centre, centre_minor) && is_past(1, centre, centre_minor);
}

}  // namespace ninebit
