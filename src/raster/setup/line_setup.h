// Lines and points in the window: primitives of their own, and those that polygon modes make from polygons.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "src/raster/setup/coverage_samples.h"
#include "src/raster/setup/setup_context.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// The values that a line or a point takes from its source.
struct SetupSource {
  std::array<std::uint32_t, 3> vertex{};
  std::uint32_t primitive = 0;
  bool front_facing = true;
  std::optional<SetupOffset> offset{};  // empty: there is none
};

// A vertex of a line or a point: one of the source's, or with weights one that clipping made.
struct SetupEnd {
  glm::vec4 clip{};
  std::uint8_t corner = 0;
  glm::vec3 weights{};
};

// Appends the line from a to b, which lie within the planes. `clipped`: the ends' weights count, not their corners. A
// line without length or with both ends beyond a side of the view volume is left out.
void add_line(const SetupContext& context, const SetupEnd& a, const SetupEnd& b, bool clipped,
              const SetupSource& source, SetupBlock& block);

// Appends the point unless it is beyond a side of the view volume.
void add_point(const SetupContext& context, const SetupEnd& at, bool clipped, const SetupSource& source,
               SetupBlock& block);

// Appends the visible part of a line or point primitive. `clip` holds its vertices in clip coordinates.
void set_up_line(const SetupContext& context, const std::array<glm::vec4, 2>& clip,
                 const std::array<std::uint32_t, 2>& vertex, std::uint32_t primitive, SetupBlock& block);
void set_up_point(const SetupContext& context, const glm::vec4& clip, std::uint32_t vertex, std::uint32_t primitive,
                  SetupBlock& block);

// Which pixels a line draws as a rectangle (rule 30), in integers.

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

 protected:
  // value + step_x · x + step_y · y, for the centre of pixel (x, y), is not negative on the inner side.
  struct Side {
    std::int64_t value, step_x, step_y;
  };
  std::array<Side, 4> sides_;  // counter-clockwise, with d first
};

// The same of a smoothed line (rule 47).
class SmoothRectangle : LineRectangle {
 public:
  SmoothRectangle(const SetupPrimitive& line, int width_eighths);

  // Narrows [first, last] to the pixels of row y that may have a coverage sample inside; false: there are none.
  [[nodiscard]] bool span(int y, int& first, int& last) const;

  // How many of a pixel's coverage samples it holds.
  [[nodiscard]] int samples_inside(int x, int y) const;

 private:
  // What a sample adds to each side's value at the centre, and what the samples add at most.
  std::array<std::array<std::int64_t, kCoverageSamples.size()>, 4> of_sample_;
  std::array<std::int64_t, 4> most_;
};

// Which pixels a line draws: the diamond-exit rule of OpenGL 1.3, 3.4.1, in integers.

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
