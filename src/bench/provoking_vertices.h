// Flat colours for OpenGL, which takes a triangle's colour from one of its vertices.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/raster/rasterizer.h"

namespace ninebit::bench {

// Triangles turned, not mirrored, so that the last vertex of each has its colour and nobody else's. Where none of a
// triangle's vertices is free, one is doubled: about as many vertices as triangles, not three times as many.
struct ProvokingVertices {
  std::vector<std::uint32_t> source;  // for each vertex, the one that it is or doubles
  std::vector<ColorBytes> colors;     // for each vertex; black where it provokes nothing
  std::vector<glm::uvec3> triangles;  // in their old order
};

// One colour a triangle; vertex numbers are below `vertices`.
[[nodiscard]] ProvokingVertices provoking_vertices(std::span<const glm::uvec3> triangles,
                                                   std::span<const ColorBytes> colors, std::size_t vertices);

}  // namespace ninebit::bench
