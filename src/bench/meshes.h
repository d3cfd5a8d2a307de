// Triangles of one size for rasterizer benchmarks.
#pragma once

#include <glm/glm.hpp>
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

}  // namespace ninebit::bench
