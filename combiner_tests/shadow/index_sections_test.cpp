// Sections: what they promise of each object, and what they do to the shadows.
#include "src/shadow/index_cube/index_sections.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "ninebit/scene/scene_io.h"

namespace {

using namespace ninebit;

using Place = std::tuple<float, float, float>;

void expect_contract(const Scene& scene, int size) {
  const Sections sections = cut_into_sections(scene, size);
  ASSERT_EQ(sections.of_triangle.size(), scene.triangles.size());
  struct Found {
    std::set<std::uint32_t> objects;
    std::set<Place> places;
    int triangles = 0;
  };
  std::map<std::uint32_t, Found> found;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    Found& section = found[sections.of_triangle[t]];
    section.objects.insert(scene.triangle_object[t]);
    ++section.triangles;
    for (glm::length_t i = 0; i < 3; ++i) {
      const glm::vec3 p = scene.positions[scene.triangles[t][i]];
      section.places.insert({p.x, p.y, p.z});
    }
  }
  EXPECT_EQ(found.size(), sections.count) << "no section is empty";
  EXPECT_EQ(found.rbegin()->first + 1, sections.count);
  std::uint32_t object = 0;
  for (const auto& [number, section] : found) {
    ASSERT_EQ(section.objects.size(), 1U) << number;
    ASSERT_GE(*section.objects.begin(), object) << "sections are counted object by object";
    object = *section.objects.begin();
    ASSERT_LE(section.triangles, size / 4 * 4) << number;
    ASSERT_LE(section.places.size(), std::size_t{kMaxSectionVertices}) << number;
  }
}

TEST(Sections, StayWithinOneObjectAndTheirSize) {
  const Scene scene = ninebit::test::index_room();
  for (const int size : {kMinSectionSize, 7, 64, 130, kMaxSectionSize}) {
    SCOPED_TRACE(size);
    expect_contract(scene, size);
  }
  const auto count = [&](int size) { return cut_into_sections(scene, size).count; };
  EXPECT_GT(count(4), count(64));
  EXPECT_GT(count(64), count(512));
  EXPECT_GE(count(512), scene.objects.size());
  EXPECT_EQ(count(7), count(4)) << "counted in fours";
}

// A flat fan: its apex is a corner of every triangle.
Scene fan(std::uint32_t triangles) {
  Scene scene = shadow_test::scene_with({9, 9, 9}, {0, 0, 0}, {0, 9, 0});
  scene.positions = {{0, 0, 0}};
  for (std::uint32_t i = 0; i <= triangles; ++i) {
    const double angle = 6.28 * i / triangles;
    scene.positions.emplace_back(std::cos(angle), 0.0, std::sin(angle));
  }
  scene.normals.assign(scene.positions.size(), {0, 1, 0});
  for (std::uint32_t i = 0; i < triangles; ++i) scene.triangles.emplace_back(0, i + 2, i + 1);
  scene.triangle_object.assign(triangles, 0);
  scene.triangle_material.assign(triangles, 0);
  scene.objects = {{.name = "fan", .first_triangle = 0, .triangle_count = triangles}};
  return scene;
}

// Time grows with the triangles, not with their square: half a second here, which took 24.
TEST(Sections, TrianglesAroundOneVertexAreCutInLinearTime) {
  expect_contract(fan(5000), 64);
  const auto start = std::chrono::steady_clock::now();
  const Sections sections = cut_into_sections(fan(100'000), 64);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
  EXPECT_GE(sections.count, 100'000 / 64);
}

TEST(Sections, TheBoundHoldsAndIsNear) {
  Scene box = shadow_test::scene_with({9, 9, 9}, {0, 0, 0}, {0, 9, 0});
  shadow_test::add_box(box, "box", {-1, -1, -1}, {1, 1, 1});
  for (const Scene& scene : {ninebit::test::index_room(), fan(3000), box}) {
    for (const int size : {kMinSectionSize, 7, 64, 130, kMaxSectionSize}) {
      const std::uint64_t most = most_sections(scene, size), count = cut_into_sections(scene, size).count;
      EXPECT_LE(count, most) << size;
      EXPECT_LE(most, 4 * count + scene.objects.size()) << size;
    }
  }
}

// Triangles at one place count as many, degenerate ones too; corners that differ only in their normals are one.
TEST(Sections, DuplicatesAndDegenerateTrianglesAreCutLikeOthers) {
  Scene scene = shadow_test::scene_with({9, 9, 9}, {0, 0, 0}, {0, 9, 0});
  shadow_test::add_box(scene, "box", {-1, -1, -1}, {1, 1, 1});
  const glm::uvec3 first = scene.triangles[0];
  for (const glm::uvec3& more : {first, first, glm::uvec3(first.x, first.x, first.y), glm::uvec3(first.x)}) {
    scene.triangles.push_back(more);
    scene.triangle_object.push_back(0);
    scene.triangle_material.push_back(0);
    ++scene.objects[0].triangle_count;
  }
  expect_contract(scene, 4);
  expect_contract(scene, 512);
  EXPECT_EQ(cut_into_sections(scene, 16).count, 1U) << "a box's corners are shared by its sides";
}

TEST(Sections, DoNotDependOnScaleOrPlace) {
  const Scene scene = ninebit::test::index_room();
  const Sections plain = cut_into_sections(scene, 32);
  EXPECT_EQ(cut_into_sections(scene, 32).of_triangle, plain.of_triangle);
  for (const float scale : {0x1p-60F, 0x1p38F}) {
    Scene scaled = scene;
    for (glm::vec3& p : scaled.positions) p *= scale;
    EXPECT_EQ(cut_into_sections(scaled, 32).of_triangle, plain.of_triangle) << scale;
  }
}

TEST(Sections, HaveTheIndicesOfTheMap) {
  const Scene scene = ninebit::test::index_room();
  RenderSettings settings = shadow_test::small_settings();
  settings.index.scope = IndexScope::section;
  settings.index.section_size = 64;
  const Sections sections = cut_into_sections(scene, 64);
  const Rendering r = shadow_test::render(scene, settings);
  EXPECT_EQ(r.codes_used, sections.count);
  const auto layers = shadow_test::comparison_layers(r);
  for (std::size_t i = 0; i < layers.polygon.size(); ++i) {
    if (layers.polygon[i] == 0) continue;
    ASSERT_EQ(layers.own(r.codes, i), sections.of_triangle[layers.polygon[i] - 1] + 1);
  }
}

// "This would only reduce the errors slightly": between an index a polygon and an index an object.
TEST(Sections, HaveFewerJointsThanPolygonsAndMoreThanObjects) {
  const Scene scene = ninebit::test::index_room();
  const auto shadowed = [&](IndexScope scope, int size) {
    RenderSettings settings = shadow_test::small_settings();
    settings.index.scope = scope;
    settings.index.section_size = size;
    return shadow_test::render(scene, settings).shadowed;
  };
  const auto polygons = shadowed(IndexScope::polygon, 64), objects = shadowed(IndexScope::object, 64);
  const auto small = shadowed(IndexScope::section, 16), large = shadowed(IndexScope::section, 256);
  EXPECT_GT(polygons, small);
  EXPECT_GT(small, large);
  EXPECT_GT(large, objects);
}

}  // namespace
