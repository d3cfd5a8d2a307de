#include <gtest/gtest.h>
#include <ninebit/shadow/ground_truth.h>

TEST(Examples, GroundTruth) {
  using namespace ninebit;
  const Result<Scene> scene = complete_scene(*read_scene("scenes/index_room.gltf"), {}, 4.0F / 3.0F);
  ASSERT_TRUE(scene.ok());
  const RenderSettings settings{.width = 160, .height = 120, .map_size = 128, .evidence = true};
  const Result<Rendering> rendering = find_technique("index-cube")->render(*scene, settings, {});
  const Result<GroundTruthScene> rays = GroundTruthScene::make(*scene);
  ASSERT_TRUE(rays.ok());
  const Result<GroundTruth> judged = measure(*rays, settings, *rendering);
  ASSERT_TRUE(judged.ok()) << judged.error().text();
  EXPECT_GT(judged->by_cause[static_cast<std::size_t>(ErrorCause::joint)], 0U);  // the article's dark lines
  EXPECT_EQ(error_picture(*rendering, *judged).width, 160);
}
