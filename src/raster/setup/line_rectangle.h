// Which pixels a line draws as a rectangle (rule 30), in integers.
#pragma once

#include <array>
#include <cstdint>

#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// The rectangle around the line d = Q - P has the corners P ± h and Q ± h. h is perpendicular to d, and its length is
// half the width × (max(|dx|, |dy|) + min(|dx|, |dy|) / 2) / |d|: the chip's estimate of |d|, divided by |d|. So a
// diagonal line is up to 1.118 times too wide. A centre c lies within it if
//
//   |d × (c - P)| <= |d| |h|   and   0 <= d · (c - P) <= |d|²
//
// All of these are whole numbers if they are doubled and the width is in eighths of a pixel: |h| has no root left when
// it is multiplied by |d|. None is larger than 2^40.
class LineRectangle {
 public:
  // How far at most the rectangle reaches beyond the line's ends in x and y, in sixteenths of a pixel.
  [[nodiscard]] static constexpr int reach_q4(int width_eighths) { return width_eighths + width_eighths / 8 + 1; }

  // The line has a length, and its width is not 0.
  LineRectangle(const SetupPrimitive& line, int width_eighths);

  // Narrows [first, last] to the pixels of row y that the line draws; false: there are none.
  [[nodiscard]] bool span(int y, int& first, int& last) const;

 private:
  // value + step_x · x + step_y · y, for the centre of pixel (x, y), is not negative on the inner side.
  struct Side {
    std::int64_t value, step_x, step_y;
  };
  std::array<Side, 4> sides_;  // counter-clockwise, with d first
};

}  // namespace ninebit
