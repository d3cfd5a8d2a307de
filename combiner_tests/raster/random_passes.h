// Random passes over random polygons: what vectors of fragments draw, and some that they leave to others.
#pragma once

#include <string>
#include <vector>

#include "combiner_tests/raster/support.h"
#include "ninebit/raster/prepared_draw.h"

namespace ninebit::test {

struct RandomPass {
  PipelineState state;
  std::vector<ColorBytes> vertex_colors, primitive_colors, secondary_colors;
  std::vector<float> fog_factors;  // or none
  std::array<std::vector<glm::vec3>, kMaxTextureUnits> coordinates;
  std::array<std::vector<float>, kMaxTextureUnits> q;  // or none
  std::array<Texture, kMaxTextureUnits> textures;      // without a level: the unit is off
  std::array<Sampler, kMaxTextureUnits> samplers;

  [[nodiscard]] std::vector<TextureUnit> units() const;  // up to the last that is on
};

// All passes agree in what the geometry depends on.
struct PassScene {
  int width = 1;
  int height = 1;
  DepthStencilFormat format = DepthStencilFormat::d24s8;
  ColorFormat color_format = ColorFormat::a8r8g8b8;
  std::array<bool, 4> has_color{};  // planes of the target
  bool has_stencil = true;
  oracle::Picture start;
  glm::mat4 matrix = kIdentity;
  PrimitiveType type = PrimitiveType::triangles;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;  // or none
  std::vector<RandomPass> passes;
  std::optional<ClearValues> clear;

  [[nodiscard]] VertexArrays arrays(const RandomPass& pass) const;
  // Gives the canvas, of this size, the scene's planes and what they hold; without outputs vectors may draw.
  void begin(Canvas& canvas, bool with_outputs) const;
};

PassScene random_passes(Random& random, int passes);

// Two passes or more: the first leaves the nearest depths, the others ask for the same, and stencil values tell their
// fragments apart.
PassScene random_equal_passes(Random& random, int passes);

// The states, enough to know what a case is about.
std::string describe(const PassScene& scene);

// The planes that every target has, of pictures; `with_depth`: the depth plane too.
bool same_planes(const oracle::Picture& a, const oracle::Picture& b, bool with_depth = true);

}  // namespace ninebit::test
