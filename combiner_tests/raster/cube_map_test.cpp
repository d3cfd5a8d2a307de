// Cube maps: the major-axis table, and that what is drawn onto a face is what a direction fetches from it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

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
          EXPECT_EQ(c.s, 0.5F);
          EXPECT_EQ(c.t, 0.5F);
        } else {
          expect_as_table(x, y, z);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

TEST(CubeMap, NotANumberGivesTheFirstTexelAndInfinityOneOfTheMap) {
  CubeMap map;
  map.size = 16;
  const float values[] = {-kInfinity, -1.0F, 0.0F, 3.0F, kInfinity, kNan, std::numeric_limits<float>::max()};
  for (const float x : values) {
    for (const float y : values) {
      for (const float z : values) {
        const CubeCoordinate c = cube_coordinate(x, y, z);
        EXPECT_TRUE(c.s >= 0 && c.s <= 1 && c.t >= 0 && c.t <= 1) << x << ' ' << y << ' ' << z;
        const CubeMap::Texel texel = map.nearest(x, y, z);
        EXPECT_TRUE(texel.x >= 0 && texel.x < 16 && texel.y >= 0 && texel.y < 16) << x << ' ' << y << ' ' << z;
        if (!std::isnan(x) && !std::isnan(y) && !std::isnan(z)) continue;
        EXPECT_EQ(texel.face, CubeFace::positive_x) << x << ' ' << y << ' ' << z;
        EXPECT_EQ(texel.x, 0) << x << ' ' << y << ' ' << z;
        EXPECT_EQ(texel.y, 0) << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(CubeMap, NearestTakesTheTexelThatHoldsTheCoordinate) {
  Random random(42);
  for (int i = 0; i < 100000; ++i) {
    CubeMap map;
    map.size = random.pick({1, 2, 3, 16, 100, 512});
    const float x = random.real_f(-1, 1), y = random.real_f(-1, 1), z = random.real_f(-1, 1);
    const Expected expected = table(x, y, z);
    const CubeMap::Texel texel = map.nearest(x, y, z);
    ASSERT_EQ(texel.face, expected.face);
    ASSERT_NEAR(texel.x + 0.5, expected.s * map.size, 0.5 + 1e-4);
    ASSERT_NEAR(texel.y + 0.5, expected.t * map.size, 0.5 + 1e-4);
  }
  CubeMap map;
  map.size = 8;  // s = 1 and t = 1 belong to the last texel
  EXPECT_EQ(map.nearest(1, 0, -1).x, 7);
  EXPECT_EQ(map.nearest(1, -1, 0).y, 7);
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

// Six faces that own their planes.
struct DrawnCube {
  std::vector<Surface> faces;
  CubeMap map;
  explicit DrawnCube(int size) {
    for (int i = 0; i < 6; ++i) faces.push_back(Surface::make(size, size).value());
    map.size = size;
    for (std::size_t i = 0; i < 6; ++i) {
      const RenderTarget target = faces[i].target();
      for (std::size_t k = 0; k < 3; ++k) map.faces[i][k] = {target.color[k].data, target.color[k].stride};
    }
  }
  void draw(const Mesh& mesh, bool with_depth) {
    for (const CubeFace face : kCubeFaces) {
      RenderTarget target = faces[static_cast<std::size_t>(face)].target();
      PipelineState state;
      state.depth_test.enabled = with_depth;
      ASSERT_TRUE(rasterize(state, face_matrix(face, 0.01, 100), mesh.arrays(), {}, target).ok());
    }
  }
  ColorBytes fetch(const glm::vec3& direction) const {
    const CubeMap::Texel texel = map.nearest(direction.x, direction.y, direction.z);
    ColorBytes color{0, 0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k)
      color[k] = map.faces[static_cast<std::size_t>(texel.face)][k].at(texel.x, texel.y);
    return color;
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
          static_cast<std::uint8_t>(1 + (number >> 16)), 0};
}

// One small triangle around the middle of every texel of all faces, each with its own colour and distance, all drawn
// through all six projections: any direction within a texel then fetches the colour of that texel's triangle.
TEST(CubeMap, WhatIsDrawnIsWhatIsFetched) {
  for (const int size : {1, 7, 64, 100}) {
    Random random(43, static_cast<std::uint64_t>(size));
    Mesh mesh;
    const auto number_of = [&](int face, int x, int y) { return (face * size + y) * size + x; };
    for (int face = 0; face < 6; ++face) {
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const double turn = random.real(0, 6.28), distance = random.real(0.1, 50);
          const auto first = static_cast<std::uint32_t>(mesh.positions.size());
          for (int k = 0; k < 3; ++k) {
            const double angle = turn + k * 2.0943951;
            const double s = (x + 0.5 + 0.4 * std::cos(angle)) / size, t = (y + 0.5 + 0.4 * std::sin(angle)) / size;
            mesh.add(direction_of(face, s, t, distance * random.real(0.8, 1.25)));
          }
          mesh.add_triangle(first, first + 1, first + 2);
          mesh.triangle_colors.push_back(color_of_number(number_of(face, x, y)));
        }
      }
    }
    DrawnCube cube(size);
    cube.draw(mesh, false);
    for (int i = 0; i < 60000; ++i) {
      const int face = random.below(6), x = random.below(size), y = random.below(size);
      const double s = (x + random.real(0.001, 0.999)) / size, t = (y + random.real(0.001, 0.999)) / size;
      ASSERT_EQ(cube.fetch(direction_of(face, s, t, random.real(0.001, 1000))), color_of_number(number_of(face, x, y)))
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
    Mesh mesh;
    for (int k = 0; k < 3; ++k) mesh.add({random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-3, 3)});
    mesh.add_triangle(0, 1, 2);
    DrawnCube cube(size);
    cube.draw(mesh, true);
    const glm::dvec3 a(mesh.positions[0]), b(mesh.positions[1]), c(mesh.positions[2]);
    const double whole = glm::dot(a, glm::cross(b, c));
    if (std::fabs(whole) < 0.5) continue;  // seen almost from its edge
    for (int i = 0; i < 4000; ++i) {
      const int face = random.below(6), x = random.below(size), y = random.below(size);
      const glm::dvec3 r = glm::normalize(glm::dvec3(direction_of(face, (x + 0.5) / size, (y + 0.5) / size, 1)));
      // Distances of the direction from the three planes through the origin and an edge, positive inside.
      const auto inside_of = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(r, glm::normalize(glm::cross(p, q))) * (whole > 0 ? 1 : -1);
      };
      const double nearest_edge = std::min({inside_of(a, b), inside_of(b, c), inside_of(c, a)});
      if (std::fabs(nearest_edge) < 0.005) continue;  // within a few sixteenths of a texel
      const bool drawn = cube.fetch(direction_of(face, (x + 0.5) / size, (y + 0.5) / size, 2))[0] != 0;
      ASSERT_EQ(drawn, nearest_edge > 0) << "triangle " << index << " face " << face << " texel " << x << ' ' << y;
      if (drawn) ++hits[static_cast<std::size_t>(face)];
    }
  }
  for (const int count : hits) EXPECT_GE(count, 300);
}

}  // namespace
}  // namespace ninebit::test
