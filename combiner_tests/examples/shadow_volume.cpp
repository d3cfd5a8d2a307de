#include <gtest/gtest.h>
#include <ninebit/shadow/shadow_volume.h>

TEST(Examples, ShadowVolume) {
  using namespace ninebit;
  RenderSettings settings;
  const auto passes = volume_passes(settings);
  ASSERT_EQ(passes.size(), 1U);  // both faces at once
  EXPECT_EQ(passes[0].state.stencil_test.front.depth_fail, StencilOperation::decr_wrap);
  settings.shadow_volume.two_sided = false;
  EXPECT_EQ(volume_passes(settings).size(), 2U);
}
