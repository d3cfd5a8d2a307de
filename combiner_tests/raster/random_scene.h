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
  std::vector<float> clip_z;                                // of each vertex, before times w
  std::vector<float> clip_w;                                // likewise; or none: 1
  std::vector<std::uint32_t> indices;                       // or none: all vertices in their order
  std::vector<ColorBytes> vertex_colors, primitive_colors;  // one of them, or neither
  bool exact_color = true;                                  // no smooth colours that differ
  std::optional<oracle::Clear> clear;                       // before the draw
  double clear_depth = 0;                                   // of which the clear's depth is the code
};

struct RandomScene {
  int width = 1;
  int height = 1;
  bool captures = false;  // an output plane at depth pass
  oracle::Picture start;
  std::vector<RandomDraw> draws;
};

// With depths of every format, or of those whose codes are steps of window depth.
RandomScene random_scene(Random& random, bool with_numbers = true);

// Other fragment operations for a draw of a scene: what its formats have.
void randomize_operations(Random& random, const RandomScene& scene, PipelineState& state);

// The draw as the oracle wants it.
oracle::DrawCall for_oracle(const RandomDraw& draw);

// The draw for the library; the arrays view the positions.
struct LibraryDraw {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec4> homogeneous_positions;  // in place of them, where a vertex has a w
  VertexArrays arrays;
};
LibraryDraw for_library(const RandomDraw& draw, int width, int height);

// All inputs, enough to build the case again by hand.
std::string describe(const RandomScene& scene);

}  // namespace ninebit::test
