// Triangles of one size, for measuring the rasterizer.
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

// Three sheets over a window of that size, each an indexed mesh such as a terrain seen from above: a square lattice of
// `leg` pixels a cell, turned by an angle that no two sheets share, every vertex moved by up to 0.3 legs in both
// directions and in depth, every cell cut along one of its diagonals at random. Cells that would cross the window's
// sides are left out. The second sheet lies behind the first and the third one before it; the second faces away. So
// with the depth test LESS, about two fragments of three pass. `leg` is at least 0.5.
[[nodiscard]] Mesh small_triangles(int width, int height, float leg);

// 64 triangles, two for each of 32 tilted rectangles that cover the whole window, from the back to the front: with the
// depth test LESS every fragment passes.
[[nodiscard]] Mesh large_triangles();

}  // namespace ninebit::bench
