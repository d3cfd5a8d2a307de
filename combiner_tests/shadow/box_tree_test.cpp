// The tree of boxes against Embree: the same triangles on random rays, and the same judgement of whole renderings.
#include <algorithm>
#include <cmath>
#include <random>

#include "combiner_tests/shadow/ground_truth_support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/shadow/index_cube.h"
#include "src/shadow/ground_truth/ground_truth_rays.h"

namespace shadow_test {
namespace {

using namespace ninebit;

GroundTruthScene with_embree(const Scene& scene) {
  auto made = GroundTruthScene::make(scene);
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(*made);
}

GroundTruthScene with_tree(const Scene& scene) {
  auto made = GroundTruthScene::make_portable(scene);
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(*made);
}

struct Compared {
  int rays = 0, blocked = 0;
  std::size_t crossed = 0;
};

// Rays that begin on triangles or beside them and end anywhere, or never; some run along an axis.
Compared compare_rays(const Scene& scene, unsigned seed, int count) {
  const GroundTruthScene embree = with_embree(scene), tree = with_tree(scene);
  const Bounds bounds = bounds_of(scene);
  std::mt19937 random(seed);
  const auto share = [&] { return static_cast<double>(random()) * 0x1p-32; };
  const auto point = [&] {
    const glm::dvec3 size(bounds.high - bounds.low);
    const double x = share(), y = share();
    return glm::dvec3(bounds.low) + size * (glm::dvec3(x, y, share()) * 1.5 - 0.25);
  };
  Compared seen;
  std::vector<RayCrossing> expected, found;
  for (int i = 0; i < count; ++i) {
    const auto own = static_cast<std::uint32_t>(random() % scene.triangles.size());
    const Corners corners = corners_of(scene, own);
    LightRay ray;
    ray.from = i % 3 == 0 ? point() : corners.a + (corners.b - corners.a) * share() + (corners.c - corners.a) * share();
    ray.way = point() - ray.from;
    if (i % 5 == 0) ray.way[static_cast<glm::length_t>(random() % 3)] = 0.0;
    ray.endless = i % 7 == 0;
    embree.rays().find_all(ray, own, expected);
    tree.rays().find_all(ray, own, found);
    const auto same = [](const RayCrossing& l, const RayCrossing& r) {
      return l.triangle == r.triangle && l.at == r.at;
    };
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.begin(), found.end(), same))
        << "seed " << seed << ", ray " << i << ": " << expected.size() << " with Embree, " << found.size();
    EXPECT_EQ(tree.rays().blocked(ray, own), !expected.empty());
    ++seen.rays;
    seen.blocked += expected.empty() ? 0 : 1;
    seen.crossed += expected.size();
  }
  return seen;
}

TEST(BoxTree, CrossesTheTrianglesThatEmbreeCrosses) {
  constexpr int kRays = ninebit::test::kSlowBuild ? 2'000 : 20'000;
  const Compared room = compare_rays(index_room(), 1, kRays);
  EXPECT_GT(room.blocked, kRays / 4);
  EXPECT_LT(room.blocked, kRays / 20 * 19);
  EXPECT_GT(room.crossed, kRays / 2U);
}

// `side` x `side` hills of two triangles each.
Scene hills(std::uint32_t side) {
  Scene scene = scene_with(glm::vec3(0.0F, 2.0F, 4.0F), glm::vec3(0.0F), glm::vec3(1.0F, 3.0F, 2.0F));
  for (std::uint32_t y = 0; y <= side; ++y) {
    for (std::uint32_t x = 0; x <= side; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(side),
                  v = static_cast<float>(y) / static_cast<float>(side);
      scene.positions.emplace_back(4.0F * u - 2.0F, 0.4F * std::sin(19.0F * u) * std::cos(23.0F * v), 4.0F * v - 2.0F);
      if (x == side || y == side) continue;
      const std::uint32_t corner = y * (side + 1) + x;
      scene.triangles.emplace_back(corner, corner + 1, corner + side + 1);
      scene.triangles.emplace_back(corner + side + 2, corner + 1, corner + side + 1);
    }
  }
  const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
  scene.normals.assign(scene.positions.size(), glm::vec3(0.0F));
  scene.objects.push_back({"hills", 0, triangles});
  scene.triangle_object.assign(triangles, 0);
  scene.triangle_material.assign(triangles, 0);
  return scene;
}

TEST(BoxTree, DenseAndTinyMeshes) {
  EXPECT_GT(compare_rays(hills(100), 2, 4'000).crossed, 1'000U);
  EXPECT_GT(compare_rays(hills(1), 3, 4'000).crossed, 100U) << "a tree of one leaf";
}

void expect_same_truth(const GroundTruth& expected, const GroundTruth& found) {
  EXPECT_EQ(found.false_lit, expected.false_lit);
  EXPECT_EQ(found.false_shadowed, expected.false_shadowed);
  EXPECT_EQ(found.by_cause, expected.by_cause);
  EXPECT_TRUE(found.truth == expected.truth);
  EXPECT_TRUE(found.cause == expected.cause);
}

TEST(BoxTree, JudgesTheRoomAsEmbreeDoes) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Scene scene = index_room();
  for (const int step : {1, 2}) {
    for (const int map_size : {32, 256}) {
      for (const LightKind kind : {LightKind::point, LightKind::directional}) {
        SCOPED_TRACE(std::to_string(step) + ", " + std::to_string(map_size));
        RenderSettings settings = judged_settings();
        settings.index.step = step;
        settings.map_size = map_size;
        Scene lit = scene;
        lit.lights[0].kind = kind;
        if (kind == LightKind::directional) lit.lights[0].direction = glm::normalize(glm::vec3(0.3F, -1.0F, 0.2F));
        auto rendering =
            kind == LightKind::point ? render_index_cube(lit, settings, {}) : Result<Rendering>(all_lit(lit, settings));
        ASSERT_TRUE(rendering) << rendering.error().text();
        if (!rendering->evidence) rendering->evidence.emplace();
        const auto expected = measure(with_embree(lit), settings, *rendering);
        const auto found = measure(with_tree(lit), settings, *rendering);
        ASSERT_TRUE(expected) << expected.error().text();
        ASSERT_TRUE(found) << found.error().text();
        EXPECT_GT(expected->false_lit + expected->false_shadowed, 50U);
        expect_same_truth(*expected, *found);
      }
    }
  }
}

}  // namespace
}  // namespace shadow_test
