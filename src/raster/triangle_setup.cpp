#include "src/raster/triangle_setup.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ninebit/raster/surface.h"

namespace ninebit {
namespace {

// In doubles: their differences and products cannot overflow, and near the eye an error is magnified by 1 / w.
struct ClipVertex {
  glm::dvec4 position;
  glm::dvec3 weight;  // barycentric coordinates in the original triangle
};

// Clipping a triangle against six planes leaves nine corners at most, as long as the polygon stays convex. Rounding can
// bend a degenerate one; a plane then still adds no more than one corner for every two.
constexpr std::size_t kMaxCorners = 28;  // 3, 4, 6, 9, 13, 19, 28

struct Polygon {
  std::array<ClipVertex, kMaxCorners> vertex;
  int count = 0;
};

// Below it the corners' weights, edge function / w, would no longer be finite. Only clip_from_object matrices that are
// no projection give such a w inside the clip volume; what they put there is not drawn.
constexpr float kSmallestW = 0x1p-80F;

// How far a guard band reaches beyond the viewport: window positions stay within 8,192 pixels of its centre.
float guard_factor(int size) {
  return static_cast<float>(kMaxSurfaceSize) / static_cast<float>(size);
}

// Signed distance to clip plane `plane`, >= 0 inside: near, far, then the guard band's left, right, bottom, top.
double plane_distance(const glm::dvec4& p, int plane, double guard_x, double guard_y) {
  switch (plane) {
    case 0:
      return p.w + p.z;
    case 1:
      return p.w - p.z;
    case 2:
      return guard_x * p.w + p.x;
    case 3:
      return guard_x * p.w - p.x;
    case 4:
      return guard_y * p.w + p.y;
    default:
      return guard_y * p.w - p.y;
  }
}

// Where the edge from an inside to an outside vertex meets the plane. Always computed in that direction, so that two
// triangles that share the edge get the same point.
ClipVertex intersection(const ClipVertex& inside, const ClipVertex& outside, double d_in, double d_out) {
  const double t = d_in / (d_in - d_out);
  const auto mix = [t](double a, double b) { return a + (b - a) * t; };
  ClipVertex v;
  for (int i = 0; i < 4; ++i) v.position[i] = mix(inside.position[i], outside.position[i]);
  for (int i = 0; i < 3; ++i) v.weight[i] = mix(inside.weight[i], outside.weight[i]);
  return v;
}

Polygon clip_against(const Polygon& in, int plane, double guard_x, double guard_y) {
  Polygon out;
  for (int i = 0; i < in.count; ++i) {
    const ClipVertex& a = in.vertex[static_cast<std::size_t>(i)];
    const ClipVertex& b = in.vertex[static_cast<std::size_t>((i + 1) % in.count)];
    const double da = plane_distance(a.position, plane, guard_x, guard_y);
    const double db = plane_distance(b.position, plane, guard_x, guard_y);
    const auto push = [&](const ClipVertex& v) { out.vertex[static_cast<std::size_t>(out.count++)] = v; };
    if (da >= 0.0) {
      push(a);
      if (db < 0.0) push(intersection(a, b, da, db));
    } else if (db >= 0.0) {
      push(intersection(b, a, db, da));
    }
  }
  return out;
}

struct WindowVertex {
  std::int32_t x_q4 = 0;
  std::int32_t y_q4 = 0;
  std::uint32_t z24 = 0;
  float inv_w = 0.0F;
};

// Perspective division, viewport transform, truncation toward zero to the subpixel grid (rule 21), depth to 24 bits by
// rounding to nearest.
WindowVertex to_window(const Viewport& viewport, const glm::vec4& p) {
  WindowVertex v;
  v.inv_w = 1.0F / p.w;
  // Where clipping has cancelled large coordinates, its rounding can leave a corner beyond the guard band.
  const auto in_guard_band = [](float ndc, int size) {
    return std::clamp(ndc, -guard_factor(size), guard_factor(size));
  };
  const float x = in_guard_band(p.x * v.inv_w, viewport.width), y = in_guard_band(p.y * v.inv_w, viewport.height);
  const float half_width = static_cast<float>(viewport.width) * 0.5F;
  const float half_height = static_cast<float>(viewport.height) * 0.5F;
  const float steps = static_cast<float>(1 << viewport.subpixel_bits);
  const int to_q4 = 1 << (4 - viewport.subpixel_bits);
  v.x_q4 = static_cast<std::int32_t>((x * half_width + half_width) * steps) * to_q4;
  v.y_q4 = static_cast<std::int32_t>((y * half_height + half_height) * steps) * to_q4;
  const double z = (static_cast<double>(p.z) / static_cast<double>(p.w) * 0.5 + 0.5) * kMaxDepthZ24 + 0.5;
  v.z24 = z <= 0.0 ? 0U : z >= kMaxDepthZ24 ? kMaxDepthZ24 : static_cast<std::uint32_t>(z);
  return v;
}

// Whether the box around the triangle holds a pixel centre of the viewport: most small triangles are dropped here.
bool meets_a_pixel(const Viewport& viewport, const std::array<WindowVertex, 3>& v) {
  const auto [left, right] = std::minmax({v[0].x_q4, v[1].x_q4, v[2].x_q4});
  const auto [low, high] = std::minmax({v[0].y_q4, v[1].y_q4, v[2].y_q4});
  // Centres are at 16 i + 8.
  const auto first = [](std::int32_t q4) { return (q4 + 7) >> 4; };
  const auto last = [](std::int32_t q4) { return (q4 - 8) >> 4; };
  return first(left) <= last(right) && first(low) <= last(high) && last(right) >= 0 && last(high) >= 0 &&
         first(left) < viewport.width && first(low) < viewport.height;
}

void emit(const Viewport& viewport, std::array<WindowVertex, 3> v, std::array<std::uint8_t, 3> corner,
          const glm::mat3* weights, std::uint32_t primitive, bool cull_front, bool cull_back, SetupBlock& block) {
  if (!meets_a_pixel(viewport, v)) return;
  const std::int64_t area = static_cast<std::int64_t>(v[1].x_q4 - v[0].x_q4) * (v[2].y_q4 - v[0].y_q4) -
                            static_cast<std::int64_t>(v[1].y_q4 - v[0].y_q4) * (v[2].x_q4 - v[0].x_q4);
  if (area == 0 || (area > 0 && cull_front) || (area < 0 && cull_back)) return;
  glm::mat3 columns = weights != nullptr ? *weights : glm::mat3(1.0F);
  if (area < 0) {
    std::swap(v[1], v[2]);
    std::swap(corner[1], corner[2]);
    std::swap(columns[1], columns[2]);
  }
  SetupTriangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    t.x_q4[i] = v[i].x_q4;
    t.y_q4[i] = v[i].y_q4;
    t.z24[i] = v[i].z24;
    t.inv_w[i] = v[i].inv_w;
  }
  t.corner = corner;
  t.clipped = weights != nullptr;
  t.weights = static_cast<std::uint32_t>(block.weights.size());
  t.primitive = primitive;
  block.triangles.push_back(t);
  if (weights != nullptr) block.weights.push_back(columns);
}

}  // namespace

void set_up_triangle(const Viewport& viewport, const std::array<glm::vec4, 3>& clip, std::uint32_t primitive,
                     bool cull_front, bool cull_back, SetupBlock& block) {
  const float guard_x = guard_factor(viewport.width);
  const float guard_y = guard_factor(viewport.height);
  int crossed = 0;  // planes that at least one vertex is outside of
  for (int plane = 0; plane < 6; ++plane) {
    int outside = 0;
    for (const glm::vec4& p : clip) {
      const double d = plane_distance(p, plane, guard_x, guard_y);
      if (!std::isfinite(d)) return;
      outside += d < 0.0 ? 1 : 0;
    }
    if (outside == 3) return;
    if (outside > 0) crossed |= 1 << plane;
  }
  // All vertices beyond one side of the viewport: nothing can be seen, whatever the guard band says.
  for (int axis = 0; axis < 2; ++axis) {
    int low = 0, high = 0;
    for (const glm::vec4& p : clip) {
      low += p[axis] < -p.w ? 1 : 0;
      high += p[axis] > p.w ? 1 : 0;
    }
    if (low == 3 || high == 3) return;
  }
  if (crossed == 0) {
    for (const glm::vec4& p : clip) {
      if (!(p.w >= kSmallestW)) return;
    }
    emit(viewport, {to_window(viewport, clip[0]), to_window(viewport, clip[1]), to_window(viewport, clip[2])},
         {0, 1, 2}, nullptr, primitive, cull_front, cull_back, block);
    return;
  }

  Polygon polygon;
  polygon.count = 3;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 weight(0.0);
    weight[i] = 1.0;
    polygon.vertex[static_cast<std::size_t>(i)] = {clip[static_cast<std::size_t>(i)], weight};
  }
  for (int plane = 0; plane < 6 && polygon.count >= 3; ++plane) {
    if ((crossed & (1 << plane)) != 0) polygon = clip_against(polygon, plane, guard_x, guard_y);
  }
  std::array<WindowVertex, kMaxCorners> window;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::vec4 p(polygon.vertex[static_cast<std::size_t>(i)].position);
    if (!(p.w >= kSmallestW)) return;
    window[static_cast<std::size_t>(i)] = to_window(viewport, p);
  }
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const auto b = static_cast<std::size_t>(i), c = static_cast<std::size_t>(i + 1);
    const glm::mat3 weights(glm::vec3(polygon.vertex[0].weight), glm::vec3(polygon.vertex[b].weight),
                            glm::vec3(polygon.vertex[c].weight));
    emit(viewport, {window[0], window[b], window[c]}, {0, 1, 2}, &weights, primitive, cull_front, cull_back, block);
  }
}

}  // namespace ninebit
