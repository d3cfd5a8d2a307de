// Triangles of one size for rasterizer benchmarks.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/raster/rasterizer.h"

namespace ninebit::bench {

// Positions are clip coordinates with w = 1, all inside the view volume; each triangle has a colour.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<ColorBytes> colors;

  [[nodiscard]] VertexArrays arrays() const {
    VertexArrays arrays{.positions = positions, .indices = index_list(triangles)};
    arrays.primitive_colors = colors;
    return arrays;
  }
};

// Three sheets over a window of that size. Each is an indexed mesh, like a terrain seen from above: a square lattice
// with cells of `leg` pixels, rotated by a different angle for each sheet. Each vertex is displaced by up to 0.3 legs
// in both directions and in depth; each cell is cut along a random diagonal. Cells that would cross the window's sides
// are left out. The second sheet is behind the first and faces away; the third is in front of the first. So with the
// depth test LESS about two of three fragments pass. `leg` is at least 0.5.
[[nodiscard]] Mesh small_triangles(int width, int height, float leg);

// 64 triangles, two for each of 32 tilted rectangles that cover the whole window, ordered from back to front: with the
// depth test LESS every fragment passes.
[[nodiscard]] Mesh large_triangles();

// Flat colours for OpenGL, which takes a triangle's colour from its provoking vertex.

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
