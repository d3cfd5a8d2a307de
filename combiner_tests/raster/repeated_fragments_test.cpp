// Passes over fragments that an earlier pass has kept.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/support.h"
#include "ninebit/raster/prepared_draw.h"

namespace ninebit::test {
namespace {

// More fragments of equal depth than a tile keeps for passes that repeat them: every copy counts, the last one's colour
// stays.
TEST(RepeatedFragments, AnyNumberOfFragmentsOfEqualDepthIsDrawnByEveryPass) {
  const std::vector<glm::vec3> positions{{-3, -1, 0}, {3, -1, 0}, {0, 5, 0}};
  for (const int copies : {1, 3, 4, 5, 100}) {
    std::vector<std::uint32_t> indices;
    std::array<std::vector<ColorBytes>, 2> colors;
    for (int i = 0; i < copies; ++i) {
      indices.insert(indices.end(), {0, 1, 2});
      colors[0].push_back({static_cast<std::uint8_t>(i), 0, 0, 0});
      colors[1].push_back({0, 0, static_cast<std::uint8_t>(i + 1), 0});
    }
    PipelineState nearest;
    nearest.depth_test = {true, CompareFunction::less, true};
    nearest.color_mask = {};
    PipelineState equal;
    equal.depth_test = {true, CompareFunction::equal, false};
    equal.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr}};
    equal.program = pass_through(Register::primary, Register::primary);
    std::vector<DrawPass> passes(3, DrawPass{.state = &equal, .arrays = {.positions = positions, .indices = indices}});
    passes[0].state = &nearest;
    for (std::size_t i = 0; i < 2; ++i) passes[i + 1].arrays.primitive_colors = colors[i];
    for (const std::int64_t simd_target : simd_targets()) {
      const OnTarget only(simd_target);
      Surface surface = Surface::make(64, 64).value();
      RenderTarget target = surface.target();
      PreparedDraw prepared;
      ASSERT_TRUE(prepare(nearest, kIdentity, passes[0].arrays, target, prepared).ok());
      ASSERT_TRUE(rasterize(passes, prepared, {.clear = ClearValues{}}, target).ok());
      EXPECT_EQ(std::count(surface.stencil().begin(), surface.stencil().end(), 2 * copies), 64 * 64);
      EXPECT_EQ(std::count(surface.color(kBlue).begin(), surface.color(kBlue).end(), copies), 64 * 64);
    }
  }
}

// A sheet and a second one through it; specks of a pixel, slivers and larger triangles before and behind; with `twins`
// some of all these a second time.
struct SheetsAndSpecks {
  SheetsAndSpecks(Random& random, int size, bool twins) {
    positions = {{-1, -1, -0.5F}, {1, -1, 0.5F},  {1, 1, 0.5F},  {-1, 1, -0.5F},
                 {-1, -1, 0.5F},  {1, -1, -0.5F}, {1, 1, -0.5F}, {-1, 1, 0.5F}};
    indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    for (int i = 0; i < 2000; ++i) {
      if (twins && i % 3 == 0) {
        const auto first = static_cast<std::size_t>(3 * random.below(static_cast<int>(indices.size() / 3)));
        for (std::size_t k = 0; k < 3; ++k) indices.push_back(indices[first + k]);
        continue;
      }
      const float reach = random.pick({0.4F, 1.0F, 3.0F, 9.0F, 40.0F}) * 2 / static_cast<float>(size);
      const glm::vec2 at{random.real_f(-1, 1), random.real_f(-1, 1)};
      for (int k = 0; k < 3; ++k) {
        const glm::vec2 p = at + reach * glm::vec2{random.real_f(0, 1), random.real_f(0, 1)};
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.emplace_back(p, random.real_f(-0.6F, 0.6F));
      }
    }
    for (std::size_t i = 0; i < indices.size() / 3; ++i) {
      colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    }
  }
  [[nodiscard]] VertexArrays arrays() const {
    return {.positions = positions, .indices = indices, .primitive_colors = colors};
  }
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<ColorBytes> colors;
};

// Depth, then colour where it is equal: pass by pass and together, after another pass of equal depth or not.
TEST(RepeatedFragments, OwnersOfTheNearestDepth) {
  Random random(61);
  constexpr int kSize = 130;
  PipelineState nearest, equal;
  nearest.depth_test = {true, CompareFunction::less, true};
  nearest.color_mask = {};
  equal.depth_test = {true, CompareFunction::equal, false};
  equal.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr}};
  equal.program = pass_through(Register::primary, Register::primary);
  for (int way = 0; way < 4; ++way) {
    const bool begins_equal = way / 2 == 1, twins = way % 2 == 1;
    const SheetsAndSpecks scene(random, kSize, twins);
    std::vector<DrawPass> passes;
    if (begins_equal) passes.push_back({.state = &equal, .arrays = scene.arrays()});
    for (const PipelineState* state : {&nearest, &equal, &equal}) {
      passes.push_back({.state = state, .arrays = scene.arrays()});
    }
    Surface alone = Surface::make(kSize, kSize).value();
    RenderTarget alone_target = alone.target();
    for (const DrawPass& pass : passes) {
      ASSERT_TRUE(rasterize(*pass.state, kIdentity, scene.arrays(), {}, alone_target).ok());
    }
    EXPECT_EQ(*std::max_element(alone.stencil().begin(), alone.stencil().end()) > 2, twins);
    for (const std::int64_t simd_target : simd_targets()) {
      const OnTarget only(simd_target);
      Surface surface = Surface::make(kSize, kSize).value();
      RenderTarget target = surface.target();
      PreparedDraw prepared;
      ASSERT_TRUE(prepare(nearest, kIdentity, scene.arrays(), target, prepared).ok());
      ASSERT_TRUE(rasterize(passes, prepared, {}, target).ok());
      EXPECT_EQ(surface.stencil(), alone.stencil()) << simd_target_name(simd_target) << ' ' << way;
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(surface.color(c), alone.color(c)) << simd_target_name(simd_target) << ' ' << way;
      }
    }
  }
}

}  // namespace
}  // namespace ninebit::test
