#include <gtest/gtest.h>
#include <ninebit/frame/pictures.h>

TEST(Examples, Pictures) {
  using namespace ninebit;
  const Result<Scene> scene = complete_scene(*read_scene("scenes/index_room.gltf"), {}, 4.0F / 3.0F);
  const RenderSettings settings{.width = 160, .height = 120, .map_size = 64};
  const Result<Rendering> rendering = find_technique("index-cube")->render(*scene, settings, {});
  ASSERT_TRUE(rendering.ok());
  EXPECT_EQ(color_picture(*rendering).height, 120);
  EXPECT_EQ(index_cross_picture(*rendering).width, 4 * 64);
  EXPECT_EQ(averaged(stencil_picture(*rendering), 2).width, 80);
}
