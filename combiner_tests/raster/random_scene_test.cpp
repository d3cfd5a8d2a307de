// Random scenes: every plane as the oracle draws it.
//
// One case again, alone: NINEBIT_RASTER_INDEX=123. More cases: NINEBIT_RASTER_COUNT=100000.
#include "combiner_tests/raster/random_scene.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

namespace ninebit::test {
namespace {

constexpr std::uint64_t kSeed = 0x7261737465720001U;
constexpr std::uint64_t kCases = kSlowBuild ? 300 : 8000;

std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 0);
}

struct Seen {
  oracle::Tally tally;
  std::uint64_t changed_planes[4]{};  // scenes in which colour, depth, stencil, primitive changed
  // Drawn or rejected fragments by what decided about them.
  std::array<std::uint64_t, 8> alpha{}, stencil{}, depth{}, stencil_fail{}, depth_fail{}, depth_pass{};

  void add(const PipelineState& state, const oracle::Tally& one) {
    const auto at = [](auto value) { return static_cast<std::size_t>(value); };
    tally.fragments += one.fragments;
    tally.alpha_fail += one.alpha_fail;
    tally.stencil_fail += one.stencil_fail;
    tally.depth_fail += one.depth_fail;
    tally.drawn += one.drawn;
    const std::uint64_t after_alpha = one.fragments - one.alpha_fail;
    const std::uint64_t after_stencil = after_alpha - one.stencil_fail;
    if (state.alpha_test.enabled) alpha[at(state.alpha_test.function)] += one.fragments;
    if (state.depth_test.enabled) depth[at(state.depth_test.function)] += after_stencil;
    if (!state.stencil_test.enabled) return;
    stencil[at(state.stencil_test.function)] += after_alpha;
    stencil_fail[at(state.stencil_test.fail)] += one.stencil_fail;
    depth_fail[at(state.stencil_test.depth_fail)] += one.depth_fail;
    depth_pass[at(state.stencil_test.depth_pass)] += one.drawn;
  }
};

bool colors_agree(const oracle::Picture& actual, const oracle::Picture& expected, int tolerance) {
  for (std::size_t i = 0; i < expected.color.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const int difference = actual.color[i][k] - expected.color[i][k];
      if (difference > tolerance || difference < -tolerance) return false;
    }
    const int captured = actual.captured[i] - expected.captured[i];
    if (captured > tolerance || captured < -tolerance) return false;
  }
  return true;
}

void run_case(std::uint64_t index, Seen& seen) {
  Random random(kSeed, index);
  const RandomScene scene = random_scene(random);
  Canvas canvas(scene.width, scene.height, scene.captures);
  canvas.load(scene.start);
  oracle::Picture expected = scene.start;
  int tolerance = 0;
  for (std::size_t i = 0; i < scene.draws.size(); ++i) {
    const RandomDraw& draw = scene.draws[i];
    oracle::Tally tally;
    oracle::draw(draw.state, for_oracle(draw), expected, tally);
    seen.add(draw.state, tally);
    if (!draw.exact_color) tolerance = 1;

    const Mesh mesh = for_library(draw, scene.width, scene.height);
    const Status status = rasterize(draw.state, kIdentity, mesh.arrays(), {}, canvas.target);
    ASSERT_TRUE(status.ok()) << status.error().message;
    const oracle::Picture actual = canvas.picture();
    if (!scene.captures) expected.captured = actual.captured;
    const bool same = actual.depth_z24 == expected.depth_z24 && actual.stencil == expected.stencil &&
                      actual.primitive == expected.primitive && colors_agree(actual, expected, tolerance);
    ASSERT_TRUE(same) << "planes differ after draw " << i << ": depth " << (actual.depth_z24 != expected.depth_z24)
                      << " stencil " << (actual.stencil != expected.stencil) << " primitive "
                      << (actual.primitive != expected.primitive) << " colour or capture "
                      << !colors_agree(actual, expected, tolerance) << '\n'
                      << describe(scene);
    ASSERT_TRUE(canvas.padding_is_whole());
  }
  seen.changed_planes[0] += expected.color != scene.start.color ? 1U : 0U;
  seen.changed_planes[1] += expected.depth_z24 != scene.start.depth_z24 ? 1U : 0U;
  seen.changed_planes[2] += expected.stencil != scene.start.stencil ? 1U : 0U;
  seen.changed_planes[3] += expected.primitive != scene.start.primitive ? 1U : 0U;
}

void expect_all_reached(const std::array<std::uint64_t, 8>& bucket, const char* name, std::uint64_t least) {
  for (std::size_t i = 0; i < bucket.size(); ++i) EXPECT_GE(bucket[i], least) << name << ' ' << i;
}

TEST(RandomScenes, EveryPlaneIsAsTheOracleDrawsIt) {
  const std::uint64_t count = number_from_environment("NINEBIT_RASTER_COUNT", kCases);
  const bool replay = std::getenv("NINEBIT_RASTER_INDEX") != nullptr;
  const std::uint64_t first = number_from_environment("NINEBIT_RASTER_INDEX", 0);
  const std::uint64_t end = replay ? first + 1 : count;

  Seen seen;
  for (std::uint64_t index = first; index < end; ++index) {
    run_case(index, seen);
    if (HasFailure()) FAIL() << "case " << index << "; again with NINEBIT_RASTER_INDEX=" << index;
  }
  if (replay) return;
  RecordProperty("fragments", std::to_string(seen.tally.fragments));
  RecordProperty("drawn", std::to_string(seen.tally.drawn));

  // A run that draws next to nothing, or leaves a function or an operation out, proves nothing.
  EXPECT_GE(seen.tally.drawn, 100 * count);
  EXPECT_GE(seen.tally.alpha_fail, 100 * count);
  EXPECT_GE(seen.tally.stencil_fail, 100 * count);
  EXPECT_GE(seen.tally.depth_fail, 100 * count);
  for (const std::uint64_t scenes : seen.changed_planes) EXPECT_GE(scenes, count / 4);
  expect_all_reached(seen.alpha, "alpha function", 50 * count);
  expect_all_reached(seen.stencil, "stencil function", 50 * count);
  expect_all_reached(seen.depth, "depth function", 20 * count);
  expect_all_reached(seen.stencil_fail, "stencil fail operation", count);
  expect_all_reached(seen.depth_fail, "depth fail operation", count);
  expect_all_reached(seen.depth_pass, "depth pass operation", count);
}

// The comparison must be able to tell: the same scene with one rule of the state bent gives other planes.
TEST(RandomScenes, TheOracleTellsStatesApart) {
  int told = 0, cases = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    Random random(kSeed, index);
    const RandomScene scene = random_scene(random);
    oracle::Picture right = scene.start, bent = scene.start;
    oracle::Tally tally;
    for (RandomDraw draw : scene.draws) {
      oracle::draw(draw.state, for_oracle(draw), right, tally);
      draw.state.depth_test.function =
          static_cast<CompareFunction>(static_cast<int>(draw.state.depth_test.function) ^ 7);
      oracle::draw(draw.state, for_oracle(draw), bent, tally);
    }
    ++cases;
    if (right.depth_z24 != bent.depth_z24 || right.stencil != bent.stencil || right.color != bent.color) ++told;
  }
  EXPECT_GE(told, cases / 2);
}

}  // namespace
}  // namespace ninebit::test
