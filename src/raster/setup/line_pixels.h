// The fragments of lines and points in a tile, one after the other, those of a row from left to right.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "ninebit/raster/pipeline_state.h"
#include "src/raster/setup/coverage_samples.h"
#include "src/raster/setup/line_setup.h"
#include "src/raster/setup/primitive_depth.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

inline PixelBox common_pixels(const PixelBox& tile, const PixelBounds& box) {
  return {std::max<int>(tile.left, box.left), std::max<int>(tile.bottom, box.bottom),
          std::min<int>(tile.right, box.right + 1), std::min<int>(tile.top, box.top + 1)};
}

// Where the centres of pixels lie along a line, and its depth there. Beyond an end it has the end's values.
class AlongLine {
 public:
  explicit AlongLine(const SetupPrimitive& line)
      : x_(line.x_q4()[0]),
        y_(line.y_q4()[0]),
        dx_(line.x_q4()[1] - x_),
        dy_(line.y_q4()[1] - y_),
        squared_length_(dx_ * dx_ + dy_ * dy_) {}

  // FragmentPlace::edge at the foot of the perpendicular from the centre.
  [[nodiscard]] std::array<std::int64_t, 3> at(int x, int y) const {
    const std::int64_t along = dx_ * (16 * std::int64_t{x} + 8 - x_) + dy_ * (16 * std::int64_t{y} + 8 - y_);
    const std::int64_t from_start = std::clamp(along, std::int64_t{0}, squared_length_);
    return {squared_length_ - from_start, from_start, 0};
  }
  [[nodiscard]] std::int64_t squared_length() const { return squared_length_; }

 private:
  std::int64_t x_, y_, dx_, dy_, squared_length_;
};

// In all of these, `sink` takes (x, y, depth code, FragmentPlace::edge, coverage_byte).

// The pixels of one column (row) share the position along the line that the lowest one's centre has.
template <class Sink>
void draw_diamonds(const PixelBox& tile, const SetupPrimitive& line, const WindowDepth& window, int width, Sink& sink) {
  const LineWalk walk(line);
  const AlongLine place(line);
  const PrimitiveDepth depth(window, line, place.squared_length());
  const bool x_major = walk.is_x_major();
  const int first = std::max(walk.first(), x_major ? tile.left : tile.bottom);
  const int last = std::min(walk.last(), (x_major ? tile.right : tile.top) - 1);
  const int minor_first = x_major ? tile.bottom : tile.left, minor_end = x_major ? tile.top : tile.right;
  for (int major = first; major <= last; ++major) {
    int minor = 0;
    if (!walk.pixel_at(major, minor)) continue;
    const int x = x_major ? major : minor, y = x_major ? minor : major;
    const std::array<std::int64_t, 3> edge = place.at(x, y);
    const std::uint32_t code = depth(edge);
    for (int m = std::max(minor, minor_first); m < std::min(minor + width, minor_end); ++m) {
      sink(x_major ? x : m, x_major ? m : y, code, edge, 255);
    }
  }
}

template <class Sink>
void draw_rectangle(const PixelBox& tile, const SetupPrimitive& line, const WindowDepth& window, int eighths,
                    Sink& sink) {
  const LineRectangle rectangle(line, eighths);
  const AlongLine place(line);
  const PrimitiveDepth depth(window, line, place.squared_length());
  const PixelBox box = common_pixels(tile, line.box);
  for (int y = box.bottom; y < box.top; ++y) {
    int first = box.left, last = box.right - 1;
    if (!rectangle.span(y, first, last)) continue;
    for (int x = first; x <= last; ++x) {
      const std::array<std::int64_t, 3> edge = place.at(x, y);
      sink(x, y, depth(edge), edge, 255);
    }
  }
}

template <class Sink>
void draw_smooth_rectangle(const PixelBox& tile, const SetupPrimitive& line, const WindowDepth& window, int eighths,
                           Sink& sink) {
  const SmoothRectangle rectangle(line, eighths);
  const AlongLine place(line);
  const PrimitiveDepth depth(window, line, place.squared_length());
  const PixelBox box = common_pixels(tile, line.box);
  for (int y = box.bottom; y < box.top; ++y) {
    int first = box.left, last = box.right - 1;
    if (!rectangle.span(y, first, last)) continue;
    for (int x = first; x <= last; ++x) {
      const int inside = rectangle.samples_inside(x, y);
      if (inside == 0) continue;
      const std::array<std::int64_t, 3> edge = place.at(x, y);
      sink(x, y, depth(edge), edge, coverage_byte(inside));
    }
  }
}

template <class Sink>
void draw_point(const PixelBox& tile, const SetupPrimitive& point, const WindowDepth& window, Sink& sink) {
  const std::uint32_t depth = PrimitiveDepth(window, point, 1)({1, 0, 0});
  const PixelBox box = common_pixels(tile, point.box);
  for (int y = box.bottom; y < box.top; ++y) {
    for (int x = box.left; x < box.right; ++x) sink(x, y, depth, {1, 0, 0}, 255);
  }
}

// Draws a primitive of kind SetupKind::line or SetupKind::point.
template <class Sink>
void draw_line_or_point(const PipelineState& state, const PixelBox& tile, const SetupPrimitive& p,
                        const WindowDepth& window, Sink& sink) {
  const int eighths = eighths_of(state.line_width);
  if (p.kind == SetupKind::point) {
    draw_point(tile, p, window, sink);
  } else if (state.line_smooth) {
    draw_smooth_rectangle(tile, p, window, eighths, sink);
  } else if (state.profile.line_shape == LineShape::diamonds) {
    draw_diamonds(tile, p, window, whole_pixels(eighths), sink);
  } else {
    draw_rectangle(tile, p, window, eighths, sink);
  }
}

}  // namespace ninebit
