#include <gtest/gtest.h>
#include <ninebit/raster/fragment_probe.h>
#include <ninebit/raster/rasterizer.h>

#include <vector>

TEST(Examples, FragmentProbe) {
  using namespace ninebit;
  Result<Surface> surface = Surface::make(64, 64);
  RenderTarget target = surface->target();
  std::vector<FragmentProbe> probes{{.x = 10, .y = 10}, {.x = 60, .y = 60}};
  target.probes = &probes;
  const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  PipelineState state;
  state.alpha_test = {.enabled = true, .function = CompareFunction::less, .reference = 128};
  ASSERT_TRUE(rasterize(state, glm::mat4(1.0F), {.positions = corners}, {}, target).ok());
  ASSERT_EQ(probes[0].fragments.size(), 1U);
  EXPECT_EQ(probes[0].fragments[0].fate, FragmentFate::alpha_failed);
  EXPECT_EQ(probes[0].fragments[0].color[kAlpha], 255);
  EXPECT_TRUE(probes[1].fragments.empty());
}
