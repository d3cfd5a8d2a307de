// The sizes of points and lines in whole numbers.
#pragma once

#include <algorithm>

namespace ninebit {

// A size in pixels that is a multiple of 1/8.
[[nodiscard]] inline int eighths_of(float size) {
  return static_cast<int>(8.0F * size);
}

// OpenGL's sizes (1.3, 3.3 and 3.4.2): rounded to whole pixels, halves up, at least one.
[[nodiscard]] inline int whole_pixels(int eighths) {
  return std::max(1, (eighths + 4) / 8);
}

}  // namespace ninebit
