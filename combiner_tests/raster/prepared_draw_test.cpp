// A prepared draw draws what the draw itself would, and refuses what it was not prepared for.
#include "ninebit/raster/prepared_draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/random_scene.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

// Prepared with each draw's own state, drawn with it and with other fragment operations; one PreparedDraw for all.
TEST(PreparedDraw, RandomScenesAreDrawnAsWithoutIt) {
  PreparedDraw prepared;
  std::uint64_t changed = 0;
  constexpr std::uint64_t kScenes = kSlowBuild ? 150 : 3000;
  for (std::uint64_t index = 0; index < kScenes; ++index) {
    Random random(0x93E9A3, index);
    const RandomScene scene = random_scene(random);
    PicturePlanes with(scene.start, scene.captures), without(scene.start, scene.captures);
    for (const RandomDraw& draw : scene.draws) {
      const LibraryDraw library = for_library(draw, scene.width, scene.height);
      ASSERT_TRUE(prepare(draw.state, kIdentity, library.arrays, with.target, prepared).ok()) << index;
      PipelineState state = draw.state;
      for (int pass = 0; pass < 2; ++pass) {
        std::vector<FragmentProbe> watched(2);
        for (FragmentProbe& probe : watched) probe = {.x = random.below(scene.width), .y = random.below(scene.height)};
        std::vector<FragmentProbe> other = watched;
        const bool probes = random.one_in(4);
        with.target.probes = probes ? &watched : nullptr;
        without.target.probes = probes ? &other : nullptr;
        const Status status = rasterize(state, prepared, library.arrays, {}, with.target);
        ASSERT_TRUE(status.ok()) << status.error().message;
        ASSERT_TRUE(rasterize(state, kIdentity, library.arrays, {}, without.target).ok());
        ASSERT_TRUE(same_samples(with.picture(), without.picture())) << index << '\n' << describe(scene);
        for (std::size_t i = 0; i < 2; ++i) ASSERT_EQ(watched[i].fragments, other[i].fragments) << index;
        randomize_operations(random, scene, state);
      }
    }
    changed += same_samples(with.picture(), scene.start) ? 0U : 1U;
  }
  EXPECT_GT(changed, kScenes / 2);
}

struct PreparedCase {
  PipelineState state;
  VertexArrays arrays;
  Surface surface = Surface::make(40, 30).value();
  RenderTarget target = surface.target();
};

const std::vector<glm::vec3> kPositions{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0, 0}, {0, 0.5, 0}};
const PlaneSamples<std::uint32_t> kIndices{0, 1, 2, 3, 4, 5}, kOtherIndices = kIndices;

TEST(PreparedDraw, ReportsWhatItWasNotPreparedFor) {
  const auto usual = [] {
    PreparedCase c;
    c.arrays.positions = kPositions;
    c.arrays.indices = kIndices;
    return c;
  };
  struct Change {
    const char* word;  // in the message
    std::function<void(PreparedCase&)> change;
  };
  const std::vector<Change> changes{
      {"size",
       [](PreparedCase& c) {
         c.surface = Surface::make(40, 31).value();
         c.target = c.surface.target();
       }},
      {"format",
       [](PreparedCase& c) {
         c.surface = Surface::make(40, 30, {.depth_stencil = DepthStencilFormat::d16}).value();
         c.target = c.surface.target();
       }},
      {"viewport",
       [](PreparedCase& c) {
         c.state.viewport = PixelRect{0, 0, 39, 30};
       }},
      {"scissor",
       [](PreparedCase& c) {
         c.state.scissor = PixelRect{1, 0, 40, 30};
       }},
      {"depth range", [](PreparedCase& c) { c.state.depth_near = 0.5F; }},
      {"depth range", [](PreparedCase& c) { c.state.depth_far = 0.5F; }},
      {"culling", [](PreparedCase& c) { c.state.cull_face = CullFace::back; }},
      {"front face", [](PreparedCase& c) { c.state.front_face = FrontFace::clockwise; }},
      {"polygon mode", [](PreparedCase& c) { c.state.front_mode = PolygonMode::line; }},
      {"polygon mode", [](PreparedCase& c) { c.state.back_mode = PolygonMode::point; }},
      {"polygon offset", [](PreparedCase& c) { c.state.polygon_offset.fill = true; }},
      {"polygon offset", [](PreparedCase& c) { c.state.polygon_offset.line = true; }},
      {"polygon offset", [](PreparedCase& c) { c.state.polygon_offset.point = true; }},
      {"polygon offset", [](PreparedCase& c) { c.state.polygon_offset.factor = 1; }},
      {"polygon offset", [](PreparedCase& c) { c.state.polygon_offset.units = 1; }},
      {"slope", [](PreparedCase& c) { c.state.profile.polygon_offset_slope.value = OffsetSlope::root; }},
      {"offset's fraction",
       [](PreparedCase& c) { c.state.profile.polygon_offset_fraction.value = OffsetFraction::rounded; }},
      {"point size", [](PreparedCase& c) { c.state.point_size = 2; }},
      {"line width", [](PreparedCase& c) { c.state.line_width = 2; }},
      {"shape of points", [](PreparedCase& c) { c.state.profile.point_shape.value = PointShape::whole_pixels; }},
      {"shape of lines", [](PreparedCase& c) { c.state.profile.line_shape.value = LineShape::diamonds; }},
      {"subpixel bits", [](PreparedCase& c) { c.state.profile.subpixel_bits.value = 3; }},
      {"type", [](PreparedCase& c) { c.arrays.type = PrimitiveType::triangle_strip; }},
      {"positions", [](PreparedCase& c) { c.arrays.positions = c.arrays.positions.first(5); }},
      {"indices", [](PreparedCase& c) { c.arrays.indices = c.arrays.indices.first(3); }},
      {"indices", [](PreparedCase& c) { c.arrays.indices = {}; }},
      {"indices", [](PreparedCase& c) { c.arrays.indices = kOtherIndices; }},
  };
  const PreparedCase prepared_with = usual();
  PreparedDraw prepared;
  ASSERT_TRUE(prepare(prepared_with.state, kIdentity, prepared_with.arrays, prepared_with.target, prepared).ok());
  for (const Change& change : changes) {
    PreparedCase c = usual();
    change.change(c);
    const Status status = rasterize(c.state, prepared, c.arrays, {}, c.target);
    ASSERT_FALSE(status.ok()) << change.word;
    EXPECT_NE(status.error().message.find(change.word), std::string::npos) << status.error().message;
  }
  // All else may be another.
  PreparedCase c = usual();
  c.state.depth_test.enabled = true;
  c.state.shade_model = ShadeModel::flat;
  c.state.viewport = PixelRect{0, 0, 40, 30};
  c.state.scissor = PixelRect{-5, -5, 100, 100};
  c.state.program = pass_through(Register::primary, Register::primary);
  const std::vector<ColorBytes> colors(2, ColorBytes{9, 9, 9, 9});
  c.arrays.primitive_colors = colors;
  EXPECT_TRUE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
  EXPECT_EQ(c.surface.color(kRed)[15 * 40 + 20], 9);
  // Faults that rasterize() reports are reported here, too.
  c.arrays.primitive_colors = std::span(colors).first(1);
  EXPECT_FALSE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
}

TEST(PreparedDraw, OfNoDrawDrawsNothing) {
  PreparedCase c;
  c.arrays.positions = kPositions;
  PreparedDraw prepared;
  EXPECT_FALSE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
  ASSERT_TRUE(prepare(c.state, kIdentity, c.arrays, c.target, prepared).ok());
  EXPECT_TRUE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
  PreparedDraw other = std::move(prepared);
  EXPECT_TRUE(rasterize(c.state, other, c.arrays, {}, c.target).ok());
  EXPECT_FALSE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());  // NOLINT(bugprone-use-after-move)
  ASSERT_TRUE(prepare(c.state, kIdentity, c.arrays, c.target, prepared).ok());
  EXPECT_TRUE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
  prepared = PreparedDraw();
  EXPECT_FALSE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
  prepared = std::move(other);
  EXPECT_TRUE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
  // After an error nothing of the last draw is left.
  c.state.point_size = -1;
  EXPECT_FALSE(prepare(c.state, kIdentity, c.arrays, c.target, prepared).ok());
  c.state.point_size = 1;
  EXPECT_FALSE(rasterize(c.state, prepared, c.arrays, {}, c.target).ok());
}

TEST(PreparedDraw, ReportsWhatTheDrawWouldReport) {
  const std::vector<glm::vec3> many(40, glm::vec3(0.0F));
  const auto report = [&](const VertexArrays& arrays, const PipelineState& state, int width) {
    PreparedDraw prepared;
    const RenderTarget target{.width = width, .height = 8};
    return prepare(state, kIdentity, arrays, target, prepared).ok();
  };
  EXPECT_TRUE(report({.positions = many}, {}, 8));
  EXPECT_FALSE(report({.positions = many}, {}, 0));
  PipelineState wide, negative, closed, outlined;
  wide.line_width = 65;
  negative.scissor = PixelRect{0, 0, -1, 1};
  closed.scissor = PixelRect{};
  outlined.front_mode = PolygonMode::line;
  EXPECT_FALSE(report({.positions = many}, wide, 8));
  EXPECT_FALSE(report({.positions = many}, negative, 8));
  // Indices out of range anywhere, also those that make no primitive, or where nothing can be drawn.
  for (int type = 0; type < 10; ++type) {
    for (const std::uint32_t bad : {40U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU}) {
      for (std::size_t at = 0; at < 38; ++at) {
        PlaneSamples<std::uint32_t> indices(38, 39U);
        const VertexArrays arrays{.type = static_cast<PrimitiveType>(type), .positions = many, .indices = indices};
        ASSERT_TRUE(report(arrays, {}, 8)) << type;
        indices[at] = bad;
        ASSERT_FALSE(report(arrays, {}, 8)) << type << ' ' << at;
        ASSERT_FALSE(report(arrays, closed, 8)) << type << ' ' << at;
        ASSERT_FALSE(report(arrays, outlined, 8)) << type << ' ' << at;
        VertexArrays none = arrays;
        none.positions = {};
        ASSERT_FALSE(report(none, {}, 8)) << type;
      }
    }
  }
}

// Primitives larger than a tile are left out of the tiles that they do not meet, and of no others.
TEST(PreparedDraw, LargeTrianglesReachEveryTileThatTheyCover) {
  constexpr int kWidth = 400, kHeight = 300;
  std::int64_t covered = 0;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 10U : 60U); ++index) {
    Random random(0x1A46E, index);
    oracle::WindowTriangle t;
    Mesh mesh;
    for (auto& v : t) {
      v = {random.between(-2000, 16 * kWidth + 2000), random.between(-2000, 16 * kHeight + 2000),
           random.below(1 << 24)};
      if (random.one_in(3)) v.x_q4 = t[0].x_q4 + random.between(-9, 9);
      mesh.add(clip_position(v, kWidth, kHeight));
    }
    mesh.add_triangle(0, 1, 2);
    const PlaneSamples<std::uint8_t> counts = coverage(mesh, kIdentity, kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool covers = oracle::covers(t, x, y);
        ASSERT_EQ(counts[static_cast<std::size_t>(y * kWidth + x)], covers ? 1 : 0) << index << ' ' << x << ' ' << y;
        covered += covers ? 1 : 0;
      }
    }
  }
  EXPECT_GT(covered, 100000);
}

// Against each triangle drawn alone, without any test, into a plane of its own.
TEST(PreparedDraw, CoveringPolygonsAreThoseThatDrawAPixelAlone) {
  constexpr int kSize = 48, kTriangles = 400;
  Random random(0xC0FE, 1);
  std::vector<glm::vec3> positions;
  for (int t = 0; t < kTriangles; ++t) {
    // From far smaller than a pixel to larger than the target; some around its sides and behind the near plane.
    const glm::vec3 at(random.real_f(-1.2, 1.2), random.real_f(-1.2, 1.2), random.real_f(-1.2, 1.2));
    const float size = t % 4 == 0 ? 0.7F : 0.05F;
    for (int i = 0; i < 3; ++i) {
      positions.push_back(at + size * glm::vec3(random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1)));
    }
  }
  for (const CullFace cull : {CullFace::none, CullFace::back}) {
    PipelineState state;
    state.cull_face = cull;
    const RenderTarget size{.width = kSize, .height = kSize};
    PreparedDraw prepared;
    ASSERT_TRUE(prepare(state, kIdentity, {.positions = positions}, size, prepared).ok());
    std::vector<bool> covering(kTriangles);
    mark_covering_polygons(prepared, covering);
    int count = 0;
    for (std::size_t t = 0; t < kTriangles; ++t) {
      PlaneSamples<std::uint32_t> drawn(kSize * kSize, 1);
      RenderTarget target = size;
      target.outputs.push_back({.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{drawn.data(), kSize}});
      const std::span<const glm::vec3> one(&positions[3 * t], 3);
      ASSERT_TRUE(rasterize(state, kIdentity, {.positions = one}, {}, target).ok());
      const bool expected = std::count(drawn.begin(), drawn.end(), 0U) > 0;
      ASSERT_EQ(covering[t], expected) << t;
      count += expected ? 1 : 0;
    }
    EXPECT_GT(count, 50);
    EXPECT_LT(count, kTriangles - 50);
  }
  std::vector<bool> none(3, true);
  mark_covering_polygons(PreparedDraw(), none);
  EXPECT_EQ(none, std::vector<bool>(3, true)) << "of no draw";
}

}  // namespace
}  // namespace ninebit::test
