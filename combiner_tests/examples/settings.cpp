#include <gtest/gtest.h>
#include <ninebit/frame/settings.h>

TEST(Examples, Settings) {
  using namespace ninebit;
  RenderSettings settings{.width = 640, .height = 480, .map_size = 1024};
  settings.profile = profiles::nv2a;
  settings.index.order = IndexOrder::neighbour;  // of index-cube
  settings.shadow_map.polygon_offset = OffsetArguments{.factor = 2.0F, .units = 4.0F};
  settings.shadow_volume.method = VolumeMethod::depth_pass;
  EXPECT_EQ(settings.index.step, 2);  // the article's
}
