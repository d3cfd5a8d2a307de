// The parts of the order by neighbourhood, each on a few polygons whose answer is known.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "combiner_tests/shadow/support.h"
#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/hidden_backs.h"
#include "src/shadow/index_order/patches.h"
#include "src/shadow/index_order/scene_surface.h"
#include "src/shadow/index_order/shadow_relation.h"

namespace {

using namespace ninebit;

using Polygon = std::array<glm::vec3, 3>;

// Adds an object of these polygons.
void add_polygons(Scene& scene, const std::vector<Polygon>& polygons) {
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back(
      {"object", static_cast<std::uint32_t>(scene.triangles.size()), static_cast<std::uint32_t>(polygons.size())});
  for (const Polygon& polygon : polygons) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.insert(scene.positions.end(), polygon.begin(), polygon.end());
    scene.normals.insert(scene.normals.end(), 3, glm::vec3(0, 0, 1));
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangle_object.push_back(object);
    scene.triangle_material.push_back(0);
  }
}

Scene scene_of(const std::vector<std::vector<Polygon>>& objects, const glm::vec3& light = {3, 9, 2}) {
  Scene scene = shadow_test::scene_with({5, 6, 7}, {0, 0, 0}, light);
  for (const std::vector<Polygon>& object : objects) add_polygons(scene, object);
  return scene;
}

std::vector<Polygon> box_polygons(const glm::vec3& low, const glm::vec3& high) {
  Scene scene;
  scene.materials.emplace_back();
  shadow_test::add_box(scene, "box", low, high);
  std::vector<Polygon> polygons;
  for (const glm::uvec3& t : scene.triangles) {
    polygons.push_back({scene.positions[t.x], scene.positions[t.y], scene.positions[t.z]});
  }
  return polygons;
}

std::vector<Polygon> inside_out(std::vector<Polygon> polygons) {
  for (Polygon& p : polygons) std::swap(p[1], p[2]);
  return polygons;
}

bool hides_its_backs(const std::vector<Polygon>& polygons, const glm::vec3& light = {3, 9, 2}) {
  const Scene scene = scene_of({polygons}, light);
  return find_hidden_backs(scene, SceneSurface(scene)).at(0);
}

TEST(HiddenBacks, OfSolidsAndOfRoomsAroundTheLight) {
  const std::vector<Polygon> box = box_polygons({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(hides_its_backs(box));
  EXPECT_TRUE(hides_its_backs(box, {0.5F, 0.5F, 0.5F}));
  EXPECT_FALSE(hides_its_backs(inside_out(box)));
  EXPECT_TRUE(hides_its_backs(inside_out(box), {0.5F, 0.5F, 0.5F}));
  std::vector<Polygon> open = box;
  open.pop_back();
  EXPECT_FALSE(hides_its_backs(open));
  std::vector<Polygon> turned = box;  // the neighbours run along its edges in the same direction
  std::swap(turned[0][1], turned[0][2]);
  EXPECT_FALSE(hides_its_backs(turned));
}

// The two free edges of a small fin are 1 % of the length of all edges, and the edge where it stands is 3 %.
TEST(HiddenBacks, AnEdgeOfThreePolygonsIsOpen) {
  std::vector<Polygon> finned = box_polygons({0, 0, 0}, {1, 1, 0.3F});
  EXPECT_TRUE(hides_its_backs(finned));
  finned.push_back({glm::vec3{1, 1, 0}, {1, 1, 0.3F}, {1.05F, 1.05F, 0.15F}});
  EXPECT_FALSE(hides_its_backs(finned));
  std::swap(finned.back()[0], finned.back()[1]);
  EXPECT_FALSE(hides_its_backs(finned)) << "in whichever direction it runs";
}

// A large square and a strip beside it that rises by 3 degrees: it does not rise above the square's plane by more than
// the relief, but the square's far side does above the strip's plane.
TEST(Patches, LookAtEarlierCornersAboveANewPlane) {
  const auto patches_with = [](float rise) {
    const glm::vec3 a(-1, 0, 0), b(0, 0, 0), c(0, 1, 0), d(-1, 1, 0), e(0.01F, 0, rise), f(0.01F, 1, rise);
    const Scene scene = scene_of({{{a, b, c}, {a, c, d}, {b, e, f}, {b, f, c}}});
    return Patches::grow(SceneSurface(scene), scene.triangle_object, 5.0).count();
  };
  EXPECT_EQ(patches_with(0.0005F), 2U);
  EXPECT_EQ(patches_with(-0.0005F), 1U) << "a strip that falls";
  EXPECT_EQ(patches_with(0.0F), 1U);
}

// Two polygons that share one corner. Each corner of the second lies at most 1/100 of its distance in front of the
// first one's plane, but the first rises steeply in front of the second one's.
TEST(Borders, AFoldIsJudgedInBothDirections) {
  const Polygon level{glm::vec3{0, 0, 0}, {-0.5F, -1, 0}, {0.5F, -1, 0}};
  const Polygon tilted{glm::vec3{0, 0, 0}, {10, -0.0173F, -0.01F}, {10, 0.173F, 0.1F}};
  const Polygon gentle{glm::vec3{0, 0, 0}, {10, -0.02F, -0.0002F}, {10, 0.2F, 0.002F}};
  const auto neighbours = [](const Polygon& first, const Polygon& second) {
    const Scene scene = scene_of({{first}, {second}});
    const SceneSurface surface(scene);
    const Patches patches = Patches::grow(surface, scene.triangle_object, 5.0);
    const std::vector<bool> back_is_hidden(patches.count(), false);
    ShadowRelation relation(surface, patches, back_is_hidden);
    return Borders::find(surface, patches, relation, 5.0).are_neighbours(0, 1);
  };
  EXPECT_FALSE(neighbours(level, tilted));
  EXPECT_FALSE(neighbours(tilted, level));
  EXPECT_TRUE(neighbours(level, gentle));
  EXPECT_TRUE(neighbours(gentle, level));
}

}  // namespace
