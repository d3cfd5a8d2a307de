// Surfaces with several samples for each pixel (rule 48): coverage and depth at the samples' places, judged by the
// oracle; levels of detail of point sprites (rule 46), and stipple (rule 45), by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/raster/texture_support.h"
#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/prepared_draw.h"
#include "src/raster/lanes/tile_planes.h"
#include "src/raster/surface/sample_planes.h"

namespace ninebit::test {
namespace {

struct SampleAt {
  int column, row;  // in the pixel's samples, the lowest row first
  int x_q4, y_q4;   // from the pixel's lower left corner
};

// Of a picture whose y grows downwards: (x, y) and (x + 1/2, y + 1/2); (x + i/2, y + j/2) in row j.
std::vector<SampleAt> samples_of(SampleMode mode) {
  if (mode == SampleMode::center_1) return {{0, 0, 8, 8}};
  if (mode == SampleMode::center_corner_2) return {{0, 0, 0, 16}, {1, 0, 8, 8}};
  std::vector<SampleAt> samples;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) samples.push_back({i, 1 - j, 8 * i, 16 - 8 * j});
  }
  return samples;
}

constexpr SampleMode kModes[] = {SampleMode::center_1, SampleMode::center_corner_2, SampleMode::square_offset_4};

TEST(Samples, AreCoveredAndHaveDepthsAtTheirPlaces) {
  std::uint64_t drawn = 0, partly = 0;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 100 : 1500); ++index) {
    Random random(0x5A4B1E5, index);
    const SampleMode mode = kModes[random.below(3)];
    const int width = random.between(1, 40), height = random.between(1, 30);
    Surface surface = Surface::make(width, height, {.samples = mode}).value();
    RenderTarget target = surface.target();
    ASSERT_EQ(target.samples, mode);
    oracle::WindowTriangle t;
    std::array<glm::vec3, 3> clip;
    for (std::size_t i = 0; i < 3; ++i) {
      t[i] = {8 * random.between(-16, 2 * width + 16), random.between(-80, 16 * height + 80),
              random.between(0, static_cast<int>(max_depth(DepthStencilFormat::d24s8)))};
      clip[i] = clip_position(t[i], width, height);
    }
    PipelineState state;
    state.profile = profiles::nv2a;
    state.depth_test = {true, CompareFunction::always, true};
    const bool with_program = random.one_in(2);
    if (with_program) state.program = pass_through(Register::primary, Register::primary, state.profile);
    ASSERT_TRUE(rasterize(state, kIdentity, {.positions = clip}, {}, target).ok());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        std::size_t covered = 0;
        for (const SampleAt& s : samples_of(mode)) {
          const int column = sample_columns(mode) * x + s.column, row = sample_rows(mode) * y + s.row;
          const oracle::Place place{std::int64_t{16} * x + s.x_q4, std::int64_t{16} * y + s.y_q4};
          const bool inside = oracle::covers_place(t, place.x_q4, place.y_q4);
          ASSERT_EQ(target.color[0].at(column, row), inside ? 255 : 0) << index << ' ' << x << ' ' << y;
          ASSERT_EQ(target.depth.at(column, row),
                    inside ? oracle::depth_at_place(t, place, true) : max_depth(target.format))
              << index << ' ' << x << ' ' << y;
          covered += inside ? 1U : 0U;
        }
        drawn += covered;
        partly += covered > 0 && covered < samples_of(mode).size() ? 1U : 0U;
      }
    }
  }
  EXPECT_GE(drawn, kSlowBuild ? 5'000U : 100'000U);
  EXPECT_GE(partly, kSlowBuild ? 200U : 5'000U);
}

// Vectors read and write every second sample of rows as wide as a tile. A surface with a further plane is drawn by
// single fragments.
TEST(Samples, OfWideRowsAreDrawnAsSingleOnesOnEveryTarget) {
  std::uint64_t runs = 0, changed = 0;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 6 : 60); ++index) {
    Random random(0x3EC04D, index);
    const int width = random.pick({64, 128, 150, 192}), height = random.between(1, 70);
    const SampleMode mode = kModes[random.between(1, 2)];
    const DepthStencilFormat format = random.pick({DepthStencilFormat::d24s8, DepthStencilFormat::d16});
    Surface single =
        Surface::make(width, height, {.depth_stencil = format, .with_primitive = true, .samples = mode}).value();
    RenderTarget expected = single.target();
    const int columns = width * sample_columns(mode), rows = height * sample_rows(mode);
    const oracle::Picture start = random_picture(random, columns, rows, format);
    const auto fill = [&](RenderTarget& target) {
      for (std::size_t i = 0; i < start.color.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) target.color[k].data[i] = static_cast<std::uint8_t>(start.color[i][k]);
      }
      std::copy(start.depth.begin(), start.depth.end(), target.depth.data);
      if (target.stencil) std::copy(start.stencil.begin(), start.stencil.end(), target.stencil.data);
    };
    PipelineState state;
    randomize_fragment_operations(random, state);
    state.profile = profiles::nv2a;
    if (random.one_in(2)) {
      state.depth_test = {true, CompareFunction::always, true};
      state.alpha_test.enabled = state.stencil_test.enabled = false;
    }
    if (random.one_in(2)) state.program = pass_through(Register::primary, Register::primary, state.profile);
    std::vector<glm::vec3> positions;
    std::vector<ColorBytes> colors;
    for (int i = 0; i < 12; ++i) {
      positions.emplace_back(random.real_f(-2, 2), random.real_f(-2, 2), random.real_f(-1, 1));
      colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    }
    const VertexArrays arrays{.positions = positions, .vertex_colors = colors};
    const auto draw = [&](RenderTarget& target) { ASSERT_TRUE(rasterize(state, kIdentity, arrays, {}, target).ok()); };
    fill(expected);
    draw(expected);
    changed += std::equal(start.depth.begin(), start.depth.end(), single.depth().begin()) ? 0U : 1U;
    for (const std::int64_t on : simd_targets()) {
      const OnTarget only(on);
      Surface surface = Surface::make(width, height, {.depth_stencil = format, .samples = mode}).value();
      RenderTarget target = surface.target();
      fill(target);
      with_threads(random.pick({1, 3}), [&] { draw(target); });
      bool is_same = surface.depth() == single.depth() && surface.stencil() == single.stencil();
      for (int k = 0; k < 4; ++k) is_same = is_same && surface.color(k) == single.color(k);
      ASSERT_TRUE(is_same) << index << ", " << simd_target_name(on) << ", " << describe_operations(state);
      runs += only.ran() ? 1U : 0U;
    }
  }
  EXPECT_GT(changed, kSlowBuild ? 2U : 20U);
  EXPECT_GT(runs, 0U);
  for (const SampleMode mode : {SampleMode::center_corner_2, SampleMode::square_offset_4}) {
    Surface surface = Surface::make(64, 64, {.samples = mode}).value();
    const RenderTarget planes = planes_of_sample(surface.target(), sample_places(mode)[0]);
    TileContents all{.depth = true,
                     .stencil = true,
                     .writes_depth = true,
                     .writes_stencil = true,
                     .color = {true, true, true, true},
                     .is_sample = true};
    EXPECT_EQ(TilePlanes(planes, all).form, RowForm::every_second);
    all.is_sample = false;  // then what lies between may be another thread's
    EXPECT_EQ(TilePlanes(planes, all).form, RowForm::scattered);
  }
}

TEST(Samples, AreClearedWithinTheScissorAndOfOtherPlanesToo) {
  for (const SampleMode mode : kModes) {
    Surface surface = Surface::make(3, 2, {.with_primitive = true, .samples = mode}).value();
    RenderTarget target = surface.target();
    PipelineState state;
    state.profile = profiles::nv2a;
    state.scissor = PixelRect{1, 0, 1, 2};
    ASSERT_TRUE(clear(state, {}, {.color = {7, 7, 7, 7}, .depth = 0.0, .stencil = 3}, target).ok());
    ASSERT_TRUE(rasterize(state, kIdentity, {.positions = kWholeTarget}, {}, target).ok());
    const int columns = sample_columns(mode), rows = sample_rows(mode);
    for (int y = 0; y < 2 * rows; ++y) {
      for (int x = 0; x < 3 * columns; ++x) {
        const bool is_in = x / columns == 1;
        EXPECT_EQ(target.stencil.at(x, y), is_in ? 3 : 0);
        EXPECT_EQ(std::get<Plane<std::uint32_t>>(target.outputs[0].plane).at(x, y), is_in ? 0 : 0xFFFFFFFF);
      }
    }
  }
}

TEST(Samples, ChipsWithoutThemAndProbesAreRefused) {
  Surface surface = Surface::make(2, 2, {.samples = SampleMode::square_offset_4}).value();
  RenderTarget target = surface.target();
  PipelineState state;
  const std::array<glm::vec3, 3> corners{};
  const auto message = [&] { return rasterize(state, kIdentity, {.positions = corners}, {}, target).error().message; };
  EXPECT_EQ(message(), "profile geforce2 has no surfaces with several samples for each pixel; expected one sample");
  EXPECT_FALSE(clear(state, {}, {}, target).ok());
  state.profile = profiles::nv2a;
  PreparedDraw prepared;
  EXPECT_EQ(prepare(state, kIdentity, {.positions = corners}, target, prepared).error().message,
            "a prepared draw takes one sample for each pixel, not several; draw without preparation");
  std::vector<FragmentProbe> probes(1);
  target.probes = &probes;
  EXPECT_EQ(message(), "a probe watches targets with one sample for each pixel, not several");
  EXPECT_FALSE(Surface::make(kMaxSurfaceSize, 1, {.samples = SampleMode::center_corner_2}).ok());
  EXPECT_TRUE(Surface::make(1, 1, {.samples = SampleMode::center_corner_2}).ok());
}

// A sprite as large as the texture reads its level 0, one of half the size the next.
TEST(PointSprites, HaveALevelOfDetail) {
  const Texture texture = texture_of_levels(32, {10, 20, 30, 40, 50, 60});
  Sampler sampler = kNearestSampler;
  sampler.min_filter = MinFilter::nearest_mipmap_nearest;
  const TextureUnit unit{&texture, sampler};
  for (const auto& [size, value] : {std::pair{32, 10}, {16, 20}, {8, 30}, {64, 10}}) {
    const std::array<glm::vec3, 1> clip{}, given{};
    VertexArrays arrays{.type = PrimitiveType::points, .positions = clip};
    arrays.texture_coordinates[0] = given;
    PipelineState state;
    state.profile = profiles::nv2a;
    state.point_size = static_cast<float>(size);
    state.program = pass_through(Register::texture0, Register::texture0, state.profile);
    state.point_sprite = {.enabled = true, .coord_replace = {true}};
    EXPECT_EQ(drawn_surface(64, 64, state, arrays, {&unit, 1}).color(0)[32 * 64 + 32], value) << size;
  }
}

TEST(PointSprites, ChipsWithoutThemAreNamed) {
  PipelineState state;
  state.point_sprite.enabled = true;
  Surface surface = Surface::make(2, 2).value();
  RenderTarget target = surface.target();
  const std::array<glm::vec3, 1> point{};
  EXPECT_EQ(
      rasterize(state, kIdentity, {.type = PrimitiveType::points, .positions = point}, {}, target).error().message,
      "profile geforce2 has no point sprites; disable them");
}

// Lines, points and the outlines of polygons are not stippled.
TEST(Stipple, IsOfFilledPolygons) {
  PipelineState state;
  state.polygon_stipple.emplace();
  state.point_size = 3.0F;
  const auto count = [&](PrimitiveType type) {
    const Surface surface = drawn_surface(40, 40, state, {.type = type, .positions = kWholeTarget});
    return std::count(surface.color(0).begin(), surface.color(0).end(), 255);
  };
  EXPECT_EQ(count(PrimitiveType::triangles), 0);
  EXPECT_GT(count(PrimitiveType::line_loop), 0);
  EXPECT_GT(count(PrimitiveType::points), 0);
  (*state.polygon_stipple)[4 * 3 + 1] = 0x20;     // row 3, column 10
  EXPECT_EQ(count(PrimitiveType::triangles), 2);  // and row 35
  state.front_mode = PolygonMode::line;
  EXPECT_GT(count(PrimitiveType::triangles), 2);
}

}  // namespace
}  // namespace ninebit::test
