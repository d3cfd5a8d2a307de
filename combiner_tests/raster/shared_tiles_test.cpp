// Passes drawn together, tile by tile, leave what the same passes leave when they are drawn one after the other, a
// fragment at a time: on every SIMD target, in any number of threads.
//
// One case again, alone: NINEBIT_RASTER_INDEX=123.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/raster/random_passes.h"
#include "combiner_tests/support/environment.h"
#include "combiner_tests/support/slow_build.h"
#include "src/raster/draw/tile.h"
#include "src/raster/lanes/tile_planes.h"

namespace ninebit::test {
namespace {

// The planes after rasterize(), called once for each pass; with an output plane no vectors draw.
oracle::Picture drawn_alone(const PassScene& scene, bool with_outputs, SampleLayout layout = SampleLayout::planes) {
  Canvas canvas(scene.width, scene.height, false, layout);
  scene.begin(canvas, with_outputs);
  if (scene.clear) {
    EXPECT_TRUE(clear({}, {}, *scene.clear, canvas.target).ok());
  }
  for (const RandomPass& pass : scene.passes) {
    const Status status = rasterize(pass.state, scene.matrix, scene.arrays(pass), pass.units(), canvas.target);
    EXPECT_TRUE(status.ok()) << status.error().message;
  }
  EXPECT_TRUE(canvas.padding_is_whole());
  return canvas.picture();
}

// The passes as rasterize() takes them.
struct Passes {
  explicit Passes(const PassScene& scene) {
    units.reserve(scene.passes.size());
    for (const RandomPass& pass : scene.passes) {
      units.push_back(pass.units());
      passes.push_back({.state = &pass.state, .arrays = scene.arrays(pass), .units = units.back()});
    }
  }
  std::vector<std::vector<TextureUnit>> units;
  std::vector<DrawPass> passes;
};

struct Ways {
  bool discard_depth = false;
  bool with_outputs = false;
  bool with_probe = false;
  SampleLayout layout = SampleLayout::planes;
};

oracle::Picture drawn_together(const PassScene& scene, const Ways& ways = {}) {
  Canvas canvas(scene.width, scene.height, false, ways.layout);
  scene.begin(canvas, ways.with_outputs);
  std::vector<FragmentProbe> probes{{.x = scene.width / 2, .y = scene.height / 2}};
  if (ways.with_probe) canvas.target.probes = &probes;
  const Passes passes(scene);
  PreparedDraw prepared;
  const VertexArrays& arrays = passes.passes[0].arrays;
  EXPECT_TRUE(prepare(scene.passes[0].state, scene.matrix, arrays, canvas.target, prepared).ok());
  const DrawActions actions{.clear = scene.clear, .discard_depth = ways.discard_depth};
  const Status status = rasterize(passes.passes, prepared, actions, canvas.target);
  EXPECT_TRUE(status.ok()) << status.error().message;
  EXPECT_TRUE(canvas.padding_is_whole());
  return canvas.picture();
}

// How many of the scene's passes vectors can draw, and whether they share tiles.
struct Kind {
  int by_lanes = 0;
  bool shares = false;
};
Kind kind_of(const PassScene& scene) {
  Canvas canvas(scene.width, scene.height);
  scene.begin(canvas, false);
  const Passes passes(scene);
  std::vector<std::unique_ptr<DrawContext>> contexts;
  std::vector<const DrawContext*> pointers;
  Kind kind;
  for (const DrawPass& pass : passes.passes) {
    contexts.push_back(std::make_unique<DrawContext>(*pass.state, pass.arrays, pass.units, canvas.target));
    pointers.push_back(contexts.back().get());
    kind.by_lanes += lanes_can_draw(*pointers.back(), canvas.target) ? 1 : 0;
  }
  kind.shares = TileRasterizer::can_share_tiles(pointers, canvas.target);
  return kind;
}

CaseRange cases_of(std::uint64_t count) {
  return {"NINEBIT_RASTER_INDEX", count};
}

// The kinds of many scenes.
struct Counts {
  std::uint64_t shared = 0, cleared = 0, changed = 0, runs = 0;
};

template <class MakeScene>
void draw_on_every_target(const CaseRange& range, std::uint64_t seed, const MakeScene& make, Counts& counts) {
  for (std::uint64_t index = range.first; index < range.end; ++index) {
    Random random(seed, index);
    const PassScene scene = make(random);
    const oracle::Picture expected = drawn_alone(scene, true);
    const Kind kind = kind_of(scene);
    counts.shared += kind.shares ? 1U : 0U;
    counts.cleared += kind.shares && scene.clear ? 1U : 0U;
    counts.changed += same_planes(expected, scene.start) ? 0U : 1U;
    for (const std::int64_t target : simd_targets()) {
      const OnTarget only(target);
      const int threads = random.pick({1, 2, 7});
      const Ways ways{.discard_depth = random.one_in(3), .layout = random.pick(kSampleLayouts)};
      oracle::Picture actual;
      with_threads(threads, [&] { actual = drawn_together(scene, ways); });
      ASSERT_TRUE(same_planes(actual, expected, !ways.discard_depth) && !testing::Test::HasFailure())
          << "case " << index << ", " << simd_target_name(target) << ", " << threads << " threads, layout "
          << static_cast<int>(ways.layout) << ", depth " << (actual.depth == expected.depth) << " stencil "
          << (actual.stencil == expected.stencil) << " colour " << (actual.color == expected.color) << '\n'
          << describe(scene);
      counts.runs += kind.by_lanes > 0 && only.ran() ? 1U : 0U;
    }
  }
}

TEST(SharedTiles, PassesDrawWhatTheyDrawAloneOnEveryTarget) {
  if (kSanitized) GTEST_SKIP() << "a build with sanitizers has one SIMD target";
  const CaseRange range = cases_of(kSlowBuild ? 30 : 300);
  Counts counts;
  draw_on_every_target(
      range, 0x54A9ED, [](Random& random) { return random_passes(random, random.between(2, 4)); }, counts);
  if (!range.is_whole) return;
  EXPECT_GT(counts.shared, range.end / 4);
  EXPECT_GT(counts.cleared, range.end / 10);
  EXPECT_GT(counts.changed, range.end / 2);
  EXPECT_GT(counts.runs, range.end / 4 * simd_targets().size());
}

// Passes that draw the fragments of another again.
TEST(SharedTiles, PassesOfEqualDepthDrawWhatTheyDrawAloneOnEveryTarget) {
  if (kSanitized) GTEST_SKIP() << "a build with sanitizers has one SIMD target";
  const CaseRange range = cases_of(kSlowBuild ? 30 : 300);
  Counts counts;
  draw_on_every_target(
      range, 0x54A9EF, [](Random& random) { return random_equal_passes(random, random.between(3, 4)); }, counts);
  if (!range.is_whole) return;
  EXPECT_GT(counts.shared, range.end / 2);
  EXPECT_GT(counts.cleared, range.end / 5);
  EXPECT_GT(counts.changed, range.end / 2);
}

TEST(SharedTiles, OutputsOrAProbeChangeNothing) {
  const CaseRange range = cases_of(kSlowBuild ? 20 : 150);
  for (std::uint64_t index = range.first; index < range.end; ++index) {
    Random random(0x54A9EE, index);
    const PassScene scene = random_passes(random, random.between(1, 3));
    const oracle::Picture plain = drawn_together(scene);
    const oracle::Picture watched = drawn_together(scene, {.with_probe = true});
    const oracle::Picture with_outputs = drawn_together(
        scene, {.with_outputs = true, .with_probe = random.one_in(2), .layout = random.pick(kSampleLayouts)});
    ASSERT_TRUE(same_planes(watched, plain)) << "case " << index << '\n' << describe(scene);
    ASSERT_TRUE(same_planes(with_outputs, plain)) << "case " << index << '\n' << describe(scene);
  }
}

// One pass, by vectors and a fragment at a time.
TEST(Lanes, DrawWhatSingleFragmentsDraw) {
  const CaseRange range = cases_of(kSlowBuild ? 200 : 1200);
  const std::vector<std::int64_t>& targets = simd_targets();
  std::uint64_t by_lanes = 0, changed = 0;
  for (std::uint64_t index = range.first; index < range.end; ++index) {
    Random random(0x1A4E5, index);
    const PassScene scene = random_passes(random, 1);
    if (kind_of(scene).by_lanes == 0) continue;
    ++by_lanes;
    const oracle::Picture expected = drawn_alone(scene, true);
    changed += same_planes(expected, scene.start) ? 0U : 1U;
    const std::int64_t target = targets[static_cast<std::size_t>(random.below(static_cast<int>(targets.size())))];
    const OnTarget only(target);
    const oracle::Picture actual = drawn_alone(scene, false, random.pick(kSampleLayouts));
    ASSERT_TRUE(same_planes(actual, expected) && !testing::Test::HasFailure())
        << "case " << index << ", " << simd_target_name(target) << ", depth " << (actual.depth == expected.depth)
        << " stencil " << (actual.stencil == expected.stencil) << " colour " << (actual.color == expected.color) << '\n'
        << describe(scene);
  }
  if (!range.is_whole) return;
  EXPECT_GT(by_lanes, range.end / 2);
  EXPECT_GT(changed, by_lanes / 2);
}

// What both ways take from the draw: before the first general combiner, spare0's alpha is that of texture unit 0,
// though the program does not read texture0.
TEST(Lanes, Spare0StartsWithTheAlphaOfTexture0) {
  const std::vector<glm::vec3> positions{{-3, -1, 0}, {3, -1, 0}, {0, 5, 0}}, coordinates(3, glm::vec3(0.0F));
  const Texture texture =
      make_texture(TextureTarget::texture_2d, InternalFormat::rgba8, {{{1, 1, std::vector<std::uint8_t>{1, 2, 3, 77}}}})
          .value();
  const std::array<TextureUnit, 1> units{TextureUnit{&texture, kNearestSampler}};
  PipelineState state;
  state.program = pass_through(Register::primary, Register::spare0);
  VertexArrays arrays{.positions = positions};
  arrays.texture_coordinates[0] = coordinates;
  for (const bool with_primitive : {false, true}) {
    Surface surface = Surface::make(20, 20, {.with_primitive = with_primitive}).value();
    RenderTarget target = surface.target();
    ASSERT_TRUE(rasterize(state, kIdentity, arrays, units, target).ok());
    EXPECT_EQ(std::count(surface.color(kAlpha).begin(), surface.color(kAlpha).end(), 77), 400);
  }
}

// Whatever is wrong with any pass is said before the first one draws, or anything is cleared.
TEST(SharedTiles, ReportsWhatIsWrongWithAnyPassBeforeItDraws) {
  const std::vector<glm::vec3> positions{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const std::vector<ColorBytes> colors(3, ColorBytes{9, 9, 9, 9}), too_few(2, ColorBytes{9, 9, 9, 9});
  PipelineState good, wrong_state, other_view, with_texture;
  wrong_state.point_size = -1;
  other_view.cull_face = CullFace::front;
  Random random(5);
  const Texture texture =
      make_texture(TextureTarget::texture_2d, InternalFormat::alpha8, {{{1, 1, std::vector<std::uint8_t>{1}}}}).value();
  const std::array<TextureUnit, 1> units{TextureUnit{&texture, kNearestSampler}};
  const VertexArrays arrays{.positions = positions, .vertex_colors = colors};
  VertexArrays short_arrays = arrays;
  short_arrays.vertex_colors = too_few;
  const std::vector<DrawPass> wrong{{.state = &wrong_state, .arrays = arrays},
                                    {.state = &other_view, .arrays = arrays},
                                    {.state = &good, .arrays = short_arrays},
                                    {.state = &with_texture, .arrays = arrays, .units = units}};
  for (const DrawPass& bad : wrong) {
    for (std::size_t at = 0; at < 3; ++at) {
      for (const bool clears : {false, true}) {
        Surface surface = Surface::make(70, 70).value();
        surface.fill({.color = {1, 2, 3, 4}, .depth = 0.5, .stencil = 7});
        RenderTarget target = surface.target();
        PreparedDraw prepared;
        ASSERT_TRUE(prepare(good, kIdentity, arrays, target, prepared).ok());
        std::vector<DrawPass> passes(3, DrawPass{.state = &good, .arrays = arrays});
        passes[at] = bad;
        DrawActions actions;
        if (clears) actions.clear = ClearValues{};
        EXPECT_FALSE(rasterize(passes, prepared, actions, target).ok());
        for (int k = 0; k < 4; ++k) {
          const PlaneSamples<std::uint8_t>& plane = surface.color(k);
          EXPECT_EQ(std::count(plane.begin(), plane.end(), k + 1), 70 * 70);
        }
        EXPECT_EQ(std::count(surface.stencil().begin(), surface.stencil().end(), 7), 70 * 70);
      }
    }
  }
}

// No passes, or passes without a primitive, draw nothing; what is to be cleared is cleared all the same.
TEST(SharedTiles, NothingToDrawIsStillCleared) {
  const std::vector<glm::vec3> outside{{9, 9, 0}, {10, 9, 0}, {9, 10, 0}};
  const PipelineState state;
  for (const bool has_pass : {false, true}) {
    for (const bool has_positions : {false, true}) {
      for (const bool clears : {false, true}) {
        Surface surface = Surface::make(70, 65).value();
        surface.fill({.color = {1, 2, 3, 4}, .depth = 0.5, .stencil = 7});
        RenderTarget target = surface.target();
        const PlaneSamples<std::uint32_t> depth = surface.depth();
        VertexArrays arrays;
        if (has_positions) arrays.positions = outside;
        PreparedDraw prepared;
        ASSERT_TRUE(prepare(state, kIdentity, arrays, target, prepared).ok());
        std::vector<DrawPass> passes(has_pass ? 2 : 0, DrawPass{.state = &state, .arrays = arrays});
        std::chrono::nanoseconds time{-1};
        if (has_pass) passes[1].time = &time;
        DrawActions actions;
        if (clears) actions.clear = ClearValues{.color = {5, 6, 7, 8}, .depth = 0.0, .stencil = 9};
        ASSERT_TRUE(rasterize(passes, prepared, actions, target).ok());
        for (int k = 0; k < 4; ++k) {
          const PlaneSamples<std::uint8_t>& plane = surface.color(k);
          EXPECT_EQ(std::count(plane.begin(), plane.end(), k + (clears ? 5 : 1)), 70 * 65);
        }
        EXPECT_EQ(std::count(surface.stencil().begin(), surface.stencil().end(), clears ? 9 : 7), 70 * 65);
        EXPECT_TRUE(surface.depth() == (clears ? PlaneSamples<std::uint32_t>(70 * 65, 0U) : depth));
        if (has_pass) {
          EXPECT_GE(time.count(), 0);
        }
      }
    }
  }
}

// Cleared targets of more than 4 MB are stored past the caches if their rows begin on lines: they hold the same as with
// padded rows.
TEST(SharedTiles, LargeTargetsHoldWhatPaddedOnesHold) {
  constexpr int kWidth = 1088, kHeight = 1000;
  Mesh mesh;
  mesh.positions = {{-1, -1, -1}, {1, -1, 0.5F}, {-1, 1, 0}, {0.9F, 1, 1}};
  mesh.vertex_colors = {{255, 0, 0, 9}, {0, 255, 0, 99}, {0, 0, 255, 200}, {90, 80, 70, 60}};
  mesh.add_triangle(0, 1, 2);
  mesh.add_triangle(3, 2, 1);
  for (const bool tests_depth : {false, true}) {
    PipelineState state;
    state.depth_test.enabled = tests_depth;
    const VertexArrays arrays = mesh.arrays();
    const DrawPass pass{.state = &state, .arrays = arrays};
    for (const std::int64_t on : simd_targets()) {
      const OnTarget only(on);
      Surface surface = Surface::make(kWidth, kHeight).value();
      Canvas padded(kWidth, kHeight);
      padded.target.outputs.clear();
      RenderTarget whole = surface.target();
      for (RenderTarget* const target : {&whole, &padded.target}) {
        PreparedDraw prepared;
        ASSERT_TRUE(prepare(state, kIdentity, arrays, *target, prepared).ok());
        const DrawActions actions{.clear = ClearValues{.color = {5, 6, 7, 8}, .depth = 0.75, .stencil = 9}};
        ASSERT_TRUE(rasterize({&pass, 1}, prepared, actions, *target).ok());
      }
      EXPECT_TRUE(padded.padding_is_whole());
      int differences = 0;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          bool is_same = whole.depth.at(x, y) == padded.target.depth.at(x, y) &&
                         whole.stencil.at(x, y) == padded.target.stencil.at(x, y);
          for (std::size_t k = 0; k < 4; ++k) {
            is_same = is_same && whole.color[k].at(x, y) == padded.target.color[k].at(x, y);
          }
          differences += is_same ? 0 : 1;
        }
      }
      EXPECT_EQ(differences, 0) << simd_target_name(on);
      const TileContents all{
          .writes_depth = true, .writes_stencil = true, .color = {true, true, true, true}, .clears = true};
      EXPECT_EQ(TilePlanes(whole, all).form, RowForm::streamed);
      EXPECT_EQ(TilePlanes(padded.target, all).form, RowForm::side_by_side);
    }
  }
}

}  // namespace
}  // namespace ninebit::test
