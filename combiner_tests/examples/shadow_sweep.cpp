#include <gtest/gtest.h>
#include <ninebit/study/shadow_sweep.h>

TEST(Examples, ShadowSweep) {
  using namespace ninebit;
  Result<Scene> scene = complete_scene(*read_scene("scenes/index_room.gltf"), {}, 4.0F / 3.0F);
  ASSERT_TRUE(scene.ok());
  const RenderSettings settings{.width = 80, .height = 60};
  const ShadowGrid grid{{"map-size", {"64", "128"}}, {"index-step", {"1", "2"}}};
  const StudyQuestion question{.study = "shadows", .profile = "geforce2"};
  const auto study = make_shadow_sweep(question, *scene, *find_technique("index-cube"), settings, grid);
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ((*study)->units(), 4U);
  EXPECT_EQ((*study)->run(0, {})->front().count("map_size"), 64U);
}
