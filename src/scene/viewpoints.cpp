#include "src/scene/viewpoints.h"

#include <algorithm>
#include <cmath>

#include "src/scene/fault_of.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

glm::vec3 moved(const glm::dmat4& by, const glm::vec3& point) {
  return glm::vec3(glm::dvec3(by * glm::dvec4(glm::dvec3(point), 1.0)));
}

// Moves the look-at point along the view axis to beside the scene's middle, which is what the camera seems to look at.
// If the middle is behind the camera, any distance will do.
void move_look_at(Camera& camera, const Bounds& bounds) {
  const glm::dvec3 position(camera.position);
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera.look_at) - position);
  const double diagonal = static_cast<double>(bounds.diagonal());
  double distance = glm::dot(glm::dvec3(bounds.center()) - position, ahead);
  if (distance < 1e-3 * diagonal) distance = diagonal > 0.0 ? diagonal : 1.0;
  const glm::vec3 on_axis(position + ahead * distance);
  if (is_finite(on_axis)) camera.look_at = on_axis;
}

}  // namespace

std::optional<Diagnostic> add_viewpoints(const Viewpoints& viewpoints, const glm::dmat4& place, Scene& scene) {
  for (Camera camera : viewpoints.cameras) {
    camera.position = moved(place, camera.position);
    camera.look_at = moved(place, camera.look_at);
    camera.up = glm::vec3(glm::dmat3(place) * glm::dvec3(camera.up));
    if (!is_finite(camera.position) || !is_finite(camera.look_at) || !is_finite(camera.up))
      return fault_of("a camera's position or direction is not finite");
    if (camera.look_at == camera.position) return fault_of("a camera has no view direction");
    scene.cameras.push_back(camera);
  }
  for (Light light : viewpoints.lights) {
    light.position = moved(place, light.position);
    if (!is_finite(light.position)) return fault_of("a light's position is not finite");
    if (light.kind != LightKind::point) {
      const glm::dvec3 direction = glm::dmat3(place) * glm::dvec3(light.direction);
      const double length = glm::length(direction);
      if (!(length > 0.0) || !std::isfinite(length)) return fault_of("a spot or directional light has no direction");
      light.direction = glm::vec3(direction / length);
    }
    const glm::vec3 color = is_finite(light.color) ? glm::max(light.color, 0.0F) : glm::vec3(1.0F);
    const float largest = std::max({color.r, color.g, color.b});
    light.color = largest > 0.0F ? glm::min(color / largest, 1.0F) : glm::vec3(0.0F);
    scene.lights.push_back(light);
  }
  return std::nullopt;
}

void move_look_at_points(Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  for (Camera& camera : scene.cameras) move_look_at(camera, bounds);
}

}  // namespace ninebit
