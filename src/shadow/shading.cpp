#include "src/shadow/shading.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ninebit/numerics/fixed9.h"

namespace ninebit {
namespace {

constexpr float kAmbient = 0.22F;
constexpr float kDiffuse = 0.78F;
constexpr float kDiffuseInShadow = 0.25F;  // of the diffuse light

// Calls `visit` for each vertex with its number, its base colour and the diffuse light of each channel that reaches it.
template <class Visit>
void for_each_vertex(const Scene& scene, const Light& light, const RenderSettings& settings, const Visit& visit) {
  const std::size_t count = scene.positions.size();
  std::vector<std::uint32_t> material(count, 0);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) material[scene.triangles[t][corner]] = scene.triangle_material[t];
  }
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
      visit(v, scene.materials[material[v]].base_color, kDiffuse * cosine * light.color);
    }
  });
}

}  // namespace

VertexShading shade_vertices(const Scene& scene, const Light& light, const RenderSettings& settings) {
  const std::size_t count = scene.positions.size();
  VertexShading shading{std::vector<ColorBytes>(count), std::vector<ColorBytes>(count)};
  for_each_vertex(scene, light, settings, [&](std::size_t v, const glm::vec3& base, const glm::vec3& diffuse) {
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      shading.lit[v][i] = byte_of_vertex_color(settings.profile, base[c] * (kAmbient + diffuse[c]));
      shading.shadowed[v][i] =
          byte_of_vertex_color(settings.profile, base[c] * (kAmbient + diffuse[c] * kDiffuseInShadow));
    }
    shading.lit[v][3] = shading.shadowed[v][3] = 255;
  });
  return shading;
}

VertexLight light_vertices(const Scene& scene, const Light& light, const RenderSettings& settings) {
  const std::size_t count = scene.positions.size();
  VertexLight parts{std::vector<ColorBytes>(count), std::vector<ColorBytes>(count)};
  for_each_vertex(scene, light, settings, [&](std::size_t v, const glm::vec3& base, const glm::vec3& diffuse) {
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      parts.ambient[v][i] = byte_of_vertex_color(settings.profile, base[c] * kAmbient);
      parts.diffuse[v][i] = byte_of_vertex_color(settings.profile, base[c] * diffuse[c]);
    }
    parts.ambient[v][3] = parts.diffuse[v][3] = 255;
  });
  return parts;
}

}  // namespace ninebit
