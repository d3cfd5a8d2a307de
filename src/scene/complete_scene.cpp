#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ninebit/scene/scene_io.h"
#include "src/scene/framing.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

constexpr float kTooClose = 1e-6F;  // of the bounding diagonal
constexpr float kMinFov = 0.01F;
constexpr float kMaxFov = 170.0F;
constexpr float kNarrowestSpot = 1.0F;
constexpr float kWidestSpot = 170.0F;

glm::vec3 any_axis_across(const glm::vec3& direction) {
  const glm::vec3 size = glm::abs(direction);
  if (size.y <= size.x && size.y <= size.z) return {0.0F, 1.0F, 0.0F};
  return size.z <= size.x ? glm::vec3(0.0F, 0.0F, 1.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
}

Status check_setup(const SceneSetup& setup, float aspect_ratio) {
  if (!std::isfinite(aspect_ratio) || aspect_ratio <= 0.0F) return invalid("the aspect ratio must be greater than 0");
  if (setup.camera && !is_finite(*setup.camera)) return invalid("the camera's position must be finite");
  if (setup.look_at && !is_finite(*setup.look_at)) return invalid("the point to look at must be finite");
  if (setup.light && !is_finite(*setup.light)) return invalid("the light's position must be finite");
  if (setup.light_target && !is_finite(*setup.light_target)) return invalid("the light's target must be finite");
  if (setup.spot_degrees && !(*setup.spot_degrees >= kNarrowestSpot && *setup.spot_degrees <= kWidestSpot)) {
    return invalid(fmt::format("the spot light's opening angle is {} degrees; expected one from {} to {} degrees",
                               *setup.spot_degrees, kNarrowestSpot, kWidestSpot));
  }
  if (setup.floor == FloorChoice::at_height && !std::isfinite(setup.floor_height))
    return invalid("the floor's height must be finite");
  return {};
}

Status check_fov(float degrees) {
  if (degrees >= kMinFov && degrees <= kMaxFov) return {};
  return invalid(fmt::format("the vertical field of view is {} degrees; expected one from {} to {} degrees", degrees,
                             kMinFov, kMaxFov));
}

// The light that complete_scene's contract selects, not yet moved or aimed. `aimed`: the file gives its direction.
Light choose_light(const Scene& scene, const LightKinds& kinds, const Light& framing, bool& aimed) {
  aimed = false;
  for (const Light& light : scene.lights) {
    if (!kinds.has(light.kind)) continue;
    aimed = light.kind != LightKind::point;
    return light;
  }
  if (kinds.point) return framing;
  Light light = framing;
  for (std::size_t i = scene.lights.size(); i-- > 0;) {
    if (scene.lights[i].kind == LightKind::point) light = scene.lights[i];
  }
  light.kind = kinds.spot ? LightKind::spot : LightKind::directional;
  return light;
}

// Moves and aims the light as the setup says. `fitted`: the light is a spot that neither the file nor the setup aims.
Status place_light(Light& light, bool aimed, const SceneSetup& setup, const Bounds& bounds, bool& fitted) {
  fitted = light.kind == LightKind::spot && !aimed && !setup.light_target && !setup.spot_degrees;
  light.position = setup.light.value_or(light.position);
  if (light.kind == LightKind::point) {
    if (!setup.light_target) return {};
    return invalid("a point light shines everywhere; expected no target, or a spot or directional light");
  }
  light.spot_degrees = setup.spot_degrees.value_or(light.spot_degrees);
  if (light.kind == LightKind::directional && setup.light) aimed = false;
  if (aimed && !setup.light_target) return {};
  const glm::vec3 target = setup.light_target.value_or(bounds.center());
  if (Status checked = check_range("the point that the light shines at,", target); !checked) return checked;
  const glm::dvec3 direction = glm::dvec3(target) - glm::dvec3(light.position);
  const double length = glm::length(direction);
  if (!(length > static_cast<double>(kTooClose * scale_of(bounds)))) {
    return invalid("the light has no direction: it is at the point that it shines at");
  }
  light.direction = glm::vec3(direction / length);
  return {};
}

void add_floor(Scene& scene, const FloorReach& reach, float height) {
  const auto first_vertex = static_cast<std::uint32_t>(scene.positions.size());
  const auto material = static_cast<std::uint32_t>(scene.materials.size());
  scene.objects.push_back({"floor", static_cast<std::uint32_t>(scene.triangles.size()), 2});
  scene.materials.push_back({"floor", glm::vec3(0.75F)});
  constexpr std::array<glm::vec2, 4> kCorners{glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1), glm::vec2(-1, -1)};
  for (const glm::vec2& corner : kCorners) {
    scene.positions.emplace_back(corner.x < 0.0F ? reach.low.x : reach.high.x, height,
                                 corner.y < 0.0F ? reach.low.y : reach.high.y);
    scene.normals.emplace_back(0.0F, 1.0F, 0.0F);
    if (!scene.texture_coordinates.empty()) scene.texture_coordinates.push_back((corner + 1.0F) * 0.5F);
    if (!scene.tangents.empty()) scene.tangents.emplace_back(1.0F, 0.0F, 0.0F, 1.0F);
    if (!scene.colors.empty()) scene.colors.emplace_back(1.0F);
    if (!scene.secondary_colors.empty()) scene.secondary_colors.emplace_back(0.0F, 0.0F, 0.0F, 1.0F);
    if (!scene.fog_factors.empty()) scene.fog_factors.push_back(1.0F);
  }
  for (const glm::uvec3& corners : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
    scene.triangles.push_back(corners + first_vertex);
    scene.triangle_object.push_back(static_cast<std::uint32_t>(scene.objects.size() - 1));
    scene.triangle_material.push_back(material);
  }
}

Status check_places(const Camera& camera, const Light& light) {
  if (Status checked = check_range("the camera", camera.position); !checked) return checked;
  if (Status checked = check_range("the point that the camera looks at,", camera.look_at); !checked) return checked;
  return check_range("the light", light.position);
}

// A file's up vector fits only the file's view direction: with another direction it would roll the picture.
void fix_up(Camera& camera, bool view_changed) {
  if (view_changed) camera.up = {0.0F, 1.0F, 0.0F};
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera.look_at) - glm::dvec3(camera.position));
  const double length = glm::length(glm::dvec3(camera.up));
  const bool usable =
      length > 0.0 && std::isfinite(length) && glm::length(glm::cross(ahead, glm::dvec3(camera.up) / length)) > 1e-4;
  if (!usable) {
    camera.up = any_axis_across(glm::vec3(ahead));
  } else if (length < 1e-6 || length > 1e6) {
    camera.up = glm::vec3(glm::dvec3(camera.up) / length);  // its square may overflow or vanish in a float
  }
}

}  // namespace

Result<Scene> complete_scene(Scene scene, const SceneSetup& setup, float aspect_ratio) {
  if (Status checked = check_setup(setup, aspect_ratio); !checked) return checked.error();
  if (Status checked = validate_geometry(scene); !checked) return checked.error();
  if (Status checked = check_positions(scene, 0, "the scene is"); !checked) return checked.error();
  const Bounds bounds = bounds_of(scene);
  const float scale = scale_of(bounds);
  const bool bare = scene.cameras.empty() && scene.lights.empty();

  const float own_fov = scene.cameras.empty() ? Camera{}.vertical_fov_degrees : scene.cameras[0].vertical_fov_degrees;
  const float fov = setup.fov_degrees.value_or(own_fov);
  if (Status checked = check_fov(fov); !checked) return checked.error();
  const Camera framing = framing_camera(scene, bounds, fov, aspect_ratio);
  Camera camera = scene.cameras.empty() ? framing : scene.cameras[0];
  camera.vertical_fov_degrees = fov;
  // The default light follows the file's or the default view, not the user's, so that moving the camera does not move
  // the shadows.
  bool aimed = false, fitted = false;
  Light light = choose_light(scene, setup.light_kinds, framing_light(bounds, camera), aimed);
  if (Status placed = place_light(light, aimed, setup, bounds, fitted); !placed) return placed.error();
  camera.position = setup.camera.value_or(camera.position);
  camera.look_at = setup.look_at.value_or(camera.look_at);

  if (Status checked = check_places(camera, light); !checked) return checked.error();
  if (glm::distance(camera.position, camera.look_at) <= kTooClose * scale)
    return invalid("the camera is at the point that it looks at");
  const bool somewhere = light.kind != LightKind::directional;
  if (somewhere && glm::distance(camera.position, light.position) <= kTooClose * scale)
    return invalid("the camera is at the light's position, from which no shadow is visible");
  fix_up(camera, setup.camera.has_value() || setup.look_at.has_value());

  const std::size_t first_floor_vertex = scene.positions.size();
  if (setup.floor == FloorChoice::at_height) {
    add_floor(scene, floor_reach(bounds, framing, aspect_ratio, setup.floor_height), setup.floor_height);
  } else if (setup.floor == FloorChoice::automatic && bare) {
    // A little below the model: a floor in the plane of the model's underside would z-fight with it.
    const float height = bounds.low.y - 1e-3F * scale;
    add_floor(scene, floor_reach(bounds, framing, aspect_ratio, height), height);
  }
  if (Status checked = check_positions(scene, first_floor_vertex, "the floor is"); !checked) return checked.error();
  if (fitted) fit_spot(scene, camera, aspect_ratio, light);
  scene.cameras = {camera};
  scene.lights = {light};
  if (Status checked = validate(scene); !checked) return checked.error();
  if (somewhere) {
    if (Status checked = check_light_in_the_open(scene, light, camera); !checked) return checked.error();
  }
  return scene;
}

}  // namespace ninebit
