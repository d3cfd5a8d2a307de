// Cameras, lights and floors that the file does not bring, and what the user overrides.
#include <algorithm>

#include "combiner_tests/scene/scene_test_support.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::scene_tests {
namespace {

using ninebit::test::kInfinity;
using ninebit::test::kNan;

// A tetrahedron that spans the box from low to high.
Scene solid(const glm::vec3& low, const glm::vec3& high) {
  Scene scene;
  scene.name = "solid";
  scene.positions = {low, {high.x, high.y, low.z}, {high.x, low.y, high.z}, {low.x, high.y, high.z}};
  scene.normals.assign(4, {0, 1, 0});
  scene.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  scene.triangle_object.assign(4, 0);
  scene.triangle_material.assign(4, 0);
  scene.objects = {{"solid", 0, 4}};
  scene.materials = {{}};
  return scene;
}

Camera file_camera() {
  return {{0, 1, 9}, {0, 1, 0}, {0.1F, 1, 0}, 35.0F};
}

Scene finished(Scene scene, const SceneSetup& setup, float aspect = 4.0F / 3.0F) {
  Result<Scene> result = complete_scene(std::move(scene), setup, aspect);
  EXPECT_TRUE(result) << result.error().text();
  expect_contract(*result);
  EXPECT_EQ(result->cameras.size(), 1U);
  EXPECT_EQ(result->lights.size(), 1U);
  return std::move(result).value();
}

// The greatest of |x| and |y| that the model's corners reach on a screen from -1 to 1; infinite behind the camera.
float reach_on_screen(const Scene& scene, const Scene& model, float aspect) {
  const Camera& camera = scene.cameras[0];
  const glm::vec3 ahead = glm::normalize(camera.look_at - camera.position);
  const glm::vec3 right = glm::normalize(glm::cross(ahead, camera.up));
  const glm::vec3 up = glm::cross(right, ahead);
  const float tangent = std::tan(glm::radians(camera.vertical_fov_degrees) * 0.5F);
  float reach = 0.0F;
  for (const glm::vec3& corner : model.positions) {
    const glm::vec3 from = corner - camera.position;
    const float depth = glm::dot(from, ahead);
    if (depth <= 0.0F) return kInfinity;
    reach = std::max({reach, std::abs(glm::dot(from, right)) / (depth * tangent * aspect),
                      std::abs(glm::dot(from, up)) / (depth * tangent)});
  }
  return reach;
}

TEST(CompleteScene, FramesTheWholeModel) {
  for (const float aspect : {0.25F, 0.6F, 1.0F, 4.0F / 3.0F, 3.5F}) {
    for (const float fov : {2.0F, 30.0F, 50.0F, 110.0F, 170.0F}) {
      for (const glm::vec3 size : {glm::vec3(1), glm::vec3(9, 1, 1), glm::vec3(1, 9, 1), glm::vec3(1e-3F, 1e-3F, 5e-3F),
                                   glm::vec3(1e4F, 10, 3e4F), glm::vec3(4, 0, 3)}) {
        const glm::vec3 low(3, -7, 11);
        const Scene model = solid(low, low + size);
        SceneSetup setup;
        setup.fov_degrees = fov;
        const Scene scene = finished(model, setup, aspect);
        const float reach = reach_on_screen(scene, model, aspect);
        EXPECT_LT(reach, 0.9F) << aspect << " " << fov << " " << size.x << " " << size.y << " " << size.z;
        if (fov < 60.0F) {
          EXPECT_GT(reach, 0.7F) << aspect << " " << fov << " " << size.x << " " << size.y << " " << size.z;
        }
        const Camera& camera = scene.cameras[0];
        const glm::vec3 from = camera.position - camera.look_at;
        EXPECT_TRUE(from.x > 0 && from.y > 0 && from.z > 0) << "front, right, above";
      }
    }
  }
}

TEST(CompleteScene, LightStandsAboveToTheLeftAndOutside) {
  const Scene model = solid({-1, 0, -2}, {3, 2, 2});
  const Bounds bounds = bounds_of(model);
  const Scene scene = finished(model, {});
  const Camera& camera = scene.cameras[0];
  const glm::vec3 light = scene.lights[0].position - bounds.center();
  const glm::vec3 right = glm::cross(camera.look_at - camera.position, glm::vec3(0, 1, 0));
  EXPECT_LT(glm::dot(light, right), 0.0F);
  EXPECT_GT(glm::dot(light, camera.position - bounds.center()), 0.0F);
  EXPECT_GT(scene.lights[0].position.y, bounds.high.y);
  EXPECT_GE(glm::length(light), bounds.diagonal());
  EXPECT_LE(glm::length(light), bounds.diagonal() * 1.5F);
}

TEST(CompleteScene, AutomaticFloor) {
  const Scene model = solid({-1, 4, -2}, {3, 6, 2});
  const Bounds bounds = bounds_of(model);
  const Scene scene = finished(model, {});
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[1].name, "floor");
  ASSERT_EQ(scene.triangles.size(), 6U);
  glm::vec3 low(kInfinity);
  glm::vec3 high(-kInfinity);
  for (std::size_t i = 4; i < 6; ++i) {
    expect_near(front_of(scene, i), {0, 1, 0});
    for (glm::length_t k = 0; k < 3; ++k) {
      low = glm::min(low, scene.positions[scene.triangles[i][k]]);
      high = glm::max(high, scene.positions[scene.triangles[i][k]]);
      expect_near(scene.normals[scene.triangles[i][k]], {0, 1, 0});
    }
  }
  EXPECT_EQ(low.y, high.y);
  EXPECT_LT(low.y, bounds.low.y);
  EXPECT_NEAR(low.y, bounds.low.y, 0.002F * bounds.diagonal());
  for (const glm::length_t axis : {0, 2}) {
    EXPECT_LE(low[axis], bounds.center()[axis] - 1.499F * bounds.diagonal());
    EXPECT_GE(low[axis], bounds.center()[axis] - 6.001F * bounds.diagonal());
    EXPECT_GE(high[axis], bounds.center()[axis] + 1.499F * bounds.diagonal());
    EXPECT_LE(high[axis], bounds.center()[axis] + 6.001F * bounds.diagonal());
  }
}

TEST(CompleteScene, FloorChoices) {
  Scene with_light = solid({0, 0, 0}, {1, 1, 1});
  with_light.lights = {{"lamp", {0, 9, 0}, {1, 1, 1}}};
  Scene with_camera = solid({0, 0, 0}, {1, 1, 1});
  with_camera.cameras = {file_camera()};
  EXPECT_EQ(finished(with_light, {}).objects.size(), 1U);
  EXPECT_EQ(finished(with_camera, {}).objects.size(), 1U);
  SceneSetup setup;
  // The user's camera and light are not the file's.
  setup.camera = {5, 5, 5};
  setup.light = {0, 9, 1};
  EXPECT_EQ(finished(solid({0, 0, 0}, {1, 1, 1}), setup).objects.size(), 2U);
  setup.floor = FloorChoice::none;
  EXPECT_EQ(finished(solid({0, 0, 0}, {1, 1, 1}), setup).objects.size(), 1U);
  setup.floor = FloorChoice::at_height;
  setup.floor_height = -2.5F;
  const Scene scene = finished(with_light, setup);
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.positions[scene.triangles.back().x].y, -2.5F);
}

TEST(CompleteScene, FirstCameraAndLightOfTheFile) {
  Scene model = solid({-1, 0, -1}, {1, 2, 1});
  model.cameras = {file_camera(), {{7, 7, 7}, {0, 0, 0}, {0, 1, 0}, 90.0F}};
  model.lights = {{"first", {1, 5, 2}, {1, 0.5F, 0}}, {"second", {2, 5, 1}, {1, 1, 1}}};
  const Scene scene = finished(model, {});
  EXPECT_EQ(scene.cameras[0].position, glm::vec3(0, 1, 9));
  EXPECT_EQ(scene.cameras[0].up, glm::vec3(0.1F, 1, 0));
  EXPECT_EQ(scene.cameras[0].vertical_fov_degrees, 35.0F);
  EXPECT_EQ(scene.lights[0].name, "first");
}

TEST(CompleteScene, OverridesLeaveTheRest) {
  Scene model = solid({-1, 0, -1}, {1, 2, 1});
  model.cameras = {file_camera()};
  SceneSetup camera_only;
  camera_only.camera = {4, 3, 2};
  const Scene moved = finished(model, camera_only);
  EXPECT_EQ(moved.cameras[0].position, glm::vec3(4, 3, 2));
  EXPECT_EQ(moved.cameras[0].look_at, glm::vec3(0, 1, 0));
  EXPECT_EQ(moved.cameras[0].up, glm::vec3(0, 1, 0)) << "the file's up would roll the new view";
  EXPECT_EQ(moved.lights[0].position, finished(model, {}).lights[0].position);
  SceneSetup target_only;
  target_only.look_at = {1, 1, 1};
  target_only.fov_degrees = 20.0F;
  target_only.light = {0, 8, 0};
  const Scene turned = finished(model, target_only);
  EXPECT_EQ(turned.cameras[0].position, glm::vec3(0, 1, 9));
  EXPECT_EQ(turned.cameras[0].look_at, glm::vec3(1, 1, 1));
  EXPECT_EQ(turned.cameras[0].vertical_fov_degrees, 20.0F);
  EXPECT_EQ(turned.lights[0].position, glm::vec3(0, 8, 0));
}

TEST(CompleteScene, UpNeverLiesAlongTheView) {
  for (const glm::vec3 direction : {glm::vec3(0, 9, 0), glm::vec3(0, -9, 0), glm::vec3(9, 0, 0), glm::vec3(0, 0, 9)}) {
    SceneSetup setup;
    setup.look_at = {0.5F, 0.5F, 0.5F};
    setup.camera = *setup.look_at + direction;
    const Scene scene = finished(solid({0, 0, 0}, {1, 1, 1}), setup);
    const Camera& camera = scene.cameras[0];
    EXPECT_GT(glm::length(glm::cross(glm::normalize(camera.look_at - camera.position), glm::normalize(camera.up))),
              0.1F);
  }
  Scene model = solid({0, 0, 0}, {1, 1, 1});
  for (const glm::vec3 up : {glm::vec3(0, 0, -3), glm::vec3(0), glm::vec3(kNan)}) {
    model.cameras = {{{0, 0, 9}, {0, 0, 0}, up, 40.0F}};
    const Scene scene = finished(model, {});
    EXPECT_GT(glm::length(glm::cross(glm::vec3(0, 0, -1), glm::normalize(scene.cameras[0].up))), 0.1F);
  }
}

TEST(CompleteScene, PointSizedScene) {
  const Scene scene = finished(solid({2, 2, 2}, {2, 2, 2}), {});
  EXPECT_GT(glm::distance(scene.cameras[0].position, glm::vec3(2)), 0.1F);
}

void expect_fault(const SceneSetup& setup, const std::string& says, float aspect = 1.0F,
                  Scene scene = solid({0, 0, 0}, {1, 1, 1})) {
  const Result<Scene> result = complete_scene(std::move(scene), setup, aspect);
  ASSERT_FALSE(result) << says;
  EXPECT_NE(result.error().message.find(says), std::string::npos) << result.error().message;
}

TEST(CompleteScene, Faults) {
  const glm::vec3 at(3, 4, 5);
  SceneSetup setup;
  setup.camera = at;
  setup.light = at + glm::vec3(5e-7F);
  expect_fault(setup, "at the light");
  setup.light = at + glm::vec3(1e-4F);
  EXPECT_TRUE(complete_scene(solid({0, 0, 0}, {1, 1, 1}), setup, 1.0F));
  setup = {};
  setup.camera = setup.look_at = at;
  expect_fault(setup, "looks at");
  for (const float fov : {0.0F, -1.0F, 1e-30F, 0.009F, 170.1F, 179.999F, 180.0F, 400.0F, kNan, kInfinity}) {
    setup = {};
    setup.fov_degrees = fov;
    expect_fault(setup, "field of view");
  }
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    setup = {};
    setup.camera = {0, bad, 0};
    expect_fault(setup, "camera");
    setup = {};
    setup.look_at = {bad, 0, 0};
    expect_fault(setup, "look at");
    setup = {};
    setup.light = {0, 0, bad};
    expect_fault(setup, "light");
    setup = {};
    setup.floor = FloorChoice::at_height;
    setup.floor_height = bad;
    expect_fault(setup, "floor");
    expect_fault({}, "aspect", bad);
  }
  expect_fault({}, "aspect", 0.0F);
  expect_fault({}, "no triangles", 1.0F, Scene{});
  expect_fault({}, "too large", 1.0F, solid(glm::vec3(-2e38F), glm::vec3(3e38F)));
}

}  // namespace
}  // namespace ninebit::scene_tests
