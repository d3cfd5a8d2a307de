#include "src/scene/polygon.h"

#include <cmath>

namespace ninebit {
namespace {

// Twice the signed area of a triangle in the plane that the polygon was projected to.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Projects along the largest axis of the polygon's normal, so that its winding comes out counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners) {
  glm::dvec3 normal(0.0);
  const glm::dvec3 origin(corners[0]);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
  const glm::dvec3 size = glm::abs(normal);
  const glm::length_t drop = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
  const glm::length_t u = (drop + 1) % 3;
  const glm::length_t v = (drop + 2) % 3;
  const double turn = normal[drop] < 0.0 ? -1.0 : 1.0;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& corner : corners) {
    const glm::dvec3 relative = glm::dvec3(corner) - origin;
    flat.emplace_back(relative[u], relative[v] * turn);
  }
  return flat;
}

// Convex as a fan needs it: every triangle of the fan has its area on the same side.
bool fan_is_valid(const std::vector<glm::dvec2>& flat) {
  for (std::size_t i = 1; i + 1 < flat.size(); ++i) {
    if (area2(flat[0], flat[i], flat[i + 1]) < 0.0) return false;
  }
  return true;
}

bool is_ear(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t count = left.size();
  const glm::dvec2& a = flat[left[(at + count - 1) % count]];
  const glm::dvec2& b = flat[left[at]];
  const glm::dvec2& c = flat[left[(at + 1) % count]];
  if (area2(a, b, c) <= 0.0) return false;
  for (std::size_t i = 2; i + 1 < count; ++i) {
    const glm::dvec2& p = flat[left[(at + i) % count]];
    if (p == a || p == b || p == c) continue;
    if (area2(a, b, p) >= 0.0 && area2(b, c, p) >= 0.0 && area2(c, a, p) >= 0.0) return false;
  }
  return true;
}

}  // namespace

bool triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto count = static_cast<std::uint32_t>(corners.size());
  std::vector<std::uint32_t> left(count);
  for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
  if (count > 3) {
    const std::vector<glm::dvec2> flat = project(corners);
    const bool concave = !fan_is_valid(flat);
    if (concave && count > kMostConcaveCorners) return false;
    // Searching on from the last ear, not from the start, keeps the usual polygon at one pass of tests per ear.
    std::size_t at = 1;
    std::size_t refused = 0;
    while (concave && left.size() > 3 && refused < left.size()) {
      at %= left.size();
      if (!is_ear(flat, left, at)) {
        ++at;
        ++refused;
        continue;
      }
      const std::size_t size = left.size();
      triangles.push_back({left[(at + size - 1) % size], left[at], left[(at + 1) % size]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
      refused = 0;
    }
  }
  for (std::size_t i = 1; i + 1 < left.size(); ++i) triangles.push_back({left[0], left[i], left[i + 1]});
  return true;
}

}  // namespace ninebit
