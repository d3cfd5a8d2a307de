// Random scenes: every plane as the oracle draws it.
//
// One case again, alone: NINEBIT_RASTER_INDEX=123 (and NINEBIT_RASTER_SEED, if it was set). More cases:
// NINEBIT_RASTER_COUNT=100000, shared by the shards. NINEBIT_RASTER_THREADS=5 and NINEBIT_RASTER_TARGET=1 draw with so
// many threads and on the SIMD target with that number, of those that the machine has; NINEBIT_RASTER_TABLE=1 prints
// how many fragments met each value of each state.
#include "combiner_tests/raster/random_scene.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/support/environment.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kSceneSeed = 0x7261737465720001U;
constexpr std::uint64_t kShards = 8;
constexpr std::uint64_t kSceneCases = kSlowBuild ? 1600 : 24000;

// How many fragments met each value of each state: a table without an empty bucket shows that the run proves something.
class StateTable {
 public:
  // `values`: how many a full table has, from 0 on.
  void add(const std::string& state, int values, int value, std::uint64_t fragments) {
    Buckets& buckets = states_[state];
    buckets.values = values;
    buckets.fragments[value] += fragments;
  }

  void add(const RandomDraw& draw, const oracle::Picture& start, const oracle::Tally& t) {
    const DepthStencilFormat format = start.format;
    const PipelineState& s = draw.state;
    const auto number = [](auto value) { return static_cast<int>(value); };
    const std::uint64_t after_alpha = t.fragments - t.alpha_fail, after_stencil = after_alpha - t.stencil_fail;
    const bool is_polygon = draw.type >= PrimitiveType::triangles;
    add("type", 10, number(draw.type), t.fragments);
    add("format", 9, number(format), t.fragments);
    add("colour format", 10, number(start.color_format), t.drawn);
    add("shade model", 2, number(s.shade_model), t.fragments);
    add("subpixel bits", 5, s.profile.subpixel_bits, t.fragments);
    const std::uint64_t of_points = draw.type == PrimitiveType::points ? t.fragments : 0;
    const std::uint64_t of_lines = !is_polygon && draw.type != PrimitiveType::points ? t.fragments : 0;
    const auto kind = [&](float size) { return size != std::floor(size) ? 2 : number(size) % 2; };
    add("point size is odd, or not whole", 3, kind(s.point_size), of_points);
    add("line width is odd, or not whole", 3, kind(s.line_width), of_lines);
    add("shape of points", 2, number(s.profile.point_shape.value), of_points);
    add("smooth lines", 2, number(s.line_smooth), of_lines);
    add("shape of lines", 2, number(s.profile.line_shape.value), of_lines);
    add("viewport", 2, number(s.viewport.has_value()), t.fragments);
    add("scissor", 2, number(s.scissor.has_value()), t.fragments);
    add("depth range", 2, number(s.depth_near != 0 || s.depth_far != 1), t.fragments);
    add("indices", 2, number(!draw.indices.empty()), t.fragments);
    add("clear", 2, number(draw.clear.has_value()), t.fragments);
    add("colours", 3, number(!draw.vertex_colors.empty()) + 2 * number(!draw.primitive_colors.empty()), t.fragments);
    if (is_polygon) {
      add("cull face", 4, number(s.cull_face), s.cull_face == CullFace::front_and_back ? 1000 : t.fragments);
      add("front face", 2, number(s.front_face), t.fragments);
      add("stipple", 2, number(s.polygon_stipple.has_value()), t.fragments);
      add("smooth polygons", 2, number(s.polygon_smooth), t.fragments);
      add("modes", 9, 3 * number(s.front_mode) + number(s.back_mode), t.fragments);
      const PolygonOffset& o = s.polygon_offset;
      add("offset", 8, number(o.fill) + 2 * number(o.line) + 4 * number(o.point), t.fragments);
      if (o.fill || o.line || o.point) {
        add("slope", 2, number(s.profile.polygon_offset_slope.value), t.fragments);
        add("format of offsets", 9, number(format), t.fragments);
        add("fraction", 2, number(s.profile.polygon_offset_fraction.value), t.fragments);
      }
    }
    if (s.alpha_test.enabled) add("alpha function", 8, number(s.alpha_test.function), t.fragments);
    if (s.depth_test.enabled) add("depth function", 8, number(s.depth_test.function), after_stencil);
    if (s.blend.enabled) {
      add("colour format of blends", 8, number(start.color_format), t.drawn);
      add("blend equation", 5, number(s.blend.equation), t.drawn);
      add("blend source", 15, number(s.blend.source), t.drawn);
      add("blend destination", 14, number(s.blend.destination), t.drawn);
    }
    if (!s.stencil_test.enabled || stencil_bits(format) == 0) return;
    add("format of stencils", 0, number(format), after_alpha);
    add("stencil sides", 2, number(s.stencil_test.back.has_value()), after_alpha);
    add("stencil function", 8, number(s.stencil_test.front.function), after_alpha);
    add("stencil fail", 8, number(s.stencil_test.front.fail), t.stencil_fail);
    add("depth fail", 8, number(s.stencil_test.front.depth_fail), t.depth_fail);
    add("depth pass", 8, number(s.stencil_test.front.depth_pass), t.drawn);
    const int function = 8 * number(s.stencil_test.front.function);
    add("stencil function, then stencil fail", 0, function + number(s.stencil_test.front.fail), t.stencil_fail);
    add("stencil function, then depth fail", 0, function + number(s.stencil_test.front.depth_fail), t.depth_fail);
    add("stencil function, then depth pass", 0, function + number(s.stencil_test.front.depth_pass), t.drawn);
  }

  [[nodiscard]] std::string text() const {
    std::string out;
    for (const auto& [state, buckets] : states_) {
      out += state + ':';
      for (const auto& [value, fragments] : buckets.fragments)
        out += "  " + std::to_string(value) + ' ' + std::to_string(fragments);
      out += '\n';
    }
    return out;
  }

  void expect_full(std::uint64_t least) const {
    EXPECT_EQ(states_.size(), 40U);
    for (const auto& [state, buckets] : states_) {
      for (int value = 0; value < buckets.values; ++value) {
        const auto found = buckets.fragments.find(value);
        EXPECT_GE(found == buckets.fragments.end() ? 0 : found->second, least) << state << ' ' << value;
      }
    }
  }

 private:
  struct Buckets {
    int values = 0;
    std::map<int, std::uint64_t> fragments;
  };
  std::map<std::string, Buckets> states_;
};

struct StatesSeen {
  oracle::Tally tally;
  StateTable states;
  std::uint64_t changed_planes[4]{};  // scenes in which colour, depth, stencil, primitive changed

  void add(const RandomDraw& draw, const oracle::Picture& start, const oracle::Tally& one) {
    tally.fragments += one.fragments;
    tally.alpha_fail += one.alpha_fail;
    tally.stencil_fail += one.stencil_fail;
    tally.depth_fail += one.depth_fail;
    tally.drawn += one.drawn;
    states.add(draw, start, one);
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

void run_clear(const RandomDraw& draw, PicturePlanes& planes, oracle::Picture& expected) {
  const oracle::Clear& c = *draw.clear;
  oracle::clear(draw.state, c, expected);
  const ClearValues values{.color = c.color, .depth = draw.clear_depth, .stencil = c.stencil};
  const Status status = clear(draw.state, {c.clears_color, c.clears_depth, c.clears_stencil}, values, planes.target);
  ASSERT_TRUE(status.ok()) << status.error().message;
}

void run_case(std::uint64_t seed, std::uint64_t index, StatesSeen& seen) {
  Random random(seed, index);
  const RandomScene scene = random_scene(random);
  PicturePlanes planes(scene.start, scene.captures);
  // Without output planes, vectors draw what they can; with them, single fragments.
  const bool has_outputs = scene.captures || index % 2 == 0;
  if (!has_outputs) planes.target.outputs.clear();
  oracle::Picture expected = scene.start;
  int tolerance = 0;
  for (std::size_t i = 0; i < scene.draws.size(); ++i) {
    const RandomDraw& draw = scene.draws[i];
    if (draw.clear) run_clear(draw, planes, expected);
    oracle::Tally tally;
    oracle::draw(draw.state, for_oracle(draw), expected, tally);
    seen.add(draw, scene.start, tally);
    if (!draw.exact_color) tolerance = 2;  // two weights may be whole 256ths, where floats fall to either side

    const LibraryDraw library = for_library(draw, scene.width, scene.height);
    const Status status = rasterize(draw.state, kIdentity, library.arrays, {}, planes.target);
    ASSERT_TRUE(status.ok()) << status.error().message;
    const oracle::Picture actual = planes.picture();
    if (!scene.captures) expected.captured = actual.captured;
    if (!has_outputs) expected.primitive = actual.primitive;
    const bool same = actual.depth == expected.depth && actual.stencil == expected.stencil &&
                      actual.primitive == expected.primitive && colors_agree(actual, expected, tolerance);
    ASSERT_TRUE(same) << "planes differ after draw " << i << ": depth " << (actual.depth != expected.depth)
                      << " stencil " << (actual.stencil != expected.stencil) << " primitive "
                      << (actual.primitive != expected.primitive) << " colour or capture "
                      << !colors_agree(actual, expected, tolerance) << '\n'
                      << describe(scene);
  }
  seen.changed_planes[0] += expected.color != scene.start.color ? 1U : 0U;
  seen.changed_planes[1] += expected.depth != scene.start.depth ? 1U : 0U;
  seen.changed_planes[2] += expected.stencil != scene.start.stencil ? 1U : 0U;
  seen.changed_planes[3] += expected.primitive != scene.start.primitive ? 1U : 0U;
}

class RandomScenes : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomScenes, EveryPlaneIsAsTheOracleDrawsIt) {
  const bool replay = std::getenv("NINEBIT_RASTER_INDEX") != nullptr;
  const std::uint64_t count = replay ? 1 : number_from_environment("NINEBIT_RASTER_COUNT", kSceneCases) / kShards;
  const std::uint64_t first = number_from_environment("NINEBIT_RASTER_INDEX", GetParam() * count);
  if (replay && GetParam() != 0) GTEST_SKIP() << "one case is run by the first shard";

  const std::uint64_t seed = number_from_environment("NINEBIT_RASTER_SEED", kSceneSeed);
  std::optional<OnTarget> on_target;
  if (std::getenv("NINEBIT_RASTER_TARGET") != nullptr) {
    const std::int64_t target =
        simd_targets()[number_from_environment("NINEBIT_RASTER_TARGET", 0) % simd_targets().size()];
    std::cout << "target " << simd_target_name(target) << '\n';
    on_target.emplace(target);
  }

  StatesSeen seen;
  const auto run = [&] {
    for (std::uint64_t index = first; index < first + count; ++index) {
      run_case(seed, index, seen);
      if (HasFailure()) {
        FAIL() << "case " << index << "; again with NINEBIT_RASTER_SEED=" << seed << " NINEBIT_RASTER_INDEX=" << index;
      }
    }
  };
  const auto threads = static_cast<int>(number_from_environment("NINEBIT_RASTER_THREADS", 0));
  threads == 0 ? run() : with_threads(threads, run);
  if (replay || HasFailure()) return;
  if (std::getenv("NINEBIT_RASTER_TABLE") != nullptr) std::cout << seen.states.text();
  RecordProperty("fragments", std::to_string(seen.tally.fragments));
  RecordProperty("drawn", std::to_string(seen.tally.drawn));

  // A run that draws next to nothing, or leaves a value of a state out, proves nothing.
  EXPECT_GE(seen.tally.drawn, 50 * count);
  EXPECT_GE(seen.tally.alpha_fail, 50 * count);
  EXPECT_GE(seen.tally.stencil_fail, (count >= 1000 ? 20 : 5) * count);  // few scenes have most of them
  EXPECT_GE(seen.tally.depth_fail, 50 * count);
  for (const std::uint64_t scenes : seen.changed_planes) EXPECT_GE(scenes, count / 8);
  if (count >= 1000) seen.states.expect_full(count / 10);
}

INSTANTIATE_TEST_SUITE_P(Shard, RandomScenes, testing::Range(std::uint64_t{0}, kShards));

// The comparison must be able to tell: the same scene with one rule of the state bent gives other planes.
TEST(RandomScenesOracle, TellsStatesApart) {
  int told = 0, cases = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    Random random(kSceneSeed, index);
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
    if (right.depth != bent.depth || right.stencil != bent.stencil || right.color != bent.color) ++told;
  }
  EXPECT_GE(told, cases / 3);
}

}  // namespace
}  // namespace ninebit::test
