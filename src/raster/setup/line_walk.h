// Which pixels a line draws: the diamond-exit rule of OpenGL 1.3, 3.4.1, in integers.
#pragma once

#include <array>
#include <cstdint>

#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// A pixel's diamond is |x - xc| + |y - yc| < 1/2 around its centre. A line draws the pixels whose diamonds it meets,
// but for one that holds its end, both ends being moved by (-e, -e²) for an e smaller than any that makes a difference.
// For ends on the grid of 1/16 pixel this means:
//
// - A line meets the diamonds of the column (or row, of a line steeper than 45 degrees) through whose middle it passes
//   within half a pixel; halfway between two centres, a line that rises to the right passes above, all others below or
//   to the left.
// - An end on a diamond's border is inside when it is to the right of the centre, else outside.
class LineWalk {
 public:
  explicit LineWalk(const SetupPrimitive& line);

  // Whether the line goes along x, a pixel a column at most; else along y, a pixel a row.
  [[nodiscard]] bool is_x_major() const { return x_major_; }
  // Columns (rows) that may have a pixel lie from first() to last().
  [[nodiscard]] int first() const { return first_; }
  [[nodiscard]] int last() const { return last_; }
  // Whether the line draws a pixel of this column (row), and the pixel's row (column).
  [[nodiscard]] bool pixel_at(int major, int& minor) const;

 private:
  // Whether an end, 0 or 1, has left the diamond around a centre that the line meets.
  [[nodiscard]] bool is_past(std::size_t end, std::int64_t centre_major, std::int64_t centre_minor) const;

  bool x_major_;
  bool forward_;  // along the major axis
  std::array<std::int64_t, 2> major_, minor_;
  std::int64_t length_;  // along the major axis, > 0
  std::int64_t rise_;    // of the minor axis while the major one grows by length_
  int first_, last_;
};

}  // namespace ninebit
