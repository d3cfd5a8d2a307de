#include "src/frame/shading.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ninebit/language/gl_nv.h"
#include "ninebit/numerics/fixed9.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr float kAmbient = 0.22F;
constexpr float kDiffuseInShadow = 0.25F;  // of the diffuse light

// A cartoon's brightness for cosines from `cosine` on.
struct Band {
  double cosine;
  float brightness;
};
constexpr std::array kBands{Band{0.85, 1.3F}, Band{0.5, 1.1F}, Band{0.2, 0.9F}, Band{-1.0, 0.72F}};
constexpr glm::vec3 kInk{0.055F, 0.05F, 0.085F};
constexpr float kBaseInInk = 0.07F;

glm::vec3 to_light(const Light& light, const glm::vec3& from) {
  return light.kind == LightKind::directional ? -light.direction : light.position - from;
}

ColorBytes bytes_of(const HardwareProfile& profile, const glm::vec3& color) {
  ColorBytes bytes{0, 0, 0, 255};
  for (int c = 0; c < 3; ++c) bytes[static_cast<std::size_t>(c)] = byte_of_vertex_color(profile, color[c]);
  return bytes;
}

VertexShading shade_flat(const Scene& scene, const Light& light, const RenderSettings& settings) {
  const std::size_t count = scene.triangles.size();
  VertexShading shading{std::vector<ColorBytes>(count), std::vector<ColorBytes>(count)};
  parallel_ranges(count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t != end; ++t) {
      const glm::uvec3& v = scene.triangles[t];
      const glm::dvec3 a(scene.positions[v.x]), b(scene.positions[v.y]), c(scene.positions[v.z]);
      const glm::dvec3 normal = glm::cross(b - a, c - a), toward(to_light(light, glm::vec3((a + b + c) / 3.0)));
      const double lengths = std::sqrt(glm::dot(normal, normal)) * std::sqrt(glm::dot(toward, toward));
      double cosine = lengths > 0.0 ? glm::dot(normal, toward) / lengths : 1.0;
      if (!settings.light_facing) cosine = std::fabs(cosine);
      std::size_t band = 0;
      while (band + 1 < kBands.size() && cosine < kBands[band].cosine) ++band;
      const glm::vec3 base = scene.materials[scene.triangle_material[t]].base_color;
      shading.lit[t] = bytes_of(settings.profile, base * light.color * kBands[band].brightness);
      shading.shadowed[t] = bytes_of(settings.profile, kInk + base * kBaseInInk);
    }
  });
  return shading;
}

// Calls `visit` for each vertex with its number, its base colour and the diffuse light of each channel that reaches it.
template <class Visit>
void for_each_vertex(const Scene& scene, const Light& light, const RenderSettings& settings, const Visit& visit) {
  const std::size_t count = scene.positions.size();
  const std::vector<std::uint32_t> material = vertex_materials(scene);
  parallel_ranges(count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v != end; ++v) {
      const glm::vec3 toward = to_light(light, scene.positions[v]);
      const glm::vec3& normal = scene.normals[v];
      const float length = std::sqrt(glm::dot(toward, toward));
      float cosine = length > 0.0F ? glm::dot(normal, toward) / length : 1.0F;
      // A vertex without a normal is lit as if it faced the light.
      if (glm::dot(normal, normal) == 0.0F) cosine = 1.0F;
      cosine = settings.light_facing ? std::max(cosine, 0.0F) : std::fabs(cosine);
      glm::vec3 base = scene.materials[material[v]].base_color;
      if (!scene.colors.empty()) base *= glm::vec3(scene.colors[v]);
      visit(v, base, kDiffuseLight * cosine * light.color);
    }
  });
}

}  // namespace

std::vector<std::uint32_t> vertex_materials(const Scene& scene) {
  std::vector<std::uint32_t> material(scene.positions.size(), 0);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) material[scene.triangles[t][corner]] = scene.triangle_material[t];
  }
  return material;
}

VertexShading shade_vertices(const Scene& scene, const Light& light, const RenderSettings& settings) {
  if (settings.cartoon) return shade_flat(scene, light, settings);
  const std::size_t count = scene.positions.size();
  VertexShading shading{std::vector<ColorBytes>(count), std::vector<ColorBytes>(count)};
  for_each_vertex(scene, light, settings, [&](std::size_t v, const glm::vec3& base, const glm::vec3& diffuse) {
    shading.lit[v] = bytes_of(settings.profile, base * (kAmbient + diffuse));
    shading.shadowed[v] = bytes_of(settings.profile, base * (kAmbient + diffuse * kDiffuseInShadow));
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

Result<CombinerState> surface_state(const HardwareProfile& profile, SurfaceColor color, std::uint8_t alpha) {
  using namespace gl;
  return combiner_state_after(profile, "surface's texture", [color, alpha] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    const std::array<GLfloat, 4> constant0{0.0F, 0.0F, 0.0F, static_cast<GLfloat>(alpha) / 255.0F};
    glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, constant0.data());

    // Stage 0, RGB: spare0 = primary · texture0, or primary · 1.
    const bool textured = color == SurfaceColor::primary_times_texture;
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, textured ? GL_TEXTURE0_ARB : GL_ZERO,
                      textured ? GL_UNSIGNED_IDENTITY_NV : GL_UNSIGNED_INVERT_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE,
                       GL_FALSE, GL_FALSE);

    // Stage 0, alpha: spare0 = texture0 · constant0.
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE,
                       GL_FALSE, GL_FALSE, GL_FALSE);

    // Final combiner: RGB = spare0, alpha = spare0.alpha.
    glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
  });
}

Result<Program> surface_program(const HardwareProfile& profile, SurfaceColor color, std::uint8_t alpha) {
  const auto state = surface_state(profile, color, alpha);
  if (!state) return state.error();
  return compile(*state, profile);
}

}  // namespace ninebit
