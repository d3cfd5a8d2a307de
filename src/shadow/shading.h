// The colours of the lit and the shadow pass: per-vertex diffuse lighting, as OpenGL of that time did it.
#pragma once

#include <cstdint>
#include <vector>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/settings.h"

namespace ninebit {

// How bright a white light makes a white surface that faces it.
inline constexpr float kDiffuseLight = 0.78F;

// The material of each vertex: that of the last triangle that uses it.
[[nodiscard]] std::vector<std::uint32_t> vertex_materials(const Scene& scene);

struct VertexShading {
  std::vector<ColorBytes> lit;
  std::vector<ColorBytes> shadowed;
};

// Base colour × (ambient + diffuse · cos), with the profile's conversion of float colours to bytes. With
// `settings.light_facing` surfaces that turn away from the light get no diffuse light; otherwise both sides are lit
// alike, as in the article's pictures. In shadow, a quarter of the diffuse light stays, so that shapes can be told
// apart.
[[nodiscard]] VertexShading shade_vertices(const Scene& scene, const Light& light, const RenderSettings& settings);

}  // namespace ninebit
