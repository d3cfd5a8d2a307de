#include <gtest/gtest.h>
#include <ninebit/shadow/reflective.h>

TEST(Examples, Reflective) {
  using namespace ninebit;
  const SceneSetup setup{.light_kinds = {.point = false, .spot = true}};
  const Result<Scene> scene = complete_scene(*read_scene("scenes/cornell_box.gltf"), setup, 1.0F);
  ASSERT_TRUE(scene.ok());
  const Result<ReflectiveMap> map = draw_reflective_map(*scene, {.map_size = 64});
  ASSERT_TRUE(map.ok()) << map.error().text();
  EXPECT_EQ(map->flux[0].size(), 64U * 64U);
  EXPECT_GT(float_of(map->flux[0][64 * 32 + 32]), 0.0F);
  EXPECT_EQ(positions_from_depth(*map).size(), 64U * 64U);
}
