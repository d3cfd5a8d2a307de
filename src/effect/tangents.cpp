#include "src/effect/tangents.h"

#include <cmath>

namespace ninebit {
namespace {

glm::dvec3 any_perpendicular(const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                          : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                               : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 across = glm::cross(normal, axis);
  const double length = glm::length(across);
  return length > 0.0 ? across / length : glm::dvec3(1.0, 0.0, 0.0);
}

}  // namespace

std::vector<glm::vec4> tangents_of(const Scene& scene) {
  std::vector<glm::dvec3> along_s(scene.positions.size(), glm::dvec3(0.0)), along_up = along_s;
  for (const glm::uvec3& t : scene.triangles) {
    const glm::dvec3 edge1(scene.positions[t.y] - scene.positions[t.x]);
    const glm::dvec3 edge2(scene.positions[t.z] - scene.positions[t.x]);
    const glm::dvec2 uv1(scene.texture_coordinates[t.y] - scene.texture_coordinates[t.x]);
    const glm::dvec2 uv2(scene.texture_coordinates[t.z] - scene.texture_coordinates[t.x]);
    const double area = uv1.x * uv2.y - uv2.x * uv1.y;
    if (area == 0.0 || !std::isfinite(area)) continue;
    const glm::dvec3 s = (uv2.y * edge1 - uv1.y * edge2) / area;
    const glm::dvec3 up = (uv2.x * edge1 - uv1.x * edge2) / area;  // -dP/dt
    for (int corner = 0; corner < 3; ++corner) {
      along_s[t[corner]] += s;
      along_up[t[corner]] += up;
    }
  }
  std::vector<glm::vec4> tangents;
  tangents.reserve(scene.positions.size());
  for (std::size_t v = 0; v < scene.positions.size(); ++v) {
    const glm::dvec3 normal(scene.normals[v]);
    if (!scene.tangents.empty()) {
      const glm::dvec3 own(glm::vec3(scene.tangents[v]));
      const glm::dvec3 across = own - normal * glm::dot(normal, own);
      if (const double size = glm::length(across); size > 1e-3) {
        tangents.emplace_back(glm::vec3(across / size), scene.tangents[v].w);
        continue;
      }
    }
    glm::dvec3 tangent = along_s[v] - normal * glm::dot(normal, along_s[v]);
    const double length = glm::length(tangent);
    tangent = length > 0.0 && std::isfinite(length) ? tangent / length : any_perpendicular(normal);
    const double side = glm::dot(glm::cross(normal, tangent), along_up[v]);
    tangents.emplace_back(glm::vec3(tangent), side < 0.0 ? -1.0F : 1.0F);
  }
  return tangents;
}

}  // namespace ninebit
