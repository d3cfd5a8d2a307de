#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

std::optional<std::size_t> first_not_finite(const std::vector<glm::vec3>& all) {
  const auto found = std::find_if_not(all.begin(), all.end(), is_finite);
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

Status check_sizes(const Scene& scene) {
  const std::size_t count = scene.triangles.size();
  if (count == 0) return invalid("the scene has no triangles");
  if (scene.normals.size() != scene.positions.size()) {
    return invalid(fmt::format("the scene has {} normals for {} positions; expected one for each", scene.normals.size(),
                               scene.positions.size()));
  }
  for (const auto& [size, what] :
       {std::pair{scene.texture_coordinates.size(), "texture coordinates"},
        std::pair{scene.tangents.size(), "tangents"}, std::pair{scene.colors.size(), "vertex colours"},
        std::pair{scene.secondary_colors.size(), "secondary colours"},
        std::pair{scene.fog_factors.size(), "fog factors"}}) {
    if (size == 0 || size == scene.positions.size()) continue;
    return invalid(fmt::format("the scene has {} {} for {} positions; expected one for each, or none", size, what,
                               scene.positions.size()));
  }
  if (scene.triangle_object.size() != count || scene.triangle_material.size() != count) {
    return invalid(
        fmt::format("the scene has objects for {} and materials for {} of its {} triangles; expected both for each",
                    scene.triangle_object.size(), scene.triangle_material.size(), count));
  }
  return {};
}

Status check_triangles(const Scene& scene) {
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const glm::uvec3& corners = scene.triangles[t];
    const std::uint32_t highest = std::max({corners.x, corners.y, corners.z});
    if (highest >= scene.positions.size()) {
      return invalid(
          fmt::format("triangle {} uses vertex {}; expected one of {}, from 0", t, highest, scene.positions.size()));
    }
    if (scene.triangle_object[t] >= scene.objects.size()) {
      return invalid(fmt::format("triangle {} belongs to object {}; expected one of {}, from 0", t,
                                 scene.triangle_object[t], scene.objects.size()));
    }
    if (scene.triangle_material[t] >= scene.materials.size()) {
      return invalid(fmt::format("triangle {} has material {}; expected one of {}, from 0", t,
                                 scene.triangle_material[t], scene.materials.size()));
    }
  }
  return {};
}

Status check_objects(const Scene& scene) {
  std::size_t covered = 0;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (object.first_triangle != covered || object.triangle_count > scene.triangles.size() - covered) {
      return invalid(fmt::format(
          "object {} (\"{}\") has {} triangles from {}; expected the triangles that follow the last object's, from {}",
          i, object.name, object.triangle_count, object.first_triangle, covered));
    }
    for (; covered < std::size_t{object.first_triangle} + object.triangle_count; ++covered) {
      if (scene.triangle_object[covered] != i) {
        return invalid(
            fmt::format("triangle {} is among those of object {} and belongs to object {}; expected the same object",
                        covered, i, scene.triangle_object[covered]));
      }
    }
  }
  if (covered == scene.triangles.size()) return {};
  return invalid(
      fmt::format("the objects cover {} of {} triangles; expected all of them", covered, scene.triangles.size()));
}

Status check_values(const Scene& scene) {
  if (const auto at = first_not_finite(scene.positions)) {
    return invalid(fmt::format("the position of vertex {} is not finite", *at));
  }
  if (const auto at = first_not_finite(scene.normals)) {
    return invalid(fmt::format("the normal of vertex {} is not finite", *at));
  }
  for (std::size_t i = 0; i < scene.texture_coordinates.size(); ++i) {
    if (is_finite(glm::vec3(scene.texture_coordinates[i], 0.0F))) continue;
    return invalid(fmt::format("the texture coordinate of vertex {} is not finite", i));
  }
  for (std::size_t i = 0; i < scene.tangents.size(); ++i) {
    if (is_finite(glm::vec3(scene.tangents[i])) && std::isfinite(scene.tangents[i].w)) continue;
    return invalid(fmt::format("the tangent of vertex {} is not finite", i));
  }
  for (const auto& [colors, what] :
       {std::pair{&scene.colors, "colour"}, std::pair{&scene.secondary_colors, "secondary colour"}}) {
    for (std::size_t i = 0; i < colors->size(); ++i) {
      if (is_finite(glm::vec3((*colors)[i])) && std::isfinite((*colors)[i].w)) continue;
      return invalid(fmt::format("the {} of vertex {} is not finite", what, i));
    }
  }
  for (std::size_t i = 0; i < scene.fog_factors.size(); ++i) {
    if (!std::isfinite(scene.fog_factors[i]))
      return invalid(fmt::format("the fog factor of vertex {} is not finite", i));
  }
  for (const Material& material : scene.materials) {
    if (!is_finite(material.base_color)) {
      return invalid(fmt::format("the base colour of material \"{}\" is not finite", material.name));
    }
    if (!std::isfinite(material.alpha) || !std::isfinite(material.alpha_cutoff)) {
      return invalid(fmt::format("the alpha or alpha cutoff of material \"{}\" is not finite", material.name));
    }
    if (material.base_texture && *material.base_texture >= scene.textures.size()) {
      return invalid(fmt::format("material \"{}\" has texture {}; expected one of {}, from 0", material.name,
                                 *material.base_texture, scene.textures.size()));
    }
  }
  return {};
}

Status check_light(const Light& light) {
  if (!is_finite(light.position) || !is_finite(light.color)) {
    return invalid(fmt::format("the position or colour of light \"{}\" is not finite", light.name));
  }
  if (light.kind == LightKind::point) return {};
  const float length = is_finite(light.direction) ? glm::length(light.direction) : 0.0F;
  if (!(length > 0.999F && length < 1.001F)) {
    return invalid(fmt::format("light \"{}\" has no valid direction; expected a vector of length 1", light.name));
  }
  if (light.kind == LightKind::spot && !(light.spot_degrees > 0.0F && light.spot_degrees < 180.0F)) {
    return invalid(fmt::format("the opening angle of light \"{}\" is {} degrees; expected one between 0 and 180",
                               light.name, light.spot_degrees));
  }
  return {};
}

Status check_camera(const Camera& camera, std::size_t i) {
  if (!is_finite(camera.position) || !is_finite(camera.look_at) || !is_finite(camera.up)) {
    return invalid(fmt::format("the position, look-at point or up vector of camera {} is not finite", i));
  }
  if (!(camera.vertical_fov_degrees > 0.0F && camera.vertical_fov_degrees < 180.0F)) {
    return invalid(fmt::format("the vertical field of view of camera {} is {} degrees; expected one between 0 and 180",
                               i, camera.vertical_fov_degrees));
  }
  const glm::dvec3 ahead = glm::dvec3(camera.look_at) - glm::dvec3(camera.position);
  if (glm::cross(ahead, glm::dvec3(camera.up)) == glm::dvec3(0.0)) {
    return invalid(
        fmt::format("camera {} looks along its up vector, or at its own position; expected a view direction, "
                    "and an up vector that is not parallel to it",
                    i));
  }
  return {};
}

}  // namespace

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Status validate_geometry(const Scene& scene) {
  for (const auto check : {check_sizes, check_triangles, check_objects, check_values}) {
    if (Status checked = check(scene); !checked) return checked;
  }
  return {};
}

Status validate(const Scene& scene) {
  if (Status checked = validate_geometry(scene); !checked) return checked;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    if (Status checked = check_camera(scene.cameras[i], i); !checked) return checked;
  }
  for (const Light& light : scene.lights) {
    if (Status checked = check_light(light); !checked) return checked;
  }
  return {};
}

}  // namespace ninebit
