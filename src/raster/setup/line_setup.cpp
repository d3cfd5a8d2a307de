#include "src/raster/setup/line_setup.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <optional>

#include "src/raster/setup/pixel_span.h"
#include "src/raster/surface/floor_divider.h"

namespace ninebit {
namespace {

struct Piece {
  SetupPrimitive primitive{};
  SetupCorners corners{};
};

Piece start(const SetupContext& context, SetupKind kind, const SetupSource& source, const PixelBounds& box) {
  Piece p;
  p.primitive.kind = kind;
  p.primitive.box = box;
  p.primitive.front_facing = source.front_facing;
  p.primitive.primitive = source.primitive;
  p.primitive.set(source.offset.value_or(context.no_offset()));
  p.corners.vertex = source.vertex;
  p.corners.corner = {0, 1, 2};
  p.corners.weights = kNoWeights;
  return p;
}

void put(const WindowVertex& from, std::size_t i, Piece& to) {
  to.primitive.position.set(i, from.x_q4, from.y_q4);
  to.primitive.z24[i] = from.z24;
  to.corners.inv_w[i] = from.inv_w;
}

// The pixels in the box of a line's ends, made larger to the left and below, and to the right and above.
PixelBounds box_around(const SetupContext& context, const WindowVertex& from, const WindowVertex& to, int before,
                       int beyond) {
  const auto [left, right] = std::minmax(from.x_q4, to.x_q4);
  const auto [low, high] = std::minmax(from.y_q4, to.y_q4);
  return context.pixels_in(left - before, low - before, right + beyond, high + beyond);
}

// The corner that is neither.
std::uint8_t third(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>(3 - a - b);
}

// A line of diamonds: one of width w starts (w - 1) / 2 pixels lower in its minor direction and is replicated from
// there. Returns the box, in which a whole pixel is enough for the diamonds that it can leave, whose centres lie within
// half a pixel of it.
PixelBounds place_diamonds(const SetupContext& context, WindowVertex& from, WindowVertex& to) {
  const int width = whole_pixels(context.line_eighths), lower = 8 * (width - 1);
  const bool x_major = std::abs(to.x_q4 - from.x_q4) >= std::abs(to.y_q4 - from.y_q4);
  (x_major ? from.y_q4 : from.x_q4) -= lower;
  (x_major ? to.y_q4 : to.x_q4) -= lower;
  return box_around(context, from, to, 16, 16 * width);
}

// The pixels that a point draws, of OpenGL's shape: around the pixel that holds the position when the size is odd, else
// around the nearest corner of pixels (OpenGL 1.3, 3.3).
PixelBounds whole_pixel_point(const SetupContext& context, const WindowVertex& v) {
  const int size = whole_pixels(context.point_eighths), half_up = size % 2 == 0 ? 8 : 0;
  const int x = 16 * (((v.x_q4 + half_up) >> 4) - size / 2), y = 16 * (((v.y_q4 + half_up) >> 4) - size / 2);
  return context.pixels_in(x, y, x + 16 * size, y + 16 * size);
}

// The same by rule 31: the centres in a square, whose half in sixteenths is the size in eighths. The left and the upper
// edge draw; the right and the lower one unless the size is a power of two. A size of 0 draws the pixel that holds the
// position, the left and the upper edge included.
PixelBounds square_point(const SetupContext& context, const WindowVertex& v) {
  const int half = context.point_eighths;
  if (half == 0) {
    const int x = 16 * (v.x_q4 >> 4), y = 16 * ((v.y_q4 - 1) >> 4);
    return context.pixels_in(x, y, x + 16, y + 16);
  }
  const int open = std::has_single_bit(static_cast<unsigned>(half)) ? 1 : 0;
  return context.pixels_in(v.x_q4 - half, v.y_q4 - half + open, v.x_q4 + half - open, v.y_q4 + half);
}

void append(const SetupContext& context, Piece& p, const std::optional<glm::mat3>& weights, SetupBlock& block) {
  block.primitives.push_back(p.primitive);
  if (!context.needs_corners) return;
  if (weights) {
    p.corners.weights = static_cast<std::uint32_t>(block.weights.size());
    block.weights.push_back(*weights);
  }
  block.corners.push_back(p.corners);
}

}  // namespace

void add_line(const SetupContext& context, const SetupEnd& a, const SetupEnd& b, bool clipped,
              const SetupSource& source, SetupBlock& block) {
  if (is_beyond_a_side({a.clip, b.clip})) return;
  WindowVertex from = context.window(a.clip), to = context.window(b.clip);
  if (from.x_q4 == to.x_q4 && from.y_q4 == to.y_q4) return;
  const int reach = LineRectangle::reach_q4(context.line_eighths) + (context.smooth_lines ? kCoverageReach_q4 : 0);
  const PixelBounds box = context.line_shape == LineShape::diamonds ? place_diamonds(context, from, to)
                                                                    : box_around(context, from, to, reach, reach);
  if (box.empty()) return;

  Piece p = start(context, SetupKind::line, source, box);
  put(from, 0, p);
  put(to, 1, p);
  if (!clipped) p.corners.corner = {a.corner, b.corner, third(a.corner, b.corner)};
  append(context, p, clipped ? std::optional(glm::mat3(a.weights, b.weights, glm::vec3(0.0F))) : std::nullopt, block);
}

void add_point(const SetupContext& context, const SetupEnd& at, bool clipped, const SetupSource& source,
               SetupBlock& block) {
  if (!is_between_sides(at.clip)) return;
  const WindowVertex v = context.window(at.clip);
  const PixelBounds box =
      context.point_shape == PointShape::squares ? square_point(context, v) : whole_pixel_point(context, v);
  if (box.empty()) return;
  Piece p = start(context, SetupKind::point, source, box);
  put(v, 0, p);
  if (!clipped) {
    p.corners.corner = {at.corner, static_cast<std::uint8_t>((at.corner + 1) % 3),
                        static_cast<std::uint8_t>((at.corner + 2) % 3)};
  }
  append(context, p, clipped ? std::optional(glm::mat3(at.weights, glm::vec3(0.0F), glm::vec3(0.0F))) : std::nullopt,
         block);
}

void set_up_line(const SetupContext& context, const std::array<glm::vec4, 2>& clip,
                 const std::array<std::uint32_t, 2>& vertex, std::uint32_t primitive, SetupBlock& block) {
  const std::optional<unsigned> crossed = crossed_planes(clip, context.guard);
  if (!crossed) return;
  const SetupSource source{.vertex = {vertex[0], vertex[1], vertex[1]}, .primitive = primitive};
  const ClipPolygon line = clip_line(clip, *crossed, context.guard);
  if (line.count == 0) return;
  const auto end = [&](std::size_t i) {
    return SetupEnd{glm::vec4(line.vertex[i].position), static_cast<std::uint8_t>(i), glm::vec3(line.vertex[i].weight)};
  };
  add_line(context, end(0), end(1), *crossed != 0, source, block);
}

void set_up_point(const SetupContext& context, const glm::vec4& clip, std::uint32_t vertex, std::uint32_t primitive,
                  SetupBlock& block) {
  if (!is_in_view_volume(clip)) return;
  add_point(context, {.clip = clip}, false, {.vertex = {vertex, vertex, vertex}, .primitive = primitive}, block);
}

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

SmoothRectangle::SmoothRectangle(const SetupPrimitive& line, int width_eighths) : LineRectangle(line, width_eighths) {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    for (std::size_t k = 0; k < kCoverageSamples.size(); ++k) {
      const CoverageSample& sample = kCoverageSamples[k];
      of_sample_[i][k] = sides_[i].step_x / 16 * sample.x_q4 + sides_[i].step_y / 16 * sample.y_q4;
    }
    most_[i] = *std::max_element(of_sample_[i].begin(), of_sample_[i].end());
  }
}

bool SmoothRectangle::span(int y, int& first, int& last) const {
  std::int64_t low = first, high = last;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    if (!keep_inside(side.value + side.step_y * y + most_[i], side.step_x, low, high)) return false;
  }
  first = static_cast<int>(low);
  last = static_cast<int>(high);
  return low <= high;
}

// The compiler vectorizes both loops.
int SmoothRectangle::samples_inside(int x, int y) const {
  std::array<std::int64_t, kCoverageSamples.size()> signs{};
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const std::int64_t at_centre = sides_[i].value + sides_[i].step_x * x + sides_[i].step_y * y;
    for (std::size_t k = 0; k < signs.size(); ++k) signs[k] |= at_centre + of_sample_[i][k];
  }
  std::uint64_t outside = 0;
  for (const std::int64_t sign : signs) outside += static_cast<std::uint64_t>(sign) >> 63;
  return static_cast<int>(signs.size() - outside);
}

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
