#include "src/raster/setup/clip.h"

#include <cmath>

namespace ninebit {
namespace {

constexpr int kPlanes = 6;

// Signed distance to clip plane `plane`, >= 0 inside: near, far, then the guard band's left, right, bottom, top.
double plane_distance(const glm::dvec4& p, int plane, const GuardBand& guard) {
  switch (plane) {
    case 0:
      return p.w + p.z;
    case 1:
      return p.w - p.z;
    case 2:
      return guard.x * p.w + p.x;
    case 3:
      return guard.x * p.w - p.x;
    case 4:
      return guard.y * p.w + p.y;
    default:
      return guard.y * p.w - p.y;
  }
}

// Where the edge from an inside to an outside vertex meets the plane. Always computed in that direction, so that two
// primitives that share the edge get the same point.
ClipVertex intersection(const ClipVertex& inside, const ClipVertex& outside, double d_in, double d_out, bool boundary) {
  const double t = d_in / (d_in - d_out);
  const auto mix = [t](double a, double b) { return a + (b - a) * t; };
  ClipVertex v;
  for (int i = 0; i < 4; ++i) v.position[i] = mix(inside.position[i], outside.position[i]);
  for (int i = 0; i < 3; ++i) v.weight[i] = mix(inside.weight[i], outside.weight[i]);
  v.boundary = boundary;
  return v;
}

ClipPolygon clip_against(const ClipPolygon& in, int plane, const GuardBand& guard) {
  ClipPolygon out;
  for (int i = 0; i < in.count; ++i) {
    const ClipVertex& a = in.vertex[static_cast<std::size_t>(i)];
    const ClipVertex& b = in.vertex[static_cast<std::size_t>((i + 1) % in.count)];
    const double da = plane_distance(a.position, plane, guard);
    const double db = plane_distance(b.position, plane, guard);
    const auto push = [&](const ClipVertex& v) { out.vertex[static_cast<std::size_t>(out.count++)] = v; };
    if (da >= 0.0) {
      push(a);
      if (db < 0.0) push(intersection(a, b, da, db, true));
    } else if (db >= 0.0) {
      push(intersection(b, a, db, da, a.boundary));
    }
  }
  return out;
}

// All vertices are beyond one side of the viewport: nothing is visible, regardless of the guard band.
template <std::size_t N>
bool are_beyond_a_side(const std::array<glm::vec4, N>& clip) {
  for (int axis = 0; axis < 2; ++axis) {
    std::size_t low = 0, high = 0;
    for (const glm::vec4& p : clip) {
      if (p[axis] < -p.w) ++low;
      if (p[axis] > p.w) ++high;
    }
    if (low == N || high == N) return true;
  }
  return false;
}

template <std::size_t N>
std::optional<unsigned> crossed_by(const std::array<glm::vec4, N>& clip, const GuardBand& guard) {
  unsigned crossed = 0;
  for (int plane = 0; plane < kPlanes; ++plane) {
    std::size_t outside = 0;
    for (const glm::vec4& p : clip) {
      const double d = plane_distance(p, plane, guard);
      if (!std::isfinite(d)) return std::nullopt;
      if (d < 0.0) ++outside;
    }
    if (outside == N) return std::nullopt;
    if (outside > 0) crossed |= 1U << plane;
  }
  if (are_beyond_a_side(clip)) return std::nullopt;
  return crossed;
}

bool has_usable_w(const ClipPolygon& polygon) {
  for (int i = 0; i < polygon.count; ++i) {
    if (!(static_cast<float>(polygon.vertex[static_cast<std::size_t>(i)].position.w) >= kSmallestW)) return false;
  }
  return true;
}

}  // namespace

std::optional<unsigned> crossed_planes(const std::array<glm::vec4, 3>& clip, const GuardBand& guard) {
  return crossed_by(clip, guard);
}

std::optional<unsigned> crossed_planes(const std::array<glm::vec4, 2>& clip, const GuardBand& guard) {
  return crossed_by(clip, guard);
}

ClipPolygon clip_triangle(const std::array<glm::vec4, 3>& clip, const std::array<bool, 3>& boundary, unsigned crossed,
                          const GuardBand& guard) {
  ClipPolygon polygon;
  polygon.count = 3;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    glm::dvec3 weight(0.0);
    weight[i] = 1.0;
    polygon.vertex[k] = {clip[k], weight, boundary[k]};
  }
  for (int plane = 0; plane < kPlanes && polygon.count >= 3; ++plane) {
    if ((crossed & (1U << plane)) != 0) polygon = clip_against(polygon, plane, guard);
  }
  if (polygon.count < 3 || !has_usable_w(polygon)) polygon.count = 0;
  return polygon;
}

ClipPolygon clip_line(const std::array<glm::vec4, 2>& clip, unsigned crossed, const GuardBand& guard) {
  ClipPolygon line;
  line.vertex[0] = {clip[0], {1.0, 0.0, 0.0}, true};
  line.vertex[1] = {clip[1], {0.0, 1.0, 0.0}, true};
  for (int plane = 0; plane < kPlanes; ++plane) {
    if ((crossed & (1U << plane)) == 0) continue;
    ClipVertex &a = line.vertex[0], &b = line.vertex[1];
    const double da = plane_distance(a.position, plane, guard), db = plane_distance(b.position, plane, guard);
    if (da < 0.0 && db < 0.0) return line;
    if (db < 0.0) {
      b = intersection(a, b, da, db, true);
    } else if (da < 0.0) {
      a = intersection(b, a, db, da, true);
    }
  }
  line.count = 2;
  if (!has_usable_w(line)) line.count = 0;
  return line;
}

bool is_in_view_volume(const glm::vec4& p) {
  return std::isfinite(p.w) && p.w >= kSmallestW && std::fabs(p.z) <= p.w && is_between_sides(p);
}

bool is_between_sides(const glm::vec4& p) {
  return std::fabs(p.x) <= p.w && std::fabs(p.y) <= p.w;
}

bool is_beyond_a_side(const std::array<glm::vec4, 2>& clip) {
  return are_beyond_a_side(clip);
}

}  // namespace ninebit
