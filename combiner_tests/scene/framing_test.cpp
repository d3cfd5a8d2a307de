// The default camera, floor and spot light of complete_scene.
#include <algorithm>
#include <cmath>

#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

constexpr float kAspect = 4.0F / 3.0F;

// A thin tower that leans: its vertices fill far less than its bounding box.
Scene tower() {
  Scene scene;
  scene.materials = {{"stone"}};
  scene.objects = {{"tower", 0, 2}};
  scene.positions = {{0, 0, 0}, {0.2F, 0, 0}, {2, 5, 1}, {2.2F, 5, 1}};
  scene.normals.assign(4, glm::vec3(0, 0, 1));
  scene.triangles = {{0, 1, 2}, {2, 1, 3}};
  scene.triangle_object = {0, 0};
  scene.triangle_material = {0, 0};
  return scene;
}

// The place in the picture, from -1 to 1.
glm::dvec2 in_picture(const Camera& camera, const glm::vec3& point) {
  const glm::dvec3 back = glm::normalize(glm::dvec3(camera.position) - glm::dvec3(camera.look_at));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(camera.up), back)), up = glm::cross(back, right);
  const glm::dvec3 at = glm::dvec3(point) - glm::dvec3(camera.position);
  const double tan_y = std::tan(glm::radians(static_cast<double>(camera.vertical_fov_degrees)) / 2);
  const double depth = -glm::dot(at, back);
  EXPECT_GT(depth, 0.0);
  return {glm::dot(at, right) / (depth * tan_y * static_cast<double>(kAspect)), glm::dot(at, up) / (depth * tan_y)};
}

TEST(Framing, TheModelFillsThePicture) {
  const auto scene = complete_scene(tower(), {.floor = FloorChoice::none}, kAspect);
  ASSERT_TRUE(scene) << scene.error().text();
  glm::dvec2 low(1e9), high(-1e9);
  for (const glm::vec3& p : scene->positions) {
    const glm::dvec2 at = in_picture(scene->cameras[0], p);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const glm::dvec2 size = (high - low) / 2.0;
  EXPECT_NEAR(std::max(size.x, size.y), 1.0 / 1.12, 0.03);
  EXPECT_GE(std::min(low.x, low.y), -0.95);
  EXPECT_LE(std::max(high.x, high.y), 0.95);
}

// Rays through the picture's lower corners and through points of its sides hit the floor.
TEST(Framing, TheFloorReachesBeyondThePicture) {
  const auto scene = complete_scene(tower(), {}, kAspect);
  ASSERT_TRUE(scene) << scene.error().text();
  ASSERT_EQ(scene->objects.back().name, "floor");
  const Camera& camera = scene->cameras[0];
  glm::vec3 low(1e9F), high(-1e9F);
  for (std::size_t i = scene->positions.size() - 4; i < scene->positions.size(); ++i) {
    low = glm::min(low, scene->positions[i]);
    high = glm::max(high, scene->positions[i]);
  }
  const glm::dvec3 back = glm::normalize(glm::dvec3(camera.position) - glm::dvec3(camera.look_at));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(camera.up), back)), up = glm::cross(back, right);
  const double tan_y = std::tan(glm::radians(static_cast<double>(camera.vertical_fov_degrees)) / 2);
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      const glm::dvec3 ray = right * (x * tan_y * static_cast<double>(kAspect)) + up * (y * tan_y) - back;
      ASSERT_LT(ray.y, 0.0) << "the horizon is above the picture";
      const glm::dvec3 at =
          glm::dvec3(camera.position) + ray * (static_cast<double>(low.y - camera.position.y) / ray.y);
      EXPECT_GE(at.x, static_cast<double>(low.x) - 1e-3);
      EXPECT_LE(at.x, static_cast<double>(high.x) + 1e-3);
      EXPECT_GE(at.z, static_cast<double>(low.z) - 1e-3);
      EXPECT_LE(at.z, static_cast<double>(high.z) + 1e-3);
    }
  }
}

double degrees_from_axis(const Light& light, const glm::vec3& point) {
  const glm::dvec3 to = glm::normalize(glm::dvec3(point) - glm::dvec3(light.position));
  return glm::degrees(std::acos(std::clamp(glm::dot(to, glm::dvec3(light.direction)), -1.0, 1.0)));
}

TEST(Framing, ASpotHoldsWhatTheCameraSees) {
  const SceneSetup setup{.light_kinds = {.point = false, .spot = true}, .floor = FloorChoice::none};
  const auto scene = complete_scene(tower(), setup, kAspect);
  ASSERT_TRUE(scene) << scene.error().text();
  const Light& light = scene->lights[0];
  ASSERT_EQ(light.kind, LightKind::spot);
  double widest = 0.0;
  for (const glm::vec3& p : scene->positions) widest = std::max(widest, degrees_from_axis(light, p));
  EXPECT_LE(widest, static_cast<double>(light.spot_degrees) / 2.0);
  EXPECT_GE(widest, static_cast<double>(light.spot_degrees) / 2.0 - 3.0) << "and no more than it takes";
}

TEST(Framing, AnAimedOrOpenedSpotStaysAsItIs) {
  SceneSetup setup{
      .light_kinds = {.point = false, .spot = true}, .light_target = glm::vec3(0), .floor = FloorChoice::none};
  const auto aimed = complete_scene(tower(), setup, kAspect);
  ASSERT_TRUE(aimed) << aimed.error().text();
  EXPECT_EQ(aimed->lights[0].spot_degrees, 90.0F);
  setup.light_target.reset();
  setup.spot_degrees = 40.0F;
  const auto opened = complete_scene(tower(), setup, kAspect);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->lights[0].spot_degrees, 40.0F);
}

// Geometry outside the picture does not widen the pyramid.
TEST(Framing, WhatTheCameraDoesNotSeeIsLeftOut) {
  Scene scene = tower();
  const auto near = complete_scene(scene,
                                   {.camera = glm::vec3(1, 2, 9),
                                    .look_at = glm::vec3(1, 2, 0),
                                    .light = glm::vec3(0, 3, 8),
                                    .light_kinds = {.point = false, .spot = true},
                                    .floor = FloorChoice::none},
                                   kAspect);
  scene.positions.insert(scene.positions.end(), {{100, 0, 0}, {101, 0, 0}, {100, 1, 0}});
  scene.normals.resize(7, glm::vec3(0, 0, 1));
  scene.triangles.push_back({4, 5, 6});
  scene.triangle_object.push_back(0);
  scene.triangle_material.push_back(0);
  scene.objects[0].triangle_count = 3;
  const auto far = complete_scene(scene,
                                  {.camera = glm::vec3(1, 2, 9),
                                   .look_at = glm::vec3(1, 2, 0),
                                   .light = glm::vec3(0, 3, 8),
                                   .light_kinds = {.point = false, .spot = true},
                                   .floor = FloorChoice::none},
                                  kAspect);
  ASSERT_TRUE(near && far);
  EXPECT_EQ(near->lights[0].spot_degrees, far->lights[0].spot_degrees);
}

}  // namespace
}  // namespace ninebit::scene_tests
