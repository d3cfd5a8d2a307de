#include <gtest/gtest.h>
#include <ninebit/scene/scene_io.h>

TEST(Examples, SceneIo) {
  using namespace ninebit;
  const Result<Scene> file = read_scene("scenes/cornell_box.gltf");
  ASSERT_TRUE(file.ok()) << file.error().text();
  const SceneSetup setup{.light_kinds = {.point = true, .spot = true}};
  const Result<Scene> scene = complete_scene(*file, setup, 4.0F / 3.0F);
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(scene->cameras.size(), 1U);
  EXPECT_EQ(scene->lights.size(), 1U);
}
