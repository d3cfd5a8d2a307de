// Which light of the file a technique gets, where it stands and what it shines at.
#include <limits>

#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

constexpr LightKinds kSpot{.point = false, .spot = true};
constexpr LightKinds kSun{.point = false, .directional = true};
constexpr LightKinds kSpotOrSun{.point = false, .spot = true, .directional = true};

// A box from (0, 0, 0) to (2, 2, 2), whose middle is (1, 1, 1), with the file's lights.
Scene lit_box(std::vector<Light> lights) {
  Scene scene = box({0, 0, 0}, {2, 2, 2});
  scene.lights = std::move(lights);
  return scene;
}

Light lamp(const std::string& name, const glm::vec3& position = {1, 9, 1}) {
  return {.name = name, .position = position};
}

Light spot(const std::string& name, const glm::vec3& position = {1, 6, 1}) {
  return {.name = name,
          .position = position,
          .kind = LightKind::spot,
          .direction = {0.6F, -0.8F, 0.0F},
          .spot_degrees = 40.0F};
}

Light sun(const std::string& name) {
  return {.name = name, .position = {3, 3, 3}, .kind = LightKind::directional, .direction = {0.0F, -0.6F, 0.8F}};
}

Light completed(Scene scene, const LightKinds& kinds, SceneSetup setup = {}) {
  setup.light_kinds = kinds;
  const Result<Scene> result = complete_scene(std::move(scene), setup, 1.0F);
  EXPECT_TRUE(result) << result.error().text();
  if (!result) return {};
  EXPECT_EQ(result->lights.size(), 1U);
  return result->lights[0];
}

TEST(CompleteLight, TheFirstOfAKindThatWillDo) {
  const Scene all = lit_box({sun("sun"), spot("spot"), lamp("lamp"), lamp("other lamp", {5, 9, 5})});
  EXPECT_EQ(completed(all, {}).name, "lamp");
  EXPECT_EQ(completed(all, kSpot).name, "spot");
  EXPECT_EQ(completed(all, kSun).name, "sun");
  EXPECT_EQ(completed(all, kSpotOrSun).name, "sun");
  EXPECT_EQ(completed(all, {.point = true, .spot = true}).name, "spot");
}

TEST(CompleteLight, AsTheFileAimsIt) {
  const Light kept = completed(lit_box({spot("spot")}), kSpot);
  EXPECT_EQ(kept.kind, LightKind::spot);
  EXPECT_EQ(kept.position, glm::vec3(1, 6, 1));
  EXPECT_EQ(kept.direction, glm::vec3(0.6F, -0.8F, 0.0F));
  EXPECT_EQ(kept.spot_degrees, 40.0F);
  EXPECT_EQ(completed(lit_box({sun("sun")}), kSun).direction, glm::vec3(0.0F, -0.6F, 0.8F));
}

TEST(CompleteLight, WithoutAPointLightTheDefaultOneShinesEverywhere) {
  const Light made = completed(lit_box({spot("spot"), sun("sun")}), {});
  EXPECT_EQ(made.kind, LightKind::point);
  EXPECT_EQ(made.name, "light");
  expect_near(made.position, completed(lit_box({}), {}).position);
}

// A cone that holds the box and is no wider than the sphere around the box, by a degree.
void expect_to_hold_the_box(const Light& light) {
  const float half = light.spot_degrees * 0.5F;
  for (const glm::vec3& corner : box({0, 0, 0}, {2, 2, 2}).positions) {
    EXPECT_LE(glm::degrees(std::acos(glm::dot(light.direction, glm::normalize(corner - light.position)))), half);
  }
  EXPECT_LT(half, glm::degrees(std::asin(std::sqrt(3.0F) / glm::distance(light.position, glm::vec3(1)))) + 1.0F);
}

TEST(CompleteLight, APointLightBecomesTheKindThatWillDo) {
  const Scene lamps = lit_box({lamp("first", {1, 5, 1}), lamp("second")});
  for (const LightKinds& kinds : {kSpot, kSpotOrSun}) {
    const Light light = completed(lamps, kinds);
    EXPECT_EQ(light.kind, LightKind::spot);
    EXPECT_EQ(light.name, "first");
    EXPECT_EQ(light.position, glm::vec3(1, 5, 1));
    expect_to_hold_the_box(light);
  }
  EXPECT_EQ(completed(lamps, kSun).kind, LightKind::directional);
  // Without any: the default light.
  SceneSetup without_floor;
  without_floor.floor = FloorChoice::none;
  const Light made = completed(lit_box({}), kSpot, without_floor);
  EXPECT_EQ(made.kind, LightKind::spot);
  expect_to_hold_the_box(made);
}

TEST(CompleteLight, TheSetupAimsIt) {
  SceneSetup at_target;
  at_target.light_target = {1, 6, 8};
  at_target.spot_degrees = 25.0F;
  const Light aimed = completed(lit_box({spot("spot")}), kSpot, at_target);
  expect_near(aimed.direction, {0, 0, 1});
  EXPECT_EQ(aimed.spot_degrees, 25.0F);
  // A spot light that is moved shines as before; a directional one has no other way of being moved than to turn.
  SceneSetup moved;
  moved.light = {1, 1, -7};
  EXPECT_EQ(completed(lit_box({spot("spot")}), kSpot, moved).direction, glm::vec3(0.6F, -0.8F, 0.0F));
  EXPECT_EQ(completed(lit_box({spot("spot")}), kSpot, moved).position, glm::vec3(1, 1, -7));
  expect_near(completed(lit_box({sun("sun")}), kSun, moved).direction, {0, 0, 1});
  moved.light_target = {9, 1, -7};
  expect_near(completed(lit_box({sun("sun")}), kSun, moved).direction, {1, 0, 0});
}

TEST(CompleteLight, OnlyALightThatStandsSomewhereCanBeInTheWay) {
  SceneSetup inside;
  inside.light = {1, 0.9F, 1};
  inside.light_kinds = kSun;
  EXPECT_TRUE(complete_scene(lit_box({}), inside, 1.0F)) << "a directional light is far outside the solid";
  inside.light_kinds = kSpot;
  EXPECT_FALSE(complete_scene(lit_box({}), inside, 1.0F));
  SceneSetup at_camera;
  at_camera.light = at_camera.camera = {5, 5, 5};
  at_camera.light_kinds = kSun;
  EXPECT_TRUE(complete_scene(lit_box({}), at_camera, 1.0F));
  at_camera.light_kinds = kSpot;
  EXPECT_FALSE(complete_scene(lit_box({}), at_camera, 1.0F));
}

TEST(CompleteLight, Faults) {
  const auto expect_fault = [](const SceneSetup& setup, const std::string& says) {
    const Result<Scene> result = complete_scene(lit_box({}), setup, 1.0F);
    ASSERT_FALSE(result) << says;
    EXPECT_NE(result.error().message.find(says), std::string::npos) << result.error().message;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  SceneSetup setup;
  setup.light_target = {0, 0, 0};
  expect_fault(setup, "a point light shines everywhere");
  setup.light_kinds = kSpot;
  setup.light = {0, 0, 0};
  expect_fault(setup, "no direction");
  setup.light_target = {0, nan, 0};
  expect_fault(setup, "target must be finite");
  setup.light_target = {0, 0, 2e12F};
  expect_fault(setup, "shines at");
  setup.light_target.reset();
  for (const float degrees : {0.0F, 0.99F, 170.1F, -30.0F, nan}) {
    setup.spot_degrees = degrees;
    expect_fault(setup, "opening angle");
  }
}

}  // namespace
}  // namespace ninebit::scene_tests
