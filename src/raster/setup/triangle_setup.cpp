#include "src/raster/setup/triangle_setup.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "src/raster/setup/clip.h"
#include "src/raster/setup/coverage_samples.h"
#include "src/raster/setup/line_setup.h"

namespace ninebit {
namespace {

bool has_usable_w(const std::array<glm::vec4, 3>& clip) {
  return clip[0].w >= kSmallestW && clip[1].w >= kSmallestW && clip[2].w >= kSmallestW;
}

void emit(const SetupContext& context, const PolygonTriangle& triangle, std::array<WindowVertex, 3> v,
          const glm::mat3* weights, const std::optional<SetupOffset>& offset, SetupBlock& block) {
  const auto [left, right] = std::minmax({v[0].x_q4, v[1].x_q4, v[2].x_q4});
  const auto [low, high] = std::minmax({v[0].y_q4, v[1].y_q4, v[2].y_q4});
  const int around = context.smooth_polygons ? kCoverageReach_q4 : 0;
  const PixelBounds box = context.pixels_in(left - around, low - around, right + around, high + around);
  if (box.empty()) return;  // most small triangles are dropped here
  const std::int64_t area = static_cast<std::int64_t>(v[1].x_q4 - v[0].x_q4) * (v[2].y_q4 - v[0].y_q4) -
                            static_cast<std::int64_t>(v[1].y_q4 - v[0].y_q4) * (v[2].x_q4 - v[0].x_q4);
  const bool front = context.is_front(area > 0);
  if (area == 0 || context.is_culled(front)) return;
  SetupPrimitive t;
  SetupCorners c;
  t.box = box;
  c.corner = {0, 1, 2};
  if (area < 0) {
    std::swap(v[1], v[2]);
    std::swap(c.corner[1], c.corner[2]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    t.position.set(i, v[i].x_q4, v[i].y_q4);
    t.z24[i] = v[i].z24;
    c.inv_w[i] = v[i].inv_w;
  }
  t.kind = SetupKind::triangle;
  t.front_facing = front;
  t.primitive = triangle.primitive;
  t.set(offset.value_or(context.no_offset()));
  block.primitives.push_back(t);
  if (!context.needs_corners) return;
  c.vertex = triangle.vertex;
  c.weights = kNoWeights;
  if (weights != nullptr) {
    glm::mat3 columns = *weights;
    if (area < 0) std::swap(columns[1], columns[2]);
    c.corner = {0, 1, 2};
    c.weights = static_cast<std::uint32_t>(block.weights.size());
    block.weights.push_back(columns);
  }
  block.corners.push_back(c);
}

std::array<WindowVertex, 3> to_window(const SetupContext& context, const std::array<glm::vec4, 3>& clip) {
  return {context.window(clip[0]), context.window(clip[1]), context.window(clip[2])};
}

// Calls piece(window vertices, weights) for the fan of a clipped triangle.
template <class Piece>
void for_each_piece(const SetupContext& context, const ClipPolygon& polygon, Piece piece) {
  std::array<WindowVertex, kMaxCorners> window;
  for (int i = 0; i < polygon.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    window[k] = context.window(glm::vec4(polygon.vertex[k].position));
  }
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const auto b = static_cast<std::size_t>(i), c = static_cast<std::size_t>(i + 1);
    const glm::mat3 weights(glm::vec3(polygon.vertex[0].weight), glm::vec3(polygon.vertex[b].weight),
                            glm::vec3(polygon.vertex[c].weight));
    piece(std::array<WindowVertex, 3>{window[0], window[b], window[c]}, weights);
  }
}

// The boundary's edges as lines, or the vertices where they start as points.
void outline(const SetupContext& context, const PolygonTriangle& triangle, const ClipPolygon& polygon, bool clipped,
             const PolygonFacts& facts, SetupBlock& block) {
  const SetupSource source{triangle.vertex, triangle.primitive, facts.front_facing, facts.offset};
  const auto end = [&](int i) {
    const auto k = static_cast<std::size_t>((i + polygon.count) % polygon.count);
    const ClipVertex& v = polygon.vertex[k];
    return SetupEnd{glm::vec4(v.position), static_cast<std::uint8_t>(k % 3), glm::vec3(v.weight)};
  };
  for (int i = 0; i < polygon.count; ++i) {
    if (!polygon.vertex[static_cast<std::size_t>(i)].boundary) continue;
    const SetupEnd from = end(i);
    if (facts.mode == PolygonMode::line) {
      add_line(context, from, end(i + 1), clipped, source, block);
    } else if (!clipped || end(i - 1).clip != from.clip) {
      // (A corner on a clip plane comes out of clipping twice.)
      add_point(context, from, clipped, source, block);
    }
  }
}

}  // namespace

void PolygonSurvey::add(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  const std::int64_t area = depth_plane(a, b, c).area;
  area_ += area;
  if (std::abs(area) <= largest_area_) return;
  largest_ = {a, b, c};
  largest_area_ = std::abs(area);
}

void PolygonSurvey::add(const PolygonTriangle& triangle) {
  const std::optional<unsigned> crossed = crossed_planes(triangle.clip, context_.guard);
  if (!crossed) return;
  if (*crossed == 0) {
    if (!has_usable_w(triangle.clip)) return;
    const std::array<WindowVertex, 3> v = to_window(context_, triangle.clip);
    add(v[0], v[1], v[2]);
    return;
  }
  for_each_piece(context_, clip_triangle(triangle.clip, triangle.boundary, *crossed, context_.guard),
                 [&](const std::array<WindowVertex, 3>& v, const glm::mat3&) { add(v[0], v[1], v[2]); });
}

PolygonFacts PolygonSurvey::facts() const {
  PolygonFacts facts;
  facts.front_facing = context_.is_front(area_ > 0);
  facts.mode = context_.mode(facts.front_facing);
  facts.is_drawn = largest_area_ != 0;
  if (facts.mode != PolygonMode::fill) {
    facts.is_drawn = area_ != 0 && !context_.is_culled(facts.front_facing);
  }
  if (facts.is_drawn && context_.is_offset(facts.mode)) {
    facts.offset = setup_offset(context_.offset, context_.offset_rule, largest_, context_.window.depth());
  }
  return facts;
}

void set_up_triangle(const SetupContext& context, const PolygonTriangle& triangle, const PolygonFacts& facts,
                     SetupBlock& block) {
  if (!facts.is_drawn) return;
  const std::optional<unsigned> crossed = crossed_planes(triangle.clip, context.guard);
  if (!crossed) return;
  const bool clipped = *crossed != 0;
  if (!clipped && !has_usable_w(triangle.clip)) return;
  if (!clipped && facts.mode == PolygonMode::fill) {
    emit(context, triangle, to_window(context, triangle.clip), nullptr, facts.offset, block);
    return;
  }
  const ClipPolygon polygon = clip_triangle(triangle.clip, triangle.boundary, *crossed, context.guard);
  if (facts.mode == PolygonMode::fill) {
    for_each_piece(context, polygon, [&](const std::array<WindowVertex, 3>& v, const glm::mat3& weights) {
      emit(context, triangle, v, &weights, facts.offset, block);
    });
  } else {
    outline(context, triangle, polygon, clipped, facts, block);
  }
}

}  // namespace ninebit
