// Polygons that the map cannot hold, on a wall whose texels are known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/slow_build.h"

namespace {

using namespace ninebit;

constexpr int kTexels = 64;
constexpr double kWall = 4.0;  // distance from the light at the origin, along +X

// Adds a triangle on the wall at places in texels, from the middle of the face on; its front is toward the light.
void add_triangle(Scene& scene, const std::array<glm::dvec2, 3>& corners) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::dvec2& c : corners) {
    const double unit = 2.0 * kWall / kTexels;
    scene.positions.emplace_back(kWall, c.y * unit, c.x * unit);
    scene.normals.emplace_back(-1.0F, 0.0F, 0.0F);
  }
  scene.objects.push_back({"piece", static_cast<std::uint32_t>(scene.triangles.size()), 1});
  const double turn = (corners[1].x - corners[0].x) * (corners[2].y - corners[0].y) -
                      (corners[2].x - corners[0].x) * (corners[1].y - corners[0].y);
  scene.triangles.emplace_back(first, first + (turn > 0.0 ? 1 : 2), first + (turn > 0.0 ? 2 : 1));
  scene.triangle_object.push_back(static_cast<std::uint32_t>(scene.objects.size() - 1));
  scene.triangle_material.push_back(0);
}

double area_of(const std::array<glm::dvec2, 3>& c) {
  return std::fabs((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y)) / 2.0;
}

// The texel centres inside, grown or shrunk by a margin; centres lie at halves.
bool has_centre(const std::array<glm::dvec2, 3>& c, double margin) {
  for (int row = -kTexels / 2; row < kTexels / 2; ++row) {
    for (int column = -kTexels / 2; column < kTexels / 2; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      bool inside = true;
      const double sign = (c[1].x - c[0].x) * (c[2].y - c[0].y) > (c[2].x - c[0].x) * (c[1].y - c[0].y) ? 1.0 : -1.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 a = c[i], edge = c[(i + 1) % 3] - a;
        const double height = sign * (edge.x * (y - a.y) - edge.y * (x - a.x)) / glm::length(edge);
        inside = inside && height > margin;
      }
      if (inside) return true;
    }
  }
  return false;
}

struct Facts {
  std::uint64_t polygons = 0, pixels = 0;
  double texels = 0.0;
};

Facts facts_of(const Rendering& r) {
  Facts facts;
  for (const Fact& fact : r.facts) {
    if (fact.name == "vanished_polygons") facts.polygons = std::get<std::uint64_t>(fact.value);
    if (fact.name == "vanished_pixels") facts.pixels = std::get<std::uint64_t>(fact.value);
    if (fact.name == "vanished_texels") facts.texels = std::get<double>(fact.value);
  }
  return facts;
}

RenderSettings wall_settings() {
  RenderSettings settings = shadow_test::small_settings();
  settings.map_size = kTexels;
  return settings;
}

Scene empty_wall() {
  return shadow_test::scene_with({-1.0F, 0.3F, 0.2F}, {4.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F});
}

// Random pieces about a texel wide. Those for which a sixteenth of a texel decides are left out.
struct Pieces {
  Scene scene = empty_wall();
  std::set<std::uint32_t> vanished;  // numbers of triangles, from 1
  double texels = 0.0;
};

Pieces random_pieces() {
  Pieces pieces;
  std::mt19937 random(7);
  const auto real = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  while (pieces.scene.triangles.size() < 400) {
    const glm::dvec2 at(real(-20, 20), real(-15, 15));
    std::array<glm::dvec2, 3> c{};
    for (glm::dvec2& corner : c) corner = at + glm::dvec2(real(-0.9, 0.9), real(-0.9, 0.9));
    if (area_of(c) < 0.02 || has_centre(c, -0.1) != has_centre(c, 0.1)) continue;
    add_triangle(pieces.scene, c);
    if (has_centre(c, 0.0)) continue;
    pieces.vanished.insert(static_cast<std::uint32_t>(pieces.scene.triangles.size()));
    pieces.texels += area_of(c);
  }
  return pieces;
}

TEST(VanishedPolygons, AreThoseWithoutATexelCentre) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Pieces pieces = random_pieces();
  ASSERT_GT(pieces.vanished.size(), 50U);
  const Rendering r = shadow_test::render(pieces.scene, wall_settings());
  const Facts facts = facts_of(r);
  EXPECT_EQ(facts.polygons, pieces.vanished.size());
  EXPECT_NEAR(facts.texels, pieces.texels, 1e-4 * pieces.texels);
  const auto layers = shadow_test::comparison_layers(r);
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < layers.polygon.size(); ++i) {
    if (!pieces.vanished.contains(layers.polygon[i])) continue;
    ++pixels;
    ASSERT_NE(r.frame.stencil()[i], 0) << "what is not in the map is in shadow";
  }
  EXPECT_GT(pixels, 100U);
  EXPECT_EQ(facts.pixels, pixels);
}

// Whatever shares an index: the polygon itself is not in the map.
TEST(VanishedPolygons, AreTheSameInEveryScopeAndForEachNumberOfFaces) {
  Pieces pieces = random_pieces();
  RenderSettings settings = wall_settings();
  settings.index.scope = IndexScope::object;
  EXPECT_EQ(facts_of(shadow_test::render(pieces.scene, settings)).polygons, pieces.vanished.size());
  // A piece that lies around the cube's corner (4, 4, 4) has a share on three faces.
  Scene corner = empty_wall();
  shadow_test::add_quad(corner, "corner", {{{4, 4.01F, 4}, {4, 4, 4.01F}, {4.01F, 4, 4}, {4.01F, 4, 4}}});
  const Facts facts = facts_of(shadow_test::render(corner, settings));
  EXPECT_EQ(facts.polygons, 1U) << "the second triangle has no area";
  EXPECT_GT(facts.texels, 0.0);
  EXPECT_LT(facts.texels, 0.05);
}

TEST(VanishedPolygons, WhatIsHiddenCulledOrWithoutAreaIsNotMissed) {
  // The floor's hidden part, a triangle of no area and one edge-on to the light.
  Scene scene = shadow_test::square_over_floor();
  EXPECT_EQ(facts_of(shadow_test::render(scene, wall_settings())).polygons, 0U);
  scene.triangles.emplace_back(4, 4, 5);
  scene.triangle_object.push_back(1);
  scene.triangle_material.push_back(0);
  ++scene.objects[1].triangle_count;
  shadow_test::add_quad(scene, "edge-on", {{{0, 2.5F, 0}, {0.3F, 2.5F, 0}, {0.3F, 2.4F, 0}, {0, 2.4F, 0}}});
  EXPECT_EQ(facts_of(shadow_test::render(scene, wall_settings())).polygons, 0U);

  Scene small = empty_wall();
  add_triangle(small, {glm::dvec2(0.1, 0.1), glm::dvec2(0.4, 0.1), glm::dvec2(0.1, 0.4)});
  RenderSettings settings = wall_settings();
  for (const auto& [cull, missed] : {std::pair{CullFace::none, 1U}, {CullFace::back, 1U}, {CullFace::front, 0U}}) {
    settings.cull_face = cull;
    EXPECT_EQ(facts_of(shadow_test::render(small, settings)).polygons, missed);
  }
  std::swap(small.triangles[0].y, small.triangles[0].z);
  settings.cull_face = CullFace::back;
  EXPECT_EQ(facts_of(shadow_test::render(small, settings)).polygons, 0U);
}

}  // namespace
