#include "ninebit/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace ninebit {
namespace {

double squared_distance_to_segment(const glm::dvec3& point, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 along = to - from;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(point - from, along) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 gap = point - (from + t * along);
  return glm::dot(gap, gap);
}

double squared_distance_to_triangle(const glm::dvec3& point, const std::array<glm::dvec3, 3>& corner) {
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double normal2 = glm::dot(normal, normal);
  bool above_the_inside = normal2 > 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& from = corner[i];
    const glm::dvec3& to = corner[(i + 1) % 3];
    above_the_inside = above_the_inside && glm::dot(glm::cross(to - from, point - from), normal) >= 0.0;
    nearest = std::min(nearest, squared_distance_to_segment(point, from, to));
  }
  if (!above_the_inside) return nearest;
  const double height = glm::dot(point - corner[0], normal);
  return std::min(nearest, height * height / normal2);
}

float distance_to(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles, const glm::vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  const glm::dvec3 from(point);
  for (const glm::uvec3& triangle : triangles) {
    const std::array<glm::dvec3, 3> corners{glm::dvec3(positions[triangle.x]), glm::dvec3(positions[triangle.y]),
                                            glm::dvec3(positions[triangle.z])};
    nearest = std::min(nearest, squared_distance_to_triangle(from, corners));
  }
  return static_cast<float>(std::sqrt(nearest));
}

}  // namespace

Bounds bounds_of(const Scene& scene) {
  if (scene.triangles.empty()) return {};
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  for (const glm::uvec3& triangle : scene.triangles) {
    for (glm::length_t i = 0; i < 3; ++i) {
      const glm::vec3& position = scene.positions[triangle[i]];
      bounds.low = glm::min(bounds.low, position);
      bounds.high = glm::max(bounds.high, position);
    }
  }
  return bounds;
}

float distance_to_nearest_triangle(const Scene& scene, const glm::vec3& point) {
  return distance_to(scene.positions, scene.triangles, point);
}

float distance_to_nearest_triangle(const Scene& scene, const SceneObject& object, const glm::vec3& point) {
  return distance_to(scene.positions, std::span(scene.triangles).subspan(object.first_triangle, object.triangle_count),
                     point);
}

}  // namespace ninebit
