// Coordinates and angles that floats could not carry through a rendering.
#include <limits>

#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

const Scene kBox = box({-1, -1, -1}, {1, 1, 1});

std::string fault_of(const SceneSetup& setup, const Scene& scene = kBox) {
  const Result<Scene> result = complete_scene(scene, setup, 1.0F);
  return result ? "" : result.error().message;
}

void expect_says(const std::string& message, const std::string& what, const std::string& limit) {
  EXPECT_NE(message.find(what), std::string::npos) << message;
  EXPECT_NE(message.find(limit), std::string::npos) << message;
}

TEST(Range, EachPlaceByName) {
  const std::string limit = "from -1e12 to 1e12";
  for (const float far : {1.001e12F, -1.001e12F, 1e20F, -1e30F, std::numeric_limits<float>::max()}) {
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      glm::vec3 at(0, 3, 5);
      at[axis] = far;
      SceneSetup setup;
      setup.camera = at;
      expect_says(fault_of(setup), "the camera at (", limit);
      setup = {};
      setup.look_at = at;
      expect_says(fault_of(setup), "the point that the camera looks at", limit);
      setup = {};
      setup.light = at;
      expect_says(fault_of(setup), "the light at (", limit);
    }
    SceneSetup setup;
    setup.floor = FloorChoice::at_height;
    setup.floor_height = far;
    expect_says(fault_of(setup), "the floor is too large", limit);
    Scene scene = kBox;
    scene.positions[3].y = far;
    expect_says(fault_of({}, scene), "the scene is too large", limit);
  }
}

TEST(Range, TheLimitItselfIsAllowed) {
  SceneSetup setup;
  setup.camera = {1e12F, -1e12F, 1e12F};
  setup.light = {-1e12F, 1e12F, 1e12F};
  setup.floor = FloorChoice::at_height;
  setup.floor_height = -1e12F;
  EXPECT_EQ(fault_of(setup), "");
}

TEST(Range, WhatTheFramingAddsCounts) {
  // The box itself is within range; its floor, or the view of it, is not.
  SceneSetup setup;
  setup.camera = {1e11F, 1e11F, 2e11F};
  setup.light = {3e11F, 8e11F, 2e11F};
  const Scene large = box(glm::vec3(-9e11F), glm::vec3(9e11F), true);
  expect_says(fault_of(setup, large), "the floor", "1e12");
  setup.floor = FloorChoice::none;
  EXPECT_EQ(fault_of(setup, large), "");
  setup = {};
  setup.fov_degrees = 0.01F;
  expect_says(fault_of(setup, box(glm::vec3(-1e9F), glm::vec3(1e9F))), "the camera", "1e12");
}

TEST(Range, FieldOfView) {
  SceneSetup setup;
  for (const float fov : {1e-30F, 0.0099F, 170.01F, 179.999F}) {
    setup.fov_degrees = fov;
    expect_says(fault_of(setup), "field of view", "from 0.01 to 170 degrees");
    Scene scene = kBox;
    scene.cameras = {{{5, 5, 5}, {0, 0, 0}, {0, 1, 0}, fov}};
    expect_says(fault_of({}, scene), "field of view", "from 0.01 to 170 degrees");
  }
  for (const float fov : {0.01F, 170.0F}) {
    setup.fov_degrees = fov;
    EXPECT_EQ(fault_of(setup), "") << fov;
  }
}

// Far from the origin, too, where a step of 1 would vanish in the coordinates.
TEST(Range, SceneWithoutExtent) {
  for (const float extent : {0.0F, 1e-45F, 1e-40F, 1e-30F, 1e-20F, 1e-13F, 1e-11F, 1e-6F}) {
    for (const glm::vec3 at : {glm::vec3(0), glm::vec3(2), glm::vec3(-3e10F, 5e10F, 1e10F)}) {
      const Result<Scene> scene = complete_scene(box(at, at + glm::vec3(extent)), {}, 1.0F);
      ASSERT_TRUE(scene) << extent << " " << scene.error().text();
      for (const glm::vec3& place : {scene->cameras[0].position, scene->lights[0].position}) {
        const float away2 = glm::dot(place - at, place - at);
        EXPECT_TRUE(std::isnormal(away2)) << extent << " " << at.x;
      }
    }
  }
}

TEST(Range, AnUpVectorWhoseSquareIsNoFloat) {
  for (const float length : {1e-30F, 1e-9F, 1e9F, 3e38F}) {
    Scene scene = kBox;
    scene.cameras = {{{0, 0, 9}, {0, 0, 0}, {0.5F * length, 0.5F * length, 0}, 40.0F}};
    const Result<Scene> complete = complete_scene(scene, {}, 1.0F);
    ASSERT_TRUE(complete) << complete.error().text();
    expect_near(complete->cameras[0].up, glm::normalize(glm::vec3(1, 1, 0)));
  }
}

}  // namespace
}  // namespace ninebit::scene_tests
