#include "src/effect/vertex_sources.h"

#include <algorithm>
#include <cmath>

#include "ninebit/numerics/fixed9.h"
#include "src/frame/shading.h"
#include "src/frame/surface_groups.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

glm::vec3 towards_light(const Light& light, const glm::vec3& position) {
  return light.kind == LightKind::directional ? -light.direction : light.position - position;
}

// Window coordinates from 0 to 1 of a clip position, times q.
glm::vec4 window_of(const glm::vec4& clip) {
  return {(clip.x + clip.w) * 0.5F, (clip.y + clip.w) * 0.5F, (clip.z + clip.w) * 0.5F, clip.w};
}

// Computes the vectors of one vertex.
class VertexVectors {
 public:
  explicit VertexVectors(const VertexInputs& inputs)
      : inputs_(inputs), scene_(*inputs.scene), light_(scene_.lights[0]), camera_(scene_.cameras[0]) {}

  [[nodiscard]] glm::vec3 at(VertexSource source, std::size_t v) const {
    const glm::vec3& position = scene_.positions[v];
    const glm::vec3& normal = scene_.normals[v];
    switch (source) {
      case VertexSource::position:
        return position;
      case VertexSource::from_light:
        return light_.kind == LightKind::directional ? light_.direction : position - light_.position;
      case VertexSource::light_vector:
        return towards_light(light_, position);
      case VertexSource::view_vector:
        return camera_.position - position;
      case VertexSource::half_vector:
        return unit_or_zero(unit_or_zero(towards_light(light_, position)) + unit_or_zero(camera_.position - position));
      case VertexSource::normal:
        return normal;
      case VertexSource::reflection: {
        const glm::vec3 view = unit_or_zero(camera_.position - position);
        return unit_or_zero(2.0F * glm::dot(normal, view) * normal - view);
      }
      case VertexSource::tangent_light_vector:
        return in_tangent_space(at(VertexSource::light_vector, v), v);
      case VertexSource::tangent_half_vector:
        return in_tangent_space(at(VertexSource::half_vector, v), v);
      default:
        return glm::vec3(0.0F);
    }
  }

  // (s, t, r, q) before the matrix.
  [[nodiscard]] glm::vec4 coordinate(const CoordinateSource& source, std::size_t v) const {
    switch (source.source) {
      case VertexSource::constant:
        return source.constant;
      case VertexSource::uv:
        return {scene_.texture_coordinates[v], 0.0F, 1.0F};
      case VertexSource::screen:
        return window_of(inputs_.clip_from_world * glm::vec4(scene_.positions[v], 1.0F));
      case VertexSource::projected:
        return window_of(inputs_.light_clip_from_world * glm::vec4(scene_.positions[v], 1.0F));
      case VertexSource::tangent_to_world_x:
        return row_of_tangents(0, v);
      case VertexSource::tangent_to_world_y:
        return row_of_tangents(1, v);
      case VertexSource::tangent_to_world_z:
        return row_of_tangents(2, v);
      default:
        return {at(source.source, v), 1.0F};
    }
  }

 private:
  // Tangent, bitangent and normal.
  [[nodiscard]] glm::mat3 tangent_frame(std::size_t v) const {
    const glm::vec3& normal = scene_.normals[v];
    const glm::vec3 tangent((*inputs_.tangents)[v]);
    return {tangent, (*inputs_.tangents)[v].w * glm::cross(normal, tangent), normal};
  }
  [[nodiscard]] glm::vec3 in_tangent_space(const glm::vec3& vector, std::size_t v) const {
    const glm::mat3 frame = tangent_frame(v);
    return {glm::dot(frame[0], vector), glm::dot(frame[1], vector), glm::dot(frame[2], vector)};
  }
  [[nodiscard]] glm::vec4 row_of_tangents(int axis, std::size_t v) const {
    const glm::mat3 frame = tangent_frame(v);
    return {frame[0][axis], frame[1][axis], frame[2][axis], camera_.position[axis] - scene_.positions[v][axis]};
  }

  const VertexInputs& inputs_;
  const Scene& scene_;
  const Light& light_;
  const Camera& camera_;
};

// The colours of the file times the base colours.
std::vector<glm::vec4> surface_colors(const Scene& scene) {
  const std::vector<std::uint32_t> material = vertex_materials(scene);
  std::vector<glm::vec4> colors(scene.positions.size());
  for (std::size_t v = 0; v < colors.size(); ++v) {
    colors[v] = glm::vec4(scene.materials[material[v]].base_color, 1.0F);
    if (!scene.colors.empty()) colors[v] *= scene.colors[v];
  }
  return colors;
}

float fog_factor(const EffectFog& fog, float distance) {
  switch (fog.mode) {
    case FogMode::linear:
      return (fog.end - distance) / (fog.end - fog.start);
    case FogMode::exp:
      return std::exp(-fog.density * distance);
    case FogMode::exp2:
      return std::exp(-(fog.density * distance) * (fog.density * distance));
    case FogMode::registers:
      return distance;
    case FogMode::none:
    case FogMode::mesh:
      break;
  }
  return 1.0F;
}

}  // namespace

UnitCoordinates unit_coordinates(const CoordinateSource& source, const VertexInputs& inputs) {
  const std::size_t count = inputs.scene->positions.size();
  const VertexVectors vectors(inputs);
  const bool has_matrix = source.matrix != glm::mat4(1.0F);
  UnitCoordinates coordinates{std::vector<glm::vec3>(count), std::vector<float>(count)};
  parallel_for(count, kGrainOfCheapItems, [&](std::size_t v) {
    glm::vec4 at = vectors.coordinate(source, v);
    if (has_matrix) at = source.matrix * at;
    coordinates.str[v] = glm::vec3(at);
    coordinates.q[v] = at.w;
  });
  if (std::all_of(coordinates.q.begin(), coordinates.q.end(), [](float q) { return q == 1.0F; })) coordinates.q = {};
  return coordinates;
}

std::vector<ColorBytes> vertex_colors(const ColorSource& source, const VertexInputs& inputs,
                                      const HardwareProfile& profile) {
  const Scene& scene = *inputs.scene;
  const std::size_t count = scene.positions.size();
  const VertexVectors vectors(inputs);
  const bool from_surface = source.source == VertexSource::color || source.source == VertexSource::lambert;
  const std::vector<glm::vec4> surface = from_surface ? surface_colors(scene) : std::vector<glm::vec4>{};
  const auto color = [&](std::size_t v) -> glm::vec4 {
    if (source.source == VertexSource::constant) return source.constant;
    if (source.source == VertexSource::color) return surface[v];
    if (source.source == VertexSource::secondary_color) return scene.secondary_colors[v];
    if (source.source == VertexSource::lambert) {
      const glm::vec3 light = unit_or_zero(towards_light(scene.lights[0], scene.positions[v]));
      const float cosine = std::max(0.0F, glm::dot(scene.normals[v], light));
      return surface[v] * glm::vec4(scene.lights[0].color * cosine, 1.0F);
    }
    return {unit_or_zero(vectors.at(source.source, v)) * 0.5F + 0.5F, 1.0F};
  };
  std::vector<ColorBytes> colors(count);
  parallel_for(count, kGrainOfCheapItems, [&](std::size_t v) {
    const glm::vec4 rgba = color(v);
    for (int c = 0; c < 4; ++c) colors[v][static_cast<std::size_t>(c)] = byte_of_vertex_color(profile, rgba[c]);
  });
  return colors;
}

std::vector<float> fog_factors(const EffectFog& fog, const VertexInputs& inputs) {
  if (fog.mode == FogMode::none) return {};
  if (fog.mode == FogMode::mesh) return inputs.scene->fog_factors;
  const Camera& camera = inputs.scene->cameras[0];
  const glm::vec3 axis = unit_or_zero(camera.look_at - camera.position);
  std::vector<float> factors;
  factors.reserve(inputs.scene->positions.size());
  for (const glm::vec3& position : inputs.scene->positions) {
    const float distance = std::fabs(glm::dot(position - camera.position, axis));
    const float factor = fog_factor(fog, distance);
    factors.push_back(fog.mode == FogMode::registers ? factor : std::clamp(factor, 0.0F, 1.0F));
  }
  return factors;
}

}  // namespace ninebit
