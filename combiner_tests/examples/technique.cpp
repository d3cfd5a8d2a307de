#include <gtest/gtest.h>
#include <ninebit/shadow/technique.h>

TEST(Examples, Technique) {
  using namespace ninebit;
  const Technique* technique = find_technique("index-cube");
  ASSERT_NE(technique, nullptr);
  const Result<Scene> scene = complete_scene(*read_scene("scenes/index_room.gltf"), {}, 4.0F / 3.0F);
  ASSERT_TRUE(scene.ok());
  const RenderSettings settings{.width = 160, .height = 120, .map_size = 128};
  const Result<Rendering> rendering = technique->render(*scene, settings, {});
  ASSERT_TRUE(rendering.ok()) << rendering.error().text();
  EXPECT_EQ(rendering->background + rendering->lit + rendering->shadowed, 160U * 120U);
  EXPECT_GT(rendering->shadowed, 0U);
}
