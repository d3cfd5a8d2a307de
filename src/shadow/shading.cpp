#include "src/shadow/shading.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ninebit/numerics/fixed9.h"

namespace ninebit {
namespace {

constexpr float kAmbient = 0.22F;
constexpr float kDiffuseInShadow = 0.25F;  // of the diffuse light

}  // namespace

std::vector<std::uint32_t> vertex_materials(const Scene& scene) {
  std::vector<std::uint32_t> material(scene.positions.size(), 0);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) material[scene.triangles[t][corner]] = scene.triangle_material[t];
  }
  return material;
}

VertexShading shade_vertices(const Scene& scene, const Light& light, const RenderSettings& settings) {
  const std::size_t count = scene.positions.size();
  const std::vector<std::uint32_t> material = vertex_materials(scene);
  VertexShading shading{std::vector<ColorBytes>(count), std::vector<ColorBytes>(count)};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) {
      const glm::vec3 to_light =
          light.kind == LightKind::directional ? -light.direction : light.position - scene.positions[v];
      const glm::vec3& normal = scene.normals[v];
      const float length = std::sqrt(glm::dot(to_light, to_light));
      float cosine = length > 0.0F ? glm::dot(normal, to_light) / length : 1.0F;
      // A vertex without a normal is lit as if it faced the light.
      if (glm::dot(normal, normal) == 0.0F) cosine = 1.0F;
      cosine = settings.light_facing ? std::max(cosine, 0.0F) : std::fabs(cosine);
      const glm::vec3 base = scene.materials[material[v]].base_color;
      for (int c = 0; c < 3; ++c) {
        const float diffuse = kDiffuseLight * cosine * light.color[c];
        const auto i = static_cast<std::size_t>(c);
        shading.lit[v][i] = byte_of_vertex_color(settings.profile, base[c] * (kAmbient + diffuse));
        shading.shadowed[v][i] =
            byte_of_vertex_color(settings.profile, base[c] * (kAmbient + diffuse * kDiffuseInShadow));
      }
      shading.lit[v][3] = shading.shadowed[v][3] = 255;
    }
  });
  return shading;
}

}  // namespace ninebit
