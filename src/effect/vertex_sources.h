// The inputs that a mesh's vertices give to texture units, colours and fog.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/effect/effect.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

// The vertices that a pass draws, and the camera and light that their vectors refer to.
struct VertexInputs {
  const Scene* scene = nullptr;                      // complete: one camera, one light
  const std::vector<glm::vec4>* tangents = nullptr;  // one per vertex; nullptr: not needed
  glm::mat4 clip_from_world{1.0F};                   // of the pass, for `screen`
  glm::mat4 light_clip_from_world{1.0F};             // of the light's view, for `projected`
};

// The texture coordinates of a unit. q is empty if it is 1 everywhere.
struct UnitCoordinates {
  std::vector<glm::vec3> str{};
  std::vector<float> q{};
};

[[nodiscard]] UnitCoordinates unit_coordinates(const CoordinateSource& source, const VertexInputs& inputs);

// One colour per vertex. `source` is not VertexSource::index; for `secondary_color` the scene has secondary colours.
[[nodiscard]] std::vector<ColorBytes> vertex_colors(const ColorSource& source, const VertexInputs& inputs,
                                                    const HardwareProfile& profile);

// One factor per vertex; empty without fog. For FogMode::mesh the scene has them.
[[nodiscard]] std::vector<float> fog_factors(const EffectFog& fog, const VertexInputs& inputs);

// Whether a source reads tangents, or texture coordinates.
[[nodiscard]] constexpr bool needs_tangents(VertexSource source) {
  return source >= VertexSource::tangent_light_vector && source <= VertexSource::tangent_to_world_z;
}
[[nodiscard]] constexpr bool needs_uv(VertexSource source) {
  return source == VertexSource::uv || needs_tangents(source);
}

}  // namespace ninebit
