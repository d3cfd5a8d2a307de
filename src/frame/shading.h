// The colours of the lit and the shadow pass: per-vertex diffuse lighting, as OpenGL of that time did it, or flat
// colours as in a cartoon.
#pragma once

#include <cstdint>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

// The brightness of a white surface that faces a white light.
inline constexpr float kDiffuseLight = 0.78F;

// The material of each vertex: that of the last triangle that uses it.
[[nodiscard]] std::vector<std::uint32_t> vertex_materials(const Scene& scene);

// One colour per vertex, or with settings.cartoon per triangle.
struct VertexShading {
  std::vector<ColorBytes> lit;
  std::vector<ColorBytes> shadowed;
};

// Base colour × the vertex's own colour × (ambient + diffuse · cos), with the profile's conversion of float colours to
// bytes. With `settings.light_facing` surfaces that face away from the light get no diffuse light; otherwise both sides
// are lit the same, as in the article's pictures. In shadow a quarter of the diffuse light stays, so that shapes remain
// visible.
//
// With `settings.cartoon` a triangle has a single colour: its base colour at one of a few brightnesses, by its angle to
// the light. Vertex colours have no effect. In shadow it is ink: nearly black, with a trace of the base colour.
[[nodiscard]] VertexShading shade_vertices(const Scene& scene, const Light& light, const RenderSettings& settings);

// The summands of the lit colours, separately, for passes that change the light before it reaches the surface.
struct VertexLight {
  std::vector<ColorBytes> ambient;  // base colour × ambient
  std::vector<ColorBytes> diffuse;  // base colour × diffuse · cos, what the light adds
};
[[nodiscard]] VertexLight light_vertices(const Scene& scene, const Light& light, const RenderSettings& settings);

}  // namespace ninebit
