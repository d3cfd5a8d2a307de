// Random scenes for the comparison with the oracle: geometry and state biased to edges.
#pragma once

#include <string>
#include <vector>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {

struct RandomDraw {
  PipelineState state;
  std::vector<oracle::WindowVertex> vertices;
  std::vector<glm::uvec3> triangles;
  std::vector<ColorBytes> vertex_colors, triangle_colors;  // one of them, or neither
  bool exact_color = true;                                 // not a smooth triangle of several colours
};

struct RandomScene {
  int width = 1;
  int height = 1;
  bool captures = false;
  oracle::Picture start;
  std::vector<RandomDraw> draws;
};

RandomScene random_scene(Random& random);

// The draw as the oracle wants it and as the library does.
std::vector<oracle::DrawnTriangle> for_oracle(const RandomDraw& draw);
Mesh for_library(const RandomDraw& draw, int width, int height);

// All inputs, enough to build the case again by hand.
std::string describe(const RandomScene& scene);

}  // namespace ninebit::test
