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

}  // namespace
}  // namespace ninebit::test
