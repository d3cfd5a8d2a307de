// Each pixel's truth, against formulas.
#include "ninebit/shadow/ground_truth.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "combiner_tests/shadow/ground_truth_support.h"
#include "combiner_tests/support/slow_build.h"

namespace shadow_test {
namespace {

using namespace ninebit;

constexpr float kEdge = 1e-4F;  // world units that a formula leaves to either side of a shadow's border

// Calls visit(i, x, y, triangle) for each pixel that shows one.
template <class Visit>
void for_each_pixel(const RenderSettings& settings, const Rendering& rendering, const Visit& visit) {
  shadow_test::for_each_pixel(settings, [&](int x, int y, std::size_t i) {
    const std::uint32_t triangle = rendering.frame.primitive()[i];
    if (triangle != 0xFFFFFFFF) visit(i, x, y, triangle);
  });
}

// Square over floor: in shadow on the floor where `in_shadow` of the distance from the middle says so.
template <class InShadow>
void expect_on_floor(const Scene& scene, float border, const InShadow& in_shadow) {
  const RenderSettings settings = judged_settings();
  const Rendering r = all_lit(scene, settings);
  const GroundTruth truth = judged(scene, settings, r);
  std::array<int, 2> seen{};
  for_each_pixel(settings, r, [&](std::size_t i, int x, int y, std::uint32_t triangle) {
    if (triangle > 1) {
      EXPECT_EQ(truth.truth[i], PixelTruth::lit) << "the square at " << x << "," << y;
      return;
    }
    const glm::vec3 p = on_plane(scene, settings, x, y, 0.0F);
    const float from_middle = std::max(std::fabs(p.x), std::fabs(p.z));
    if (std::fabs(from_middle - 1.5F) < kEdge || std::fabs(from_middle - border) < kEdge) return;
    const bool shadowed = in_shadow(from_middle);
    ++seen[shadowed ? 1 : 0];
    EXPECT_EQ(truth.truth[i], shadowed ? PixelTruth::shadowed : PixelTruth::lit) << x << "," << y;
  });
  EXPECT_GT(seen[0], 300);
  EXPECT_GT(seen[1], 300);
  EXPECT_EQ(truth.false_shadowed, 0U);
  EXPECT_EQ(truth.false_lit, count(truth, ErrorCause::sampling)) << "nothing else can be wrong without a map";
}

TEST(GroundTruth, SquareOverFloor) {
  expect_on_floor(square_over_floor(), 1.5F, [](float d) { return d < 1.5F; });
}

// Embree sets the processor to flush denormals while it works. A thread whose first parallel work that was would do all
// later one so.
TEST(GroundTruth, LeavesTheArithmeticOfOtherParallelWorkAlone) {
  std::atomic<int> flushed = 0;
  std::thread([&] {
    const Scene scene = square_over_floor();
    ASSERT_TRUE(GroundTruthScene::make(scene).ok());
    tbb::parallel_for(0, 1000, [&](int) {
      const volatile float small = std::numeric_limits<float>::min();
      if (small * 0.25F == 0.0F) ++flushed;
    });
  }).join();
  EXPECT_EQ(flushed, 0);
}

TEST(GroundTruth, BehindASpotLightsSidesIsNoLight) {
  Scene scene = square_over_floor();
  scene.lights[0].kind = LightKind::spot;
  scene.lights[0].spot_degrees = 70.0F;
  const float reach = 3.0F * std::tan(35.0F * std::numbers::pi_v<float> / 180.0F);
  expect_on_floor(scene, reach, [&](float d) { return d < 1.5F || d > reach; });
}

TEST(GroundTruth, ADirectionalLightCastsTheSquareItself) {
  Scene scene = square_over_floor();
  scene.lights[0].kind = LightKind::directional;
  scene.lights[0].position = {50.0F, -7.0F, 0.0F};  // which plays no part
  expect_on_floor(scene, 1.0F, [](float d) { return d < 1.0F; });
}

// Whether the segment from p to the light passes through the inside of an axis-parallel box.
bool through_box(const glm::dvec3& p, const glm::dvec3& light, const glm::dvec3& low, const glm::dvec3& high) {
  double enter = 0.0, leave = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double way = light[k] - p[k];
    if (way == 0.0) {
      if (p[k] < low[k] || p[k] > high[k]) return false;
      continue;
    }
    const double a = (low[k] - p[k]) / way, b = (high[k] - p[k]) / way;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

TEST(GroundTruth, ABoxThatStandsOnTheFloor) {
  Scene scene = scene_with({4.0F, 4.0F, 5.0F}, {0.0F, 0.3F, 0.0F}, {-2.0F, 3.0F, 1.5F});
  add_quad(scene, "floor", {{{-6, 0, 6}, {6, 0, 6}, {6, 0, -6}, {-6, 0, -6}}});
  const glm::vec3 low(-1.0F, 0.0F, -0.5F), high(0.5F, 1.25F, 1.0F);
  add_box(scene, "box", low, high);
  const RenderSettings settings = judged_settings();
  const Rendering r = all_lit(scene, settings);
  const GroundTruth truth = judged(scene, settings, r);
  std::array<int, 4> seen{};
  for_each_pixel(settings, r, [&](std::size_t i, int x, int y, std::uint32_t triangle) {
    const glm::uvec3& t = scene.triangles[triangle];
    bool shadowed;
    if (triangle < 2) {
      const glm::vec3 p = on_plane(scene, settings, x, y, 0.0F);
      const glm::dvec3 wide(kEdge);
      const bool narrow = through_box(p, scene.lights[0].position, glm::dvec3(low) + wide, glm::dvec3(high) - wide);
      shadowed = through_box(p, scene.lights[0].position, glm::dvec3(low) - wide, glm::dvec3(high) + wide);
      if (narrow != shadowed) return;  // too near to the border
    } else {                           // a side of a convex solid sees the light if it faces it
      shadowed = glm::dot(scene.normals[t.x], scene.lights[0].position - scene.positions[t.x]) < 0.0F;
    }
    ++seen[(triangle < 2 ? 0U : 2U) + (shadowed ? 1U : 0U)];
    EXPECT_EQ(truth.truth[i], shadowed ? PixelTruth::shadowed : PixelTruth::lit) << x << "," << y;
  });
  for (const int n : seen) EXPECT_GT(n, 100);
}

// A sphere of flat pieces: what faces the light is lit, up to the last pixel of each joint.
TEST(GroundTruth, JointsOfAConvexSolidCastNoShadow) {
  Scene scene = scene_with({0.0F, 1.0F, 4.0F}, {0.0F, 0.0F, 0.0F}, {3.0F, 2.0F, 1.0F});
  constexpr int kRings = 40, kSides = 60;
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int side = 0; side < kSides; ++side) {
      const double polar = std::numbers::pi * ring / kRings, around = 2.0 * std::numbers::pi * side / kSides;
      const glm::dvec3 p(std::sin(polar) * std::cos(around), std::cos(polar), -std::sin(polar) * std::sin(around));
      scene.positions.emplace_back(p);
      scene.normals.emplace_back(p);
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t next = (side + 1) % kSides, here = ring * kSides, below = here + kSides;
      scene.triangles.emplace_back(here + side, below + side, below + next);
      scene.triangles.emplace_back(here + side, below + next, here + next);
    }
  }
  const auto n = static_cast<std::uint32_t>(scene.triangles.size());
  scene.objects.push_back({"sphere", 0, n});
  scene.triangle_object.assign(n, 0);
  scene.triangle_material.assign(n, 0);

  const RenderSettings settings = judged_settings(400, 300);
  const Rendering r = all_lit(scene, settings);
  const GroundTruth truth = judged(scene, settings, r);
  int facing = 0, averted = 0, averted_and_lit = 0;
  for_each_pixel(settings, r, [&](std::size_t i, int x, int y, std::uint32_t triangle) {
    const glm::uvec3& t = scene.triangles[triangle];
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const double above = glm::dot(normal, glm::dvec3(scene.lights[0].position) - a);
    if (std::fabs(above) < 1e-5) return;
    if (above > 0.0) {
      ++facing;
      EXPECT_EQ(truth.truth[i], PixelTruth::lit) << x << "," << y;
    } else {
      ++averted;
      averted_and_lit += truth.truth[i] == PixelTruth::lit ? 1 : 0;
    }
  });
  EXPECT_GT(facing, 5000);
  EXPECT_GT(averted, 5000);
  // Where a pixel's ray just misses its triangle, the point is on a joint, which the light may reach.
  EXPECT_LT(averted_and_lit, 10);
}

// A sheet that lies on another one touches it; its underside does not shade what it lies on.
TEST(GroundTruth, WhatTouchesCastsNoShadow) {
  Scene scene = square_over_floor();
  for (glm::vec3& p : scene.positions) p.y = 0.0F;
  scene.lights[0].position = {5.0F, 0.5F, 0.0F};
  const RenderSettings settings = judged_settings();
  EXPECT_EQ(judged(scene, settings, all_lit(scene, settings)).false_lit, 0U);
  scene.lights[0].position = {5.0F, 0.0F, 0.0F};  // in the plane of both
  EXPECT_EQ(judged(scene, settings, all_lit(scene, settings)).false_lit, 0U);
}

TEST(GroundTruth, WithLightFacingTheUndersideIsInShadow) {
  Scene scene = square_over_floor();
  scene.lights[0].position = {0.0F, -3.0F, 0.0F};
  RenderSettings settings = judged_settings();
  const auto floor_is_lit = [&] {
    const Rendering r = all_lit(scene, settings);
    const GroundTruth truth = judged(scene, settings, r);
    std::uint64_t lit = 0;
    for_each_pixel(settings, r, [&](std::size_t i, int, int, std::uint32_t triangle) {
      lit += triangle < 2 && truth.truth[i] == PixelTruth::lit ? 1U : 0U;
    });
    return lit;
  };
  EXPECT_GT(floor_is_lit(), 1000U) << "both sides of a polygon are lit alike";
  settings.light_facing = true;
  EXPECT_EQ(floor_is_lit(), 0U);
}

TEST(GroundTruth, IsTheSameForAnyNumberOfThreads) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  const Scene scene = index_room();
  const RenderSettings settings = judged_settings(160, 120);
  const Rendering r = render(scene, settings);
  const GroundTruth all = judged(scene, settings, r);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const GroundTruth alone = judged(scene, settings, r);
  EXPECT_EQ(all.truth, alone.truth);
  EXPECT_EQ(all.cause, alone.cause);
  EXPECT_EQ(all.by_cause, alone.by_cause);
}

TEST(GroundTruth, RefusesWhatItCannotJudge) {
  const Scene scene = square_over_floor();
  RenderSettings settings = judged_settings();
  const auto rays = GroundTruthScene::make(scene);
  ASSERT_TRUE(rays);
  settings.evidence = false;
  settings.layers = true;
  EXPECT_NE(measure(*rays, settings, render(scene, settings)).error().message.find("evidence"), std::string::npos);
  settings.evidence = true;
  const Rendering r = render(scene, settings);
  settings.width += 1;
  EXPECT_NE(measure(*rays, settings, r).error().message.find("201 x 150"), std::string::npos);
  settings.width -= 1;
  const auto stop = [](std::string_view, double done) { return done < 0.5; };
  EXPECT_EQ(measure(*rays, settings, r, stop).error().fault, Fault::cancelled);
  Scene dark = scene;
  dark.lights.clear();
  EXPECT_FALSE(GroundTruthScene::make(dark));
}

}  // namespace
}  // namespace shadow_test
