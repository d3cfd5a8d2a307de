// Random scenes for the comparison with the oracle: primitives, geometry and state biased to edges.
#pragma once

#include <string>
#include <vector>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {

struct RandomDraw {
  PipelineState state;
  PrimitiveType type = PrimitiveType::triangles;
  std::vector<oracle::WindowVertex> vertices;
  std::vector<float> clip_z;                                // of each vertex
  std::vector<std::uint32_t> indices;                       // or none: all vertices in their order
  std::vector<ColorBytes> vertex_colors, primitive_colors;  // one of them, or neither
  bool exact_color = true;                                  // no smooth colours that differ
  std::optional<oracle::Clear> clear;                       // before the draw
};

struct RandomScene {
  int width = 1;
  int height = 1;
  bool captures = false;  // an output plane at depth pass
  oracle::Picture start;
  std::vector<RandomDraw> draws;
};

RandomScene random_scene(Random& random);

// The draw as the oracle wants it.
oracle::DrawCall for_oracle(const RandomDraw& draw);

// The draw for the library; the arrays view the positions.
struct LibraryDraw {
  std::vector<glm::vec3> positions;
  VertexArrays arrays;
};
LibraryDraw for_library(const RandomDraw& draw, int width, int height);

// All inputs, enough to build the case again by hand.
std::string describe(const RandomScene& scene);

}  // namespace ninebit::test
