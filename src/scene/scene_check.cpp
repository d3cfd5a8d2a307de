#include "src/scene/scene_check.h"

#include <fmt/format.h>

namespace ninebit {
namespace {

constexpr float kMaxCoordinate = 1e12F;
constexpr double kInside = 0.75;
constexpr float kOnSurface = 1e-6F;  // of the object's diagonal

Bounds bounds_of(const Scene& scene, const SceneObject& object) {
  Bounds bounds{glm::vec3(kMaxCoordinate), glm::vec3(-kMaxCoordinate)};
  for (std::size_t i = 0; i < object.triangle_count; ++i) {
    const glm::uvec3& t = scene.triangles[object.first_triangle + i];
    for (glm::length_t k = 0; k < 3; ++k) {
      bounds.low = glm::min(bounds.low, scene.positions[t[k]]);
      bounds.high = glm::max(bounds.high, scene.positions[t[k]]);
    }
  }
  return bounds;
}

bool contains(const Bounds& bounds, const glm::vec3& point) {
  return glm::all(glm::lessThan(bounds.low, point)) && glm::all(glm::lessThan(point, bounds.high));
}

bool within_range(const glm::vec3& v) {
  return glm::all(glm::lessThanEqual(glm::abs(v), glm::vec3(kMaxCoordinate)));
}

}  // namespace

Status check_range(const std::string& what, const glm::vec3& at) {
  if (within_range(at)) return {};
  return invalid(fmt::format("{} at ({}, {}, {}) is too far out; expected coordinates from -1e12 to 1e12", what, at.x,
                             at.y, at.z));
}

Status check_positions(const Scene& scene, std::size_t first_vertex, const std::string& what) {
  for (std::size_t i = first_vertex; i < scene.positions.size(); ++i) {
    const glm::vec3& at = scene.positions[i];
    if (within_range(at)) continue;
    return invalid(fmt::format("{} too large: one vertex is at ({}, {}, {}); expected coordinates from -1e12 to 1e12",
                               what, at.x, at.y, at.z));
  }
  return {};
}

Status check_light_in_the_open(const Scene& scene, const Light& light, const Camera& camera) {
  for (const SceneObject& object : scene.objects) {
    // Sheets one behind the other can have any solid angle, but no point outside their box is inside.
    const Bounds bounds = bounds_of(scene, object);
    if (!contains(bounds, light.position) || winding_number(scene, object, light.position) <= kInside ||
        winding_number(scene, object, camera.position) > kInside ||
        distance_to_nearest_triangle(scene, object, light.position) <= kOnSurface * bounds.diagonal()) {
      continue;
    }
    return invalid(
        fmt::format("the light at ({}, {}, {}) is inside a solid (\"{}\") and the camera is not; expected a light in "
                    "the open",
                    light.position.x, light.position.y, light.position.z, object.name));
  }
  return {};
}

}  // namespace ninebit
