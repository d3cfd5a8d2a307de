// Flat colours for OpenGL, which takes a triangle's colour from its provoking vertex.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/raster/rasterizer.h"

namespace ninebit::bench {

// Triangles rotated, not mirrored, so that the last vertex of each carries only this triangle's colour. If none of its
// vertices is free, one is duplicated: this needs about as many vertices as triangles, instead of three times as many.
struct ProvokingVertices {
  std::vector<std::uint32_t> source;  // for each vertex, its number in the input, also if it is a duplicate
  std::vector<ColorBytes> colors;     // for each vertex; black if it provokes no triangle
  std::vector<glm::uvec3> triangles;  // in the order of the input
};

// `colors` has one colour per triangle; vertex numbers are below `vertices`.
[[nodiscard]] ProvokingVertices provoking_vertices(std::span<const glm::uvec3> triangles,
                                                   std::span<const ColorBytes> colors, std::size_t vertices);

}  // namespace ninebit::bench
