// A reflective shadow map's texels as pixel lights.

#include <cmath>
#include <numbers>

#include "src/frame/shading.h"
#include "src/shadow/reflective/indirect_light.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// The cross-section of one texel's beam at a point of the world, perpendicular to the ray.
class BeamArea {
 public:
  BeamArea(const ReflectiveMap& map, const Light& light) : light_(light) {
    const glm::mat4& m = map.clip_from_world;
    const auto row_length = [&](int row) {
      const glm::vec3 v(m[0][row], m[1][row], m[2][row]);
      return std::sqrt(glm::dot(v, v));
    };
    w_row_ = glm::vec4(m[0][3], m[1][3], m[2][3], m[3][3]);
    const auto size = static_cast<float>(map.size);
    texel_ = 4.0F / (row_length(0) * row_length(1)) / (size * size);
  }

  [[nodiscard]] float operator()(const glm::vec3& at) const {
    const float w = glm::dot(w_row_, glm::vec4(at, 1.0F));
    if (light_.kind == LightKind::directional) return texel_ * w * w;
    // A plane perpendicular to the axis is not perpendicular to a ray beside the axis.
    const glm::vec3 ray = at - light_.position;
    const float distance = std::sqrt(glm::dot(ray, ray));
    return distance > 0.0F ? texel_ * w * w * (w / distance) : 0.0F;
  }

 private:
  Light light_;
  glm::vec4 w_row_{};
  float texel_ = 0.0F;
};

}  // namespace

PixelLights pixel_lights(const ReflectiveMap& map, const Light& light, SamplePattern pattern) {
  const BeamArea area(map, light);
  // A diffuse surface sends 1 / pi of its flux along its normal.
  constexpr float kPerFlux = kDiffuseLight / kFluxOfWhiteLight / std::numbers::pi_v<float>;
  PixelLights lights{.size = map.size};
  lights.values.resize(map.depth.size() * PixelLights::kStride);
  parallel_for(map.depth.size(), [&](std::size_t i) {
    if (map.depth[i] == max_depth(DepthStencilFormat::d24s8)) return;
    float* const out = &lights.values[i * PixelLights::kStride];
    for (std::size_t c = 0; c < 3; ++c) {
      out[c] = float_of(map.position[c][i]);
      out[3 + c] = float_of(map.normal[c][i]);
      out[6 + c] = float_of(map.flux[c][i]);
    }
    if (pattern != SamplePattern::polar) return;
    const float scale = kPerFlux * area({out[0], out[1], out[2]});
    for (std::size_t c = 6; c < 9; ++c) out[c] *= scale;
  });
  return lights;
}

}  // namespace ninebit
