// Cube maps: the major-axis table, faces that do not bleed into each other, and that what is drawn onto a face is what
// a direction fetches from it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "combiner_tests/raster/texture_support.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

struct Expected {
  CubeFace face;
  double s, t;
};

// The table of ARB_texture_cube_map, row by row; among equal magnitudes x, then y, and a zero counts as positive.
Expected table(double rx, double ry, double rz) {
  const double x = std::fabs(rx), y = std::fabs(ry), z = std::fabs(rz);
  CubeFace face;
  double sc, tc, ma;
  if (x >= y && x >= z) {
    ma = x;
    tc = -ry;
    face = rx < 0 ? CubeFace::negative_x : CubeFace::positive_x;
    sc = rx < 0 ? rz : -rz;
  } else if (y >= z) {
    ma = y;
    sc = rx;
    face = ry < 0 ? CubeFace::negative_y : CubeFace::positive_y;
    tc = ry < 0 ? -rz : rz;
  } else {
    ma = z;
    tc = -ry;
    face = rz < 0 ? CubeFace::negative_z : CubeFace::positive_z;
    sc = rz < 0 ? -rx : rx;
  }
  return {face, (sc / ma + 1) / 2, (tc / ma + 1) / 2};
}

void expect_as_table(float x, float y, float z) {
  const Expected expected = table(x, y, z);
  const CubeCoordinate actual = cube_coordinate(x, y, z);
  ASSERT_EQ(actual.face, expected.face) << x << ' ' << y << ' ' << z;
  ASSERT_NEAR(actual.s, expected.s, 2e-7) << x << ' ' << y << ' ' << z;
  ASSERT_NEAR(actual.t, expected.t, 2e-7) << x << ' ' << y << ' ' << z;
}

TEST(CubeMap, RandomDirectionsFollowTheTable) {
  std::array<int, 6> seen{};
  Random random(41);
  for (int i = 0; i < 300000; ++i) {
    const double scale = std::exp2(random.between(-100, 100));
    const auto component = [&] { return static_cast<float>(random.real(-1, 1) * scale); };
    const float x = component(), y = component(), z = component();
    expect_as_table(x, y, z);
    if (HasFatalFailure()) return;
    ++seen[static_cast<std::size_t>(cube_coordinate(x, y, z).face)];
  }
  for (const int count : seen) EXPECT_GE(count, 30000);
}

TEST(CubeMap, TiesZerosAndSignsFollowTheDocumentedRule) {
  const float values[] = {-2.0F, -1.0F, -0.5F, -0.0F, 0.0F, 0.5F, 1.0F, 2.0F};
  for (const float x : values) {
    for (const float y : values) {
      for (const float z : values) {
        if (x == 0 && y == 0 && z == 0) {
          const CubeCoordinate c = cube_coordinate(x, y, z);
          EXPECT_EQ(c.face, CubeFace::positive_x);
          EXPECT_EQ(c.s, 0.0F);
          EXPECT_EQ(c.t, 0.0F);
        } else {
          expect_as_table(x, y, z);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

// The register codes that a direction fetches, NEAREST.
Rgba9 fetch(const Texture& texture, const glm::vec3& direction) {
  const auto sampler = TextureSampler::make(profiles::geforce2, texture, kNearestSampler);
  CoordinateArrays one;
  one.push({direction.x, direction.y, direction.z});
  CodeArrays codes(1);
  sampler->sample(one.view(), 1, codes.at());
  return codes.of(0);
}

TEST(CubeMap, NotANumberGivesTheFirstTexelAndInfinityOneOfTheMap) {
  const Texture texture = cube_of_places(16);
  const float values[] = {-kInfinity, -1.0F, 0.0F, 3.0F, kInfinity, kNan, std::numeric_limits<float>::max()};
  for (const float x : values) {
    for (const float y : values) {
      for (const float z : values) {
        const CubeCoordinate c = cube_coordinate(x, y, z);
        EXPECT_TRUE(c.s >= 0 && c.s <= 1 && c.t >= 0 && c.t <= 1) << x << ' ' << y << ' ' << z;
        const Rgba9 codes = fetch(texture, {x, y, z});
        EXPECT_TRUE(codes[0] < 16 && codes[1] < 16 && codes[2] < 6 && codes[3] == 255) << x << ' ' << y << ' ' << z;
        if (!std::isnan(x) && !std::isnan(y) && !std::isnan(z)) continue;
        EXPECT_EQ(codes, (Rgba9{0, 0, 0, 255})) << x << ' ' << y << ' ' << z;
      }
    }
  }
  EXPECT_EQ(cube_coordinate(-kInfinity, 1, 2).s, 0.5F);
  EXPECT_EQ(cube_coordinate(1, kInfinity, kInfinity).t, 0.0F);
}

TEST(CubeMap, NearestTakesTheTexelThatHoldsTheCoordinate) {
  Random random(42);
  for (const int size : {1, 2, 4, 16, 128, 256}) {
    const Texture texture = cube_of_places(size);
    for (int i = 0; i < cases_here(20000); ++i) {
      const float x = random.real_f(-1, 1), y = random.real_f(-1, 1), z = random.real_f(-1, 1);
      const Expected expected = table(x, y, z);
      const Rgba9 codes = fetch(texture, {x, y, z});
      ASSERT_EQ(codes[2], static_cast<int>(expected.face));
      ASSERT_NEAR(codes[0] + 0.5, expected.s * size, 0.5 + 1e-4);
      ASSERT_NEAR(codes[1] + 0.5, expected.t * size, 0.5 + 1e-4);
    }
  }
  const Texture texture = cube_of_places(8);  // s = 1 and t = 1 belong to the last texel
  EXPECT_EQ(fetch(texture, {1, 0, -1})[0], 7);
  EXPECT_EQ(fetch(texture, {1, -1, 0})[1], 7);
}

// All six faces, their edges and corners: each is wrapped as a texture of its own.
TEST(CubeMap, NoFilterReadsAcrossTheFaces) {
  const Texture texture = [] {
    std::vector<std::vector<TextureSamples>> faces;
    for (int face = 0; face < 6; ++face) {
      faces.push_back({{4, 4, std::vector<std::uint8_t>(16, static_cast<std::uint8_t>(40 * face + 8))}});
    }
    return make_texture(TextureTarget::cube_map, InternalFormat::luminance8, std::move(faces)).value();
  }();
  Sampler sampler{.min_filter = MinFilter::linear, .border_color = {1, 1, 1, 1}};
  const auto red = [&](const glm::vec3& r) {
    return texel_at(*TextureSampler::make(profiles::geforce2, texture, sampler), {r.x, r.y, r.z}).value[0];
  };
  int checked = 0;
  for (const float x : {-1.0F, -0.999F, 0.0F, 0.999F, 1.0F}) {
    for (const float y : {-1.0F, -0.999F, 0.0F, 0.999F, 1.0F}) {
      for (const float z : {-1.0F, -0.999F, 0.0F, 0.999F, 1.0F}) {
        if (std::max({std::fabs(x), std::fabs(y), std::fabs(z)}) < 0.9F) continue;
        const int own = 40 * static_cast<int>(table(x, y, z).face) + 8;
        for (const Wrap wrap : {Wrap::repeat, Wrap::clamp_to_edge, Wrap::mirrored_repeat}) {
          sampler.wrap_s = sampler.wrap_t = wrap;
          ASSERT_EQ(red({x, y, z}), own) << x << ' ' << y << ' ' << z;
          ++checked;
        }
        sampler.wrap_s = sampler.wrap_t = Wrap::clamp;  // half a texel at an edge is the border's
        const bool corner = std::fabs(x) > 0.9F && std::fabs(y) > 0.9F && std::fabs(z) > 0.9F;
        const int zeros = (x == 0 ? 1 : 0) + (y == 0 ? 1 : 0) + (z == 0 ? 1 : 0);
        const double share = corner ? 0.75 : zeros == 1 ? 0.5 : 0;
        ASSERT_NEAR(red({x, y, z}), own + share * (255 - own), 3) << x << ' ' << y << ' ' << z;
      }
    }
  }
  EXPECT_GT(checked, 300);
}

// The projection that draws what stands around the origin onto a face.
glm::mat4 face_matrix(CubeFace face, double near_plane, double far_plane) {
  const CubeFaceAxes& axes = cube_face_axes(face);
  glm::mat4 m(0.0F);
  for (int column = 0; column < 3; ++column) {
    const auto i = static_cast<std::size_t>(column);
    m[column][0] = static_cast<float>(axes.s[i]);
    m[column][1] = static_cast<float>(axes.t[i]);
    m[column][2] = static_cast<float>(axes.major[i] * (far_plane + near_plane) / (far_plane - near_plane));
    m[column][3] = static_cast<float>(axes.major[i]);
  }
  m[3][2] = static_cast<float>(-2 * far_plane * near_plane / (far_plane - near_plane));
  return m;
}

// Triangles with a colour each.
struct ColoredTriangles {
  std::vector<glm::vec3> positions;
  std::vector<ColorBytes> colors;
};

// Six surfaces, and the cube map that views them without a copy.
struct DrawnCube {
  std::vector<Surface> surfaces;
  Texture texture;
  explicit DrawnCube(int size) {
    std::vector<TextureImage> faces;
    for (int i = 0; i < 6; ++i) {
      surfaces.push_back(Surface::make(size, size).value());
      const RenderTarget target = surfaces.back().target();
      std::array<Plane<const std::uint8_t>, 4> planes;
      for (std::size_t k = 0; k < 3; ++k) planes[k] = {target.color[k].data, target.color[k].stride};
      faces.push_back({size, size, planes});
    }
    texture = texture_view(InternalFormat::rgb8, faces);
  }
  void draw(const ColoredTriangles& triangles, bool with_depth) {
    const VertexArrays arrays{.positions = triangles.positions, .primitive_colors = triangles.colors};
    for (const CubeFace face : kCubeFaces) {
      RenderTarget target = surfaces[static_cast<std::size_t>(face)].target();
      PipelineState state;
      state.depth_test.enabled = with_depth;
      ASSERT_TRUE(rasterize(state, face_matrix(face, 0.01, 100), arrays, {}, target).ok());
    }
  }
};

// The direction through a place on a face, at a distance: solves the table's rows for rx, ry, rz.
glm::vec3 direction_of(int face, double s, double t, double distance) {
  const double sc = (2 * s - 1) * distance, tc = (2 * t - 1) * distance;
  const std::array<std::array<double, 3>, 6> rows{{{distance, -tc, -sc},
                                                   {-distance, -tc, sc},
                                                   {sc, distance, tc},
                                                   {sc, -distance, -tc},
                                                   {sc, -tc, distance},
                                                   {-sc, -tc, -distance}}};
  const auto& r = rows[static_cast<std::size_t>(face)];
  return {static_cast<float>(r[0]), static_cast<float>(r[1]), static_cast<float>(r[2])};
}

ColorBytes color_of_number(int number) {
  return {static_cast<std::uint8_t>(number & 255), static_cast<std::uint8_t>((number >> 8) & 255),
          static_cast<std::uint8_t>(1 + (number >> 16)), 255};
}

// One small triangle around the middle of every texel of all faces, each with its own colour and distance, all drawn
// through all six projections: any direction within a texel then fetches the colour of that texel's triangle.
TEST(CubeMap, WhatIsDrawnIsWhatIsFetched) {
  for (const int size : {1, 8, 64, 128}) {
    Random random(43, static_cast<std::uint64_t>(size));
    ColoredTriangles triangles;
    const auto number_of = [&](int face, int x, int y) { return (face * size + y) * size + x; };
    for (int face = 0; face < 6; ++face) {
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const double turn = random.real(0, 6.28), distance = random.real(0.1, 50);
          for (int k = 0; k < 3; ++k) {
            const double angle = turn + k * 2.0943951;
            const double s = (x + 0.5 + 0.4 * std::cos(angle)) / size, t = (y + 0.5 + 0.4 * std::sin(angle)) / size;
            triangles.positions.push_back(direction_of(face, s, t, distance * random.real(0.8, 1.25)));
          }
          triangles.colors.push_back(color_of_number(number_of(face, x, y)));
        }
      }
    }
    DrawnCube cube(size);
    cube.draw(triangles, false);
    for (int i = 0; i < cases_here(60000); ++i) {
      const int face = random.below(6), x = random.below(size), y = random.below(size);
      const double s = (x + random.real(0.001, 0.999)) / size, t = (y + random.real(0.001, 0.999)) / size;
      const ColorBytes expected = color_of_number(number_of(face, x, y));
      ASSERT_EQ(fetch(cube.texture, direction_of(face, s, t, random.real(0.001, 1000))),
                (Rgba9{expected[0], expected[1], expected[2], expected[3]}))
          << "size " << size << " face " << face << " texel " << x << ' ' << y;
    }
  }
}

// Triangles that run over several faces, judged by the ray through a texel's middle.
TEST(CubeMap, LargeTrianglesAreSeenInTheRightDirections) {
  const int size = 64;
  std::array<int, 6> hits{};
  for (std::uint64_t index = 0; index < 40; ++index) {
    Random random(44, index);
    ColoredTriangles triangles;
    for (int k = 0; k < 3; ++k) {
      triangles.positions.emplace_back(random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-3, 3));
    }
    DrawnCube cube(size);
    cube.draw(triangles, true);
    const glm::dvec3 a(triangles.positions[0]), b(triangles.positions[1]), c(triangles.positions[2]);
    const double whole = glm::dot(a, glm::cross(b, c));
    if (std::fabs(whole) < 0.5) continue;  // seen almost from its edge
    for (int i = 0; i < cases_here(4000); ++i) {
      const int face = random.below(6), x = random.below(size), y = random.below(size);
      const glm::dvec3 r = glm::normalize(glm::dvec3(direction_of(face, (x + 0.5) / size, (y + 0.5) / size, 1)));
      // Distances of the direction from the three planes through the origin and an edge, positive inside.
      const auto inside_of = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(r, glm::normalize(glm::cross(p, q))) * (whole > 0 ? 1 : -1);
      };
      const double nearest_edge = std::min({inside_of(a, b), inside_of(b, c), inside_of(c, a)});
      if (std::fabs(nearest_edge) < 0.005) continue;  // within a few sixteenths of a texel
      const bool drawn = fetch(cube.texture, direction_of(face, (x + 0.5) / size, (y + 0.5) / size, 2))[0] != 0;
      ASSERT_EQ(drawn, nearest_edge > 0) << "triangle " << index << " face " << face << " texel " << x << ' ' << y;
      if (drawn) ++hits[static_cast<std::size_t>(face)];
    }
  }
  for (const int count : hits) EXPECT_GE(count, cases_here(300));
}

}  // namespace
}  // namespace ninebit::test
