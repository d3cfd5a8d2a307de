// Bounds, distances and the cutting of polygons.
#include <random>

#include "combiner_tests/scene/scene_test_support.h"
#include "src/scene/files/mesh_builder.h"

namespace ninebit::scene_tests {
namespace {

Scene one_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  Scene scene;
  scene.positions = {a, b, c, glm::vec3(1000.0F)};
  scene.triangles = {{0, 1, 2}};
  return scene;
}

TEST(Bounds, CoverUsedPositionsOnly) {
  const Bounds bounds = bounds_of(one_triangle({-1, 0, 2}, {3, -4, 0}, {0, 5, 1}));
  EXPECT_EQ(bounds.low, glm::vec3(-1, -4, 0));
  EXPECT_EQ(bounds.high, glm::vec3(3, 5, 2));
  EXPECT_EQ(bounds.center(), glm::vec3(1, 0.5F, 1));
  EXPECT_EQ(bounds_of(Scene{}).diagonal(), 0.0F);
}

TEST(Distance, FaceEdgeAndCorner) {
  const Scene scene = one_triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(scene, {1, 1, 3}), 3.0F);
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(scene, {1, 1, -3}), 3.0F);
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(scene, {1, 1, 0}), 0.0F);
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(scene, {2, -3, 4}), 5.0F);
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(scene, {-2, -3, 6}), 7.0F);
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(scene, {4, 4, 0}), std::sqrt(8.0F));
  EXPECT_TRUE(std::isinf(distance_to_nearest_triangle(Scene{}, {0, 0, 0})));
}

TEST(Distance, DegenerateTriangles) {
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(one_triangle({0, 0, 0}, {2, 0, 0}, {8, 0, 0}), {5, 3, 4}), 5.0F);
  EXPECT_FLOAT_EQ(distance_to_nearest_triangle(one_triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), {1, 4, 5}), 5.0F);
}

TEST(Distance, AgreesWithDenseSamples) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1.0F, 1.0F);
  const auto point = [&] { return glm::vec3(any(random), any(random), any(random)); };
  for (int round = 0; round < 200; ++round) {
    const Scene scene = one_triangle(point(), point(), point());
    const glm::vec3 from = point() * 1.5F;
    float nearest = 1e9F;
    constexpr int kSteps = 100;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const glm::vec3 at = scene.positions[0] +
                             (scene.positions[1] - scene.positions[0]) * (static_cast<float>(i) / kSteps) +
                             (scene.positions[2] - scene.positions[0]) * (static_cast<float>(j) / kSteps);
        nearest = std::min(nearest, glm::distance(at, from));
      }
    }
    const float distance = distance_to_nearest_triangle(scene, from);
    ASSERT_LE(distance, nearest + 1e-5F) << round;
    ASSERT_GE(distance, nearest - 0.04F) << round;
  }
}

// Sum of the triangles' areas with sign, along an axis: each point inside counts once if it equals the polygon's own.
void expect_cut(const std::vector<glm::vec3>& polygon, const glm::vec3& front, float area) {
  std::vector<std::array<std::uint32_t, 3>> pieces;
  ASSERT_TRUE(triangulate(polygon, pieces));
  ASSERT_EQ(pieces.size(), polygon.size() - 2);
  float sum = 0.0F;
  for (const auto& [a, b, c] : pieces) {
    const float piece = 0.5F * glm::dot(glm::cross(polygon[b] - polygon[a], polygon[c] - polygon[a]), front);
    EXPECT_GE(piece, -1e-5F);
    sum += piece;
  }
  EXPECT_NEAR(sum, area, 1e-3F * area);
}

TEST(Polygon, ConcaveShapesAreCutInside) {
  // An L, a comb, and a quad whose fan from its first corner would leave it; each in all three planes.
  const std::vector<std::vector<glm::vec2>> shapes{
      {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}},
      {{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {5, 1}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {0, 3}},
      {{0, 0}, {1, 1}, {0, 4}, {-1, 1}},
      {{4, 0}, {1, 1}, {0, 4}, {0, 0}}};
  const std::vector<float> areas{5.0F, 17.0F, 4.0F, 4.0F};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (glm::length_t plane = 0; plane < 3; ++plane) {
      std::vector<glm::vec3> polygon;
      glm::vec3 front(0.0F);
      front[plane] = 1.0F;
      for (const glm::vec2& at : shapes[i]) {
        glm::vec3 corner(0.5F);
        corner[(plane + 1) % 3] = at.x;
        corner[(plane + 2) % 3] = at.y;
        polygon.push_back(corner);
      }
      expect_cut(polygon, front, areas[i]);
      std::reverse(polygon.begin(), polygon.end());
      expect_cut(polygon, -front, areas[i]);
    }
  }
}

TEST(Polygon, SenselessShapesStillGiveEveryTriangle) {
  std::vector<std::array<std::uint32_t, 3>> pieces;
  const std::vector<glm::vec3> crossing{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  ASSERT_TRUE(triangulate(crossing, pieces));
  EXPECT_EQ(pieces.size(), 3U);
  pieces.clear();
  ASSERT_TRUE(triangulate(std::vector<glm::vec3>(6, glm::vec3(1.0F)), pieces));
  EXPECT_EQ(pieces.size(), 4U);
}

using Pieces = std::vector<std::array<std::uint32_t, 3>>;

Pieces cut(const std::vector<glm::vec2>& outline) {
  std::vector<glm::vec3> polygon;
  for (const glm::vec2& at : outline) polygon.emplace_back(at, 0.0F);
  Pieces pieces;
  EXPECT_TRUE(triangulate(polygon, pieces));
  return pieces;
}

// A corner on a straight side is no ear: it would be cut off as a triangle without area, and the rest be another shape.
TEST(Polygon, FlatCornersAreNoEars) {
  const Pieces pieces = cut({{0, 0}, {1, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {0, 1}});
  const Pieces expected{{2, 3, 4}, {2, 4, 5}, {2, 5, 6}, {6, 0, 1}, {1, 2, 6}};
  EXPECT_EQ(pieces, expected);
}

// The order of triangles is the order of indices in a picture, so cuts stay as they were from the first. Corners on a
// grid of five by five lie on sides, on each other and in the way of ears; the hash is that of the first program.
TEST(Polygon, CutsStayAsTheyWere) {
  const Pieces expected{{0, 1, 2}, {2, 3, 4}, {2, 4, 5}, {0, 2, 5}};
  EXPECT_EQ(cut({{3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}}), expected);
  std::uint64_t hash = 0xCBF29CE484222325U;
  std::uint32_t random = 1;
  const auto next = [&random] { return (random = random * 1664525U + 1013904223U) >> 8U; };
  for (int round = 0; round < 4000; ++round) {
    std::vector<glm::vec2> outline(4 + next() % 9);
    for (glm::vec2& corner : outline) {
      corner.x = static_cast<float>(next() % 5);
      corner.y = static_cast<float>(next() % 5);
    }
    for (const auto& piece : cut(outline)) {
      for (const std::uint32_t corner : piece) hash = (hash ^ corner) * 0x100000001B3U;
    }
  }
  EXPECT_EQ(hash, 0x6F6A8EF511F88945U);
}

TEST(Polygon, HugeOnes) {
  std::vector<glm::vec3> round;
  std::vector<glm::vec3> star;
  constexpr std::size_t kCorners = 20000;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / kCorners;
    const float radius = i % 2 == 0 ? 1.0F : 0.5F;
    round.emplace_back(1000.0F * std::cos(angle), 1000.0F * std::sin(angle), 0.0F);
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0F);
  }
  std::vector<std::array<std::uint32_t, 3>> pieces;
  EXPECT_FALSE(triangulate(star, pieces));
  EXPECT_TRUE(pieces.empty());
  star.resize(400);
  EXPECT_TRUE(triangulate(star, pieces));
  EXPECT_EQ(pieces.size(), 398U);
}

}  // namespace
}  // namespace ninebit::scene_tests
