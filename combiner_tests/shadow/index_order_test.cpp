// The parts of the order by neighbourhood, each on a few polygons whose answer is known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "combiner_tests/shadow/support.h"
#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/code_embedding.h"
#include "src/shadow/index_order/lost_differences.h"
#include "src/shadow/index_order/neighbour_order.h"
#include "src/shadow/index_order/patches.h"

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

// In profile: a large slope that rises to the right, a narrow level strip, and a long slope that rises less than the
// first. It lies behind the first one's plane, and 1/30 in front of the strip's.
TEST(Patches, LookAtNewCornersAboveEarlierPlanes) {
  const auto strip = [](float x0, float z0, float x1, float z1) {
    const glm::vec3 a(x0, 0, z0), b(x1, 0, z1), c(x1, 10, z1), d(x0, 10, z0);
    return std::vector<Polygon>{{a, b, c}, {a, c, d}};
  };
  const auto patches_with = [&](float rise) {
    std::vector<Polygon> all = strip(-10, -0.7F, 0, 0);
    for (const auto& more : {strip(0, 0, 0.01F, 0), strip(0.01F, 0, 1, rise)}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    const Scene scene = scene_of({all});
    return Patches::grow(SceneSurface(scene), scene.triangle_object, 10.0).count();
  };
  EXPECT_EQ(patches_with(0.035F), 2U);
  EXPECT_EQ(patches_with(0.0F), 1U);
}

TEST(Patches, TheMiddleIsThatOfTheArea) {
  const Scene scene =
      scene_of({{{glm::vec3{0, 0, 0}, {6, 0, 0}, {0, 3, 0}}, {glm::vec3{0, 0, 0}, {0, 3, 0}, {-3, 0, 0}}}});
  const Patches patches = Patches::grow(SceneSurface(scene), scene.triangle_object, 10.0);
  ASSERT_EQ(patches.count(), 1U);
  // Areas 9 and 4.5, centroids (2, 1) and (-1, 1).
  EXPECT_LT(glm::length(patches.center(0) - glm::dvec3(1, 1, 0)), 1e-12);
}

// Two polygons that meet along edges of 1 and 2 units, and one that meets at a corner.
TEST(Borders, HaveTheLengthOfAllSharedEdges) {
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(3, 0, 0), up(1, 2, 0), down(1, -2, 0);
  const Scene scene = scene_of({{{a, b, up}, {b, c, up}},
                                {{b, a, down}, {c, b, down}},
                                {{a, up, glm::vec3{0, 9, 0}}},
                                {{c, glm::vec3{4, 0, 0}, glm::vec3{4, 1, 0}}}});
  const SceneSurface surface(scene);
  const Patches patches = Patches::grow(surface, scene.triangle_object, 5.0);
  ASSERT_EQ(patches.count(), 4U);
  const std::vector<bool> back_is_hidden(4, false);
  ShadowRelation relation(surface, patches, back_is_hidden);
  const Borders borders = Borders::find(surface, patches, relation, 5.0);
  const auto length = [&](std::uint32_t object, std::uint32_t other) {
    const auto patch_of = [&](std::uint32_t o) { return patches.of_polygon(scene.objects[o].first_triangle); };
    for (const Border& border : borders.of(patch_of(object))) {
      if (border.patch == patch_of(other)) return static_cast<double>(border.length);
    }
    return 0.0;
  };
  const double corner = kCornerLength * surface.diagonal();
  EXPECT_NEAR(length(0, 1), 3.0 + corner, 1e-6);
  EXPECT_NEAR(length(1, 0), 3.0 + corner, 1e-6);
  EXPECT_NEAR(length(0, 2), std::sqrt(5.0) + corner, 1e-6);
  EXPECT_NEAR(length(1, 3), corner, 1e-6);
  EXPECT_EQ(length(2, 3), 0.0);
  EXPECT_EQ(borders.count(), 5U);
}

// A small polygon that stands on a large one: only its back can shadow the large one by more than the relief.
TEST(Borders, SteepFoldsOfPolygonsThatCannotShadowOneAnother) {
  const Polygon level{glm::vec3{0, 0, 0}, {-5, -10, 0}, {5, -10, 0}};
  const Polygon steep{glm::vec3{0, 0, 0}, {0.01F, 0, 0}, {0, 0, 0.01F}};
  for (const bool hidden : {false, true}) {
    const Scene scene = scene_of({{level}, {steep}});
    const SceneSurface surface(scene);
    const Patches patches = Patches::grow(surface, scene.triangle_object, 5.0);
    const std::vector<bool> back_is_hidden(2, hidden);
    ShadowRelation relation(surface, patches, back_is_hidden);
    EXPECT_EQ(Borders::find(surface, patches, relation, 5.0).are_neighbours(0, 1), hidden);
  }
}

// Codes that compare equal although one square lies above the other, in whichever channel and order.
TEST(OrderCheck, CountsFalseNeighboursInAllDirections) {
  const auto lost = LostDifferences::measure(profiles::geforce2, IndexFormat::rgb, {});
  ASSERT_TRUE(lost) << lost.error().text();
  const auto square = [](float z) { return std::vector<Polygon>{{glm::vec3{0, 0, z}, {1, 0, z}, {1, 1, z}}}; };
  const Scene scene = scene_of({square(0), square(1)});
  const SceneSurface surface(scene);
  const Patches patches = Patches::grow(surface, scene.triangle_object, 5.0);
  const std::vector<bool> back_is_hidden(2, false);
  ShadowRelation relation(surface, patches, back_is_hidden);
  const Borders borders = Borders::find(surface, patches, relation, 5.0);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (const int step : {-1, 1, -2, 2}) {
      // From one cube of codes into the next one.
      CodeBytes near{8, 8, 8}, far{8, 8, 8};
      near[channel] = step < 0 ? 10 : 9;
      far[channel] = near[channel] + step;
      const std::array<CodeBytes, 2> codes{near, far};
      IndexOrderReport report;
      check_order(codes, borders, relation, *lost, report);
      EXPECT_EQ(report.false_neighbours, step == 1 || step == -1 ? 1U : 0U) << channel << ' ' << step;
    }
  }
}

TEST(CodeLattice, FindsWhatWasPutAndNotTaken) {
  const auto lost = LostDifferences::measure(profiles::geforce2, IndexFormat::rgb, {});
  ASSERT_TRUE(lost) << lost.error().text();
  CodeLattice lattice(*lost, 1, 3);
  EXPECT_FALSE(lattice.usable({0, 0, 0})) << "the cleared map";
  EXPECT_FALSE(lattice.usable({1, 0, 0}));
  EXPECT_TRUE(lattice.usable({2, 0, 0}));
  EXPECT_FALSE(lattice.usable({2, 256, 0}));
  EXPECT_FALSE(lattice.usable({2, -1, 0}));
  const auto conflicts = [&](const CodeBytes& code) {
    std::set<std::uint32_t> found;
    lattice.in_conflict_with(code, [&](std::uint32_t patch) { return found.insert(patch).second; });
    return found;
  };
  for (std::uint32_t first = 0; first < 3; ++first) {
    lattice.clear();
    for (std::uint32_t patch = 0; patch < 3; ++patch) lattice.put(patch, {8, 8, static_cast<int>(8 + patch)});
    EXPECT_EQ(conflicts({8, 8, 9}), (std::set<std::uint32_t>{0, 1, 2}));
    EXPECT_FALSE(lattice.empty_around({8, 8, 12}, 2));
    EXPECT_TRUE(lattice.empty_around({8, 8, 13}, 2));
    lattice.take(first);
    std::set<std::uint32_t> left{0, 1, 2};
    left.erase(first);
    EXPECT_EQ(conflicts({8, 8, 9}), left);
    EXPECT_FALSE(lattice.has_code(first));
  }
}

// The floor and the wall of a closed L: of what the light sees, neither lies behind the other.
TEST(NeighbourOrder, TheInnerCornerOfASolidHasNoJoint) {
  const std::array<glm::vec2, 6> outline{{{1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 1}}};
  std::vector<Polygon> solid;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::vec2 p = outline[i], q = outline[(i + 1) % 6];
    solid.push_back({glm::vec3(p, 1), glm::vec3(p, 0), glm::vec3(q, 0)});
    solid.push_back({glm::vec3(p, 1), glm::vec3(q, 0), glm::vec3(q, 1)});
  }
  for (std::size_t i = 1; i + 1 < 6; ++i) {
    const glm::vec2 a = outline[0], p = outline[i], q = outline[i + 1];
    solid.push_back({glm::vec3(a, 1), glm::vec3(p, 1), glm::vec3(q, 1)});
    solid.push_back({glm::vec3(a, 0), glm::vec3(q, 0), glm::vec3(p, 0)});
  }
  const auto borders = [](const std::vector<Polygon>& polygons) {
    const Scene scene = scene_of({polygons});
    const auto order = order_by_neighbours(scene, {}, profiles::geforce2);
    EXPECT_TRUE(order);
    return order ? order->report.borders : 0;
  };
  const std::uint64_t closed = borders(solid);
  EXPECT_TRUE(hides_its_backs(solid));
  std::vector<Polygon> doubled = solid;  // the same polygons, but its edges are not closed
  doubled.push_back(solid.back());
  doubled.push_back(solid[12]);
  EXPECT_FALSE(hides_its_backs(doubled));
  EXPECT_GT(closed, borders(doubled));
}

}  // namespace
