#include <gtest/gtest.h>
#include <ninebit/shadow/shadow_map.h>

TEST(Examples, ShadowMap) {
  using namespace ninebit;
  const SceneSetup setup{.light_kinds = {.point = false, .spot = true}};
  const Result<Scene> scene = complete_scene(*read_scene("scenes/index_room.gltf"), setup, 4.0F / 3.0F);
  ASSERT_TRUE(scene.ok());
  const RenderSettings settings{.width = 160, .height = 120, .map_size = 256};
  const Result<Rendering> rendering = render_shadow_map(*scene, settings, {});
  ASSERT_TRUE(rendering.ok()) << rendering.error().text();
  EXPECT_EQ(rendering->pictures[0].file, "shadow_map.png");
  EXPECT_TRUE(shadow_map_passes(settings)->map.polygon_offset.fill);
}
