// Perspective-correct colours and texture coordinates, whole and clipped.
#include <gtest/gtest.h>

#include <cmath>

#include "combiner_tests/raster/texture_support.h"

namespace ninebit::test {
namespace {

struct Slope {
  Mesh mesh;
  int width, height;
  double tangent;
  glm::mat4 matrix;
};

Slope random_case(Random& random, bool clipped) {
  Slope c;
  c.width = random.between(64, 256);
  c.height = random.between(64, 256);
  c.tangent = random.real(0.4, 1.5);
  c.matrix = perspective(c.tangent, static_cast<double>(c.width) / c.height, 0.2, 30);
  for (int k = 0; k < 3; ++k) {
    const double depth = clipped && k == 1 ? random.real(0.15, 2.0) : -random.real(0.5, 12);
    c.mesh.add({random.real_f(-5, 5), random.real_f(-5, 5), static_cast<float>(depth)});
    c.mesh.vertex_colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    c.mesh.texture_coordinates.emplace_back(random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1));
  }
  c.mesh.add_triangle(0, 1, 2);
  return c;
}

void expect_colors(bool clipped, std::uint64_t seed) {
  std::int64_t checked = 0;
  for (std::uint64_t index = 0; index < cases_here(150U); ++index) {
    Random random(seed, index);
    const Slope c = random_case(random, clipped);
    PipelineState state;
    state.profile.color_weights.value = ColorWeights::exact;
    const Surface surface =
        drawn_surface(c.width, c.height, state, c.mesh.arrays(), {}, {.with_primitive = true}, c.matrix);
    for (int y = 0; y < c.height; ++y) {
      for (int x = 0; x < c.width; ++x) {
        const auto at = static_cast<std::size_t>(y * c.width + x);
        if (surface.primitive()[at] != 0) continue;
        const glm::dvec3 w = weights_at(c.mesh.positions, x + 0.5, y + 0.5, c.width, c.height, c.tangent);
        if (std::min({w.x, w.y, w.z}) < 0.02) continue;  // rims, slivers
        for (int k = 0; k < 4; ++k) {
          const auto i = static_cast<std::size_t>(k);
          const auto [low, high] = range_around(x, y, [&](double px, double py) {
            const glm::dvec3 b = weights_at(c.mesh.positions, px, py, c.width, c.height, c.tangent);
            return b.x * c.mesh.vertex_colors[0][i] + b.y * c.mesh.vertex_colors[1][i] +
                   b.z * c.mesh.vertex_colors[2][i];
          });
          const double drawn = surface.color(k)[at];
          ASSERT_GE(drawn, low - 1) << "case " << index << " pixel " << x << ' ' << y;
          ASSERT_LE(drawn, high + 1) << "case " << index << " pixel " << x << ' ' << y;
        }
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, cases_here(50000));
}

TEST(Interpolation, ColorsArePerspectiveCorrect) {
  expect_colors(false, 51);
}
TEST(Interpolation, ClippedTrianglesInterpolateLikeWholeOnes) {
  expect_colors(true, 52);
}

void expect_texels(bool clipped, std::uint64_t seed) {
  const Texture place = cube_of_places(256);
  const std::array<TextureUnit, 1> textures{TextureUnit{&place, kNearestSampler}};
  PipelineState state;
  state.program = pass_through(Register::texture0, Register::texture0);
  std::int64_t checked = 0;
  for (std::uint64_t index = 0; index < cases_here(100U); ++index) {
    Random random(seed, index);
    const Slope c = random_case(random, clipped);
    const Surface surface =
        drawn_surface(c.width, c.height, state, c.mesh.arrays(), textures, {.with_primitive = true}, c.matrix);
    for (int y = 0; y < c.height; ++y) {
      for (int x = 0; x < c.width; ++x) {
        const auto at = static_cast<std::size_t>(y * c.width + x);
        if (surface.primitive()[at] != 0) continue;
        const glm::dvec3 w = weights_at(c.mesh.positions, x + 0.5, y + 0.5, c.width, c.height, c.tangent);
        if (std::min({w.x, w.y, w.z}) < 0.02) continue;
        EXPECT_EQ(surface.color(kAlpha)[at], 255);
        const auto face = static_cast<CubeFace>(surface.color(kBlue)[at]);
        bool same_face = true;
        const auto coordinate = [&](double px, double py) {
          const glm::dvec3 b = weights_at(c.mesh.positions, px, py, c.width, c.height, c.tangent);
          glm::dvec3 r(0);
          const double weight[] = {b.x, b.y, b.z};
          for (std::size_t k = 0; k < 3; ++k) r += weight[k] * glm::dvec3(c.mesh.texture_coordinates[k]);
          const CubeCoordinate at_cube =
              cube_coordinate(static_cast<float>(r.x), static_cast<float>(r.y), static_cast<float>(r.z));
          same_face = same_face && at_cube.face == face;
          return at_cube;
        };
        const auto [s_low, s_high] =
            range_around(x, y, [&](double px, double py) { return double{coordinate(px, py).s}; });
        const auto [t_low, t_high] =
            range_around(x, y, [&](double px, double py) { return double{coordinate(px, py).t}; });
        if (!same_face) continue;  // near a seam
        const double s = (surface.color(kRed)[at] + 0.5) / 256, t = (surface.color(kGreen)[at] + 0.5) / 256;
        const double slack = 0.75 / 256;
        ASSERT_TRUE(s >= s_low - slack && s <= s_high + slack && t >= t_low - slack && t <= t_high + slack)
            << "case " << index << " pixel " << x << ' ' << y << ": " << s << " not in " << s_low << ' ' << s_high
            << " or " << t << " not in " << t_low << ' ' << t_high;
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, cases_here(30000));
}

TEST(Interpolation, TextureCoordinatesArePerspectiveCorrect) {
  expect_texels(false, 53);
}
TEST(Interpolation, TextureCoordinatesOfClippedTriangles) {
  expect_texels(true, 54);
}

}  // namespace
}  // namespace ninebit::test
