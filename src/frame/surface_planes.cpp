#include "src/frame/surface_planes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/frame/shading.h"

namespace ninebit {

VertexArrays SurfaceAttributes::arrays() const {
  VertexArrays arrays;
  for (std::size_t a = 0; a < values.size(); ++a) arrays.attributes[a] = values[a];
  return arrays;
}

SurfaceAttributes surface_attributes(const Scene& scene, const glm::vec3& color) {
  SurfaceAttributes out;
  for (auto& values : out.values) values.resize(scene.positions.size());
  const std::vector<std::uint32_t> material = vertex_materials(scene);
  for (std::size_t v = 0; v < scene.positions.size(); ++v) {
    out.values[SurfaceAttributes::kPosition][v] = glm::vec4(scene.positions[v], 1.0F);
    out.values[SurfaceAttributes::kNormal][v] = glm::vec4(scene.normals[v], 0.0F);
    out.values[SurfaceAttributes::kColor][v] = glm::vec4(scene.materials[material[v]].base_color * color, 1.0F);
  }
  return out;
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
  const float length = std::sqrt(glm::dot(v, v));
  return length > 0.0F ? v / length : glm::vec3(0.0F);
}

}  // namespace ninebit
