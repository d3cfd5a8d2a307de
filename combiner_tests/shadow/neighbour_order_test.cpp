// The order of indices by neighbourhood: what it promises of any mesh, judged by code of its own.
#include "src/shadow/index_order/neighbour_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/scene/scene_io.h"
#include "src/system/parallel/parallel_loop.h"

namespace {

using namespace ninebit;
using shadow_test::add_box;
using shadow_test::add_quad;

using Place = std::tuple<float, float, float>;
using Triangle = std::array<glm::vec3, 3>;

Scene empty_scene() {
  return shadow_test::scene_with({5, 6, 7}, {0, 0, 0}, {3, 9, 2});
}

void add_mesh(Scene& scene, const std::vector<Triangle>& mesh) {
  SceneObject object{.name = "mesh", .first_triangle = static_cast<std::uint32_t>(scene.triangles.size())};
  for (const Triangle& t : mesh) {
    const auto first = static_cast<unsigned>(scene.positions.size());
    for (const glm::vec3& p : t) {
      scene.positions.push_back(p);
      scene.normals.emplace_back(0.0F, 1.0F, 0.0F);
    }
    scene.triangles.emplace_back(first, first + 1, first + 2);
    scene.triangle_object.push_back(static_cast<std::uint32_t>(scene.objects.size()));
    scene.triangle_material.push_back(0);
  }
  object.triangle_count = static_cast<std::uint32_t>(mesh.size());
  scene.objects.push_back(object);
}

// A sheet of quads: columns × rows, closed around as `at` says.
template <class At>
std::vector<Triangle> sheet(int columns, int rows, const At& at) {
  std::vector<Triangle> mesh;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      mesh.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

std::vector<Triangle> torus(int columns, int rows) {
  return sheet(columns, rows, [=](int i, int j) {
    const double u = 2 * std::numbers::pi * (i % columns) / columns, v = 2 * std::numbers::pi * (j % rows) / rows;
    const double r = 2.0 + std::cos(v);
    return glm::vec3(r * std::cos(u), -std::sin(v), r * std::sin(u));
  });
}

std::vector<Triangle> moebius_band(int columns) {
  return sheet(columns, 2, [=](int i, int j) {
    const bool around = i >= columns;  // the last column meets the first one upside down
    const double u = 2 * std::numbers::pi * (i % columns) / columns, across = (around ? 1 - j : j - 1) * 0.5;
    const double r = 2.0 + across * std::cos(u / 2);
    return glm::vec3(r * std::cos(u), across * std::sin(u / 2), r * std::sin(u));
  });
}

NeighbourOrder order_of(const Scene& scene, const IndexSettings& settings = {},
                        const HardwareProfile& profile = profiles::geforce2) {
  auto order = order_by_neighbours(scene, settings, profile);
  EXPECT_TRUE(order.ok()) << order.error().text();
  return *order;
}

bool equal_on_geforce2(const CodeBytes& a, const CodeBytes& b) {
  int squares = 0;
  for (std::size_t c = 0; c < 3; ++c) squares += (a[c] - b[c]) * (a[c] - b[c]);
  return 64 * squares < 255;
}

// Judges an order for the profile geforce2 without any of its parts: pairs of patches with codes that compare equal
// share a corner, or no polygon of one rises above the relief in front of one of the other that could lie in its
// shadow.
class Judge {
 public:
  Judge(const Scene& scene, const NeighbourOrder& order) : scene_(scene), order_(order) {
    polygons_.resize(order.code.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) polygons_[order.patch_of_polygon[t]].push_back(t);
    for (std::uint32_t p = 0; p < polygons_.size(); ++p) at_code_[order.code[p]].push_back(p);
    relief_ = static_cast<double>(bounds_of(scene).diagonal()) / 256.0 * 1.0001;
  }

  struct Counts {
    int equal = 0, meeting = 0, harmful = 0;
  };
  Counts count() const {
    Counts counts;
    for (std::uint32_t p = 0; p < polygons_.size(); ++p) {
      for (const std::uint32_t other : compared_equal(p)) {
        if (other <= p) continue;
        ++counts.equal;
        if (meet(p, other)) {
          ++counts.meeting;
        } else if (shadows(p, other) || shadows(other, p)) {
          ++counts.harmful;
        }
      }
    }
    return counts;
  }

 private:
  std::vector<std::uint32_t> compared_equal(std::uint32_t p) const {
    std::vector<std::uint32_t> found;
    const CodeBytes& c = order_.code[p];
    for (int i = 0; i < 27; ++i) {
      const auto at = at_code_.find({c[0] + i % 3 - 1, c[1] + i / 3 % 3 - 1, c[2] + i / 9 - 1});
      if (at == at_code_.end() || !equal_on_geforce2(at->first, c)) continue;
      found.insert(found.end(), at->second.begin(), at->second.end());
    }
    return found;
  }
  glm::vec3 corner(std::uint32_t polygon, int i) const { return scene_.positions[scene_.triangles[polygon][i]]; }
  std::set<Place> places(std::uint32_t patch) const {
    std::set<Place> found;
    for (const std::uint32_t t : polygons_[patch]) {
      for (int i = 0; i < 3; ++i) found.insert({corner(t, i).x, corner(t, i).y, corner(t, i).z});
    }
    return found;
  }
  bool meet(std::uint32_t a, std::uint32_t b) const {
    const std::set<Place> of_a = places(a);
    for (const Place& place : places(b)) {
      if (of_a.count(place) > 0) return true;
    }
    return false;
  }
  // The farthest that a corner of a patch lies in front of (side 1) or behind (-1) a polygon's plane.
  double reach(std::uint32_t patch, std::uint32_t polygon, double side) const {
    const glm::dvec3 a = corner(polygon, 0), b = corner(polygon, 1), c = corner(polygon, 2);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (glm::length(normal) == 0.0) return 0.0;
    const glm::dvec3 unit = glm::normalize(normal);
    double farthest = 0.0;
    for (const std::uint32_t t : polygons_[patch]) {
      for (int i = 0; i < 3; ++i) {
        farthest = std::max(farthest, side * glm::dot(unit, glm::dvec3(corner(t, i)) - a));
      }
    }
    return farthest;
  }
  // Whether any front of the occluder may shadow the receiver.
  bool shadows(std::uint32_t occluder, std::uint32_t receiver) const {
    bool in_front = false, behind = false;
    for (const std::uint32_t t : polygons_[receiver]) in_front = in_front || reach(occluder, t, 1.0) > relief_;
    for (const std::uint32_t t : polygons_[occluder]) behind = behind || reach(receiver, t, -1.0) > relief_;
    return in_front && behind;
  }

  const Scene& scene_;
  const NeighbourOrder& order_;
  std::vector<std::vector<std::uint32_t>> polygons_;
  std::map<CodeBytes, std::vector<std::uint32_t>> at_code_;
  double relief_ = 0.0;
};

void expect_bound(const Scene& scene, const NeighbourOrder& order) {
  ASSERT_EQ(order.report.order, IndexOrder::neighbour);
  ASSERT_EQ(order.patch_of_polygon.size(), scene.triangles.size());
  EXPECT_EQ(order.report.patches, order.code.size());
  EXPECT_EQ(order.report.false_neighbours, 0U);
  for (const CodeBytes& code : order.code) EXPECT_FALSE(equal_on_geforce2(code, {0, 0, 0})) << "the cleared map";
  EXPECT_EQ(Judge(scene, order).count().harmful, 0);
}

NeighbourOrder order_in_bound(const Scene& scene, const IndexSettings& settings = {}) {
  const NeighbourOrder order = order_of(scene, settings);
  expect_bound(scene, order);
  return order;
}

bool equal(const NeighbourOrder& order, std::uint32_t a, std::uint32_t b) {
  return equal_on_geforce2(order.code[order.patch_of_polygon[a]], order.code[order.patch_of_polygon[b]]);
}

TEST(NeighbourOrder, FacesOfATetrahedronAndACubeAreAllLost) {
  Scene tetrahedron = empty_scene();
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1);
  add_mesh(tetrahedron, {{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}});
  const NeighbourOrder four = order_in_bound(tetrahedron);
  EXPECT_EQ(four.report.patches, 4U);
  EXPECT_EQ(four.report.borders, 6U);
  EXPECT_EQ(four.report.broken_borders, 0U);

  Scene cube = empty_scene();
  add_box(cube, "cube", {-1, -1, -1}, {1, 1, 1});
  const NeighbourOrder six = order_in_bound(cube);
  EXPECT_EQ(six.report.patches, 6U);
  EXPECT_EQ(six.report.borders, 12U);
  EXPECT_EQ(six.report.broken_borders, 0U);
}

TEST(NeighbourOrder, ATorusLosesItsJointsAndKeepsItsShadows) {
  Scene scene = empty_scene();
  add_mesh(scene, torus(48, 24));
  const NeighbourOrder order = order_in_bound(scene);
  EXPECT_GT(order.report.patches, 40U);
  EXPECT_LT(order.report.broken_share, 0.12) << "0.138 before patches are moved, 0.121 after one round";
  // Across the hole the inner sides see each other: their codes differ.
  const std::uint32_t inner = 2 * 12, opposite = 2 * (24 * 24 + 12);
  EXPECT_FALSE(equal(order, inner, opposite));
}

TEST(NeighbourOrder, AMoebiusBandHasNoSideButAnOrder) {
  Scene scene = empty_scene();
  add_mesh(scene, moebius_band(60));
  EXPECT_GT(order_in_bound(scene).report.borders, 0U);
}

TEST(NeighbourOrder, OddMeshes) {
  const glm::vec3 a(0, 0, 0), b(2, 0, 0), c(2, 0, -2), d(0, 0, -2), middle(1, 0, 0), up(1, 1, -1), down(1, -1, -1);
  Scene t_junction = empty_scene();  // the middle of one polygon's edge is a corner of two others
  add_mesh(t_junction, {{a, b, c}, {middle, a, {1, 0, 2}}, {b, middle, {1, 0, 2}}});
  const NeighbourOrder flat = order_in_bound(t_junction);
  EXPECT_TRUE(equal(flat, 1, 2));
  EXPECT_TRUE(equal(flat, 0, 1)) << "they share a corner, and lie in one plane";

  Scene book = empty_scene();  // three polygons at one edge
  add_mesh(book, {{a, b, up}, {a, b, down}, {b, a, c}});
  (void)order_in_bound(book);

  Scene twice = empty_scene();
  add_mesh(twice, {{a, b, c}, {a, b, c}, {b, a, c}, {a, a, b}, {d, d, d}, {a, c, d}});
  const NeighbourOrder doubled = order_in_bound(twice);
  EXPECT_EQ(doubled.patch_of_polygon[0], doubled.patch_of_polygon[1]) << "the same polygon twice is one patch";
  EXPECT_EQ(doubled.patch_of_polygon[0], doubled.patch_of_polygon[5]);

  Scene degenerate = empty_scene();
  add_mesh(degenerate, {{a, a, a}, {b, b, c}});
  (void)order_in_bound(degenerate);
}

TEST(NeighbourOrder, ObjectsThatTouchAreNeighboursInOneFlatSurface) {
  Scene scene = empty_scene();
  add_quad(scene, "left", {glm::vec3{0, 0, 0}, {1, 0, 0}, {1, 0, -1}, {0, 0, -1}});
  add_quad(scene, "right", {glm::vec3{1, 0, 0}, {2, 0, 0}, {2, 0, -1}, {1, 0, -1}});
  add_quad(scene, "above", {glm::vec3{0, 1, 0}, {2, 1, 0}, {2, 1, -1}, {0, 1, -1}});
  const NeighbourOrder order = order_in_bound(scene);
  EXPECT_NE(order.patch_of_polygon[0], order.patch_of_polygon[2]) << "a patch never spans objects";
  EXPECT_TRUE(equal(order, 0, 2));
  EXPECT_FALSE(equal(order, 0, 4)) << "it is shadowed from above";
}

TEST(NeighbourOrder, ABoxOnAFloorShadowsIt) {
  Scene scene = empty_scene();
  add_quad(scene, "floor", {glm::vec3{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}});
  add_box(scene, "box", {-1, 0, -1}, {1, 2, 1});
  const NeighbourOrder order = order_in_bound(scene);
  for (std::uint32_t t = 2; t < scene.triangles.size(); ++t) {
    const glm::vec3 p = scene.positions[scene.triangles[t].x], q = scene.positions[scene.triangles[t].y],
                    r = scene.positions[scene.triangles[t].z];
    const bool bottom = p.y == 0.0F && q.y == 0.0F && r.y == 0.0F;
    EXPECT_TRUE(bottom || !equal(order, 0, t)) << t;
  }
}

TEST(NeighbourOrder, ScopesAreOrderedToo) {
  Scene scene = empty_scene();
  add_mesh(scene, torus(24, 12));
  std::vector<std::uint32_t> units;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) units.push_back(t / 16);
  const auto order = order_by_neighbours(scene, {.scope = IndexScope::section}, profiles::geforce2, units);
  ASSERT_TRUE(order.ok());
  EXPECT_EQ(order->patch_of_polygon, units);
  expect_bound(scene, *order);
}

// Level squares above one another: each may shadow all others.
Scene stack(int squares) {
  Scene scene = empty_scene();
  for (int i = 0; i < squares; ++i) {
    const float y = static_cast<float>(i);
    add_quad(scene, "square", {glm::vec3{0, y, 0}, {1, y, 0}, {1, y, -1}, {0, y, -1}});
  }
  return scene;
}

TEST(NeighbourOrder, MorePatchesThanCodesIsAnError) {
  const IndexSettings alpha{.format = IndexFormat::alpha, .order = IndexOrder::neighbour};
  (void)order_in_bound(stack(127), alpha);
  const auto order = order_by_neighbours(stack(128), alpha, profiles::geforce2);
  ASSERT_FALSE(order.ok());
  EXPECT_NE(order.error().message.find("too many patches: 128 of them"), std::string::npos) << order.error().message;
  EXPECT_NE(order.error().message.find("codes 2 apart has 128"), std::string::npos) << order.error().message;
}

// Steps keep patches that must differ apart by as much.
TEST(NeighbourOrder, StepsWidenTheLattice) {
  const Scene scene = stack(40);
  for (const int step : {1, 2, 3, 4, 16}) {
    const NeighbourOrder order = order_in_bound(scene, {.step = step});
    for (std::size_t i = 0; i < order.code.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const CodeBytes d = difference(order.code[i], order.code[j]);
        EXPECT_GE(std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}), std::max(step, 2));
      }
    }
  }
}

std::vector<std::filesystem::path> scene_files() {
  const std::filesystem::path scenes = NINEBIT_SOURCE_DIR "/scenes", glmark = "/usr/share/glmark2/models",
                              assimp = "/usr/share/assimp/models";
  return {scenes / "index_room.gltf",  scenes / "cornell_box.gltf",
          glmark / "bunny.obj",        glmark / "horse.3ds",
          glmark / "cat.3ds",          glmark / "asteroid-high.3ds",
          glmark / "asteroid-low.3ds", glmark / "cube.3ds",
          assimp / "OBJ/WusonOBJ.obj", assimp / "OBJ/spider.obj",
          assimp / "3DS/fels.3ds",     assimp / "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"};
}

TEST(NeighbourOrder, TheBoundHoldsOnAllScenes) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const auto& file : scene_files()) {
    if (!std::filesystem::exists(file)) continue;  // of a package that is not installed
    SCOPED_TRACE(file.string());
    const auto read = read_scene(file);
    ASSERT_TRUE(read.ok()) << read.error().text();
    const Scene scene = *complete_scene(*read, {}, 4.0F / 3.0F);
    const NeighbourOrder order = order_in_bound(scene);
    EXPECT_LT(order.report.broken_share, 0.12);
  }
}

TEST(NeighbourOrder, TheSameForAnyNumberOfThreads) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  Scene scene = empty_scene();
  add_mesh(scene, torus(64, 32));
  const auto with = [&](std::size_t threads) {
    const ScopedThreadLimit limit(threads);
    return order_of(scene);
  };
  const NeighbourOrder one = with(1), four = with(4);
  EXPECT_EQ(one.code, four.code);
  EXPECT_EQ(one.patch_of_polygon, four.patch_of_polygon);
}

}  // namespace
