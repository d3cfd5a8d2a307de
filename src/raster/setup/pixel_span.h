// Which pixels of a row lie on the inner side of an edge.
#pragma once

#include <algorithm>
#include <cstdint>

#include "src/raster/surface/floor_divider.h"

namespace ninebit {

// Narrows [low, high] to the x with value + step · x >= 0; false: the whole row lies outside.
[[nodiscard]] inline bool keep_inside(std::int64_t value, std::int64_t step, std::int64_t& low, std::int64_t& high) {
  if (step > 0) {
    low = std::max(low, ceil_divide(-value, step));
  } else if (step < 0) {
    high = std::min(high, floor_divide(value, -step));
  } else if (value < 0) {
    return false;
  }
  return true;
}

}  // namespace ninebit
