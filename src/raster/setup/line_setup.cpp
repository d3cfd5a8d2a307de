#include "src/raster/setup/line_setup.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <optional>

#include "src/raster/setup/line_rectangle.h"

namespace ninebit {
namespace {

struct Piece {
  SetupPrimitive primitive{};
  SetupCorners corners{};
};

Piece start(const SetupContext& context, SetupKind kind, const SetupSource& source, const PixelBounds& box) {
  Piece p;
  p.primitive.cuts_depth = context.window.depth().cuts();
  p.primitive.kind = kind;
  p.primitive.box = box;
  p.primitive.front_facing = source.front_facing;
  p.primitive.primitive = source.primitive;
  p.primitive.offset_z24 = source.offset_z24;
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
  const int reach = LineRectangle::reach_q4(context.line_eighths);
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

}  // namespace ninebit
