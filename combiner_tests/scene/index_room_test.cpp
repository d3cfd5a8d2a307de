// The scenes that the project ships: made by their generators, and fit for the techniques.
#include <map>
#include <memory>

#include "combiner_tests/scene/scene_test_support.h"
#include "combiner_tests/support/generated_file.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::scene_tests {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(NINEBIT_SOURCE_DIR) / "scenes";

Scene index_room() {
  Result<Scene> scene = read_scene(kScenes / "index_room.gltf");
  EXPECT_TRUE(scene) << scene.error().text();
  return std::move(scene).value();
}

TEST(ShippedScenes, AreWhatTheirGeneratorsMake) {
  for (const std::string name : {"index_room", "cornell_box"}) {
    test::expect_makes((kScenes / ("make_" + name + ".py")).string(), "", (kScenes / (name + ".gltf")).string());
  }
}

TEST(IndexRoom, HasItsParts) {
  const Scene scene = index_room();
  expect_contract(scene);
  EXPECT_EQ(scene.triangles.size(), 2096U);
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects) names.push_back(object.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"room", "torus", "cube", "sphere", "cone", "cylinder", "pyramid", "pillar"}));
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_NEAR(scene.cameras[0].vertical_fov_degrees, 62.0F, 1e-3F);
  expect_near(scene.cameras[0].position, {4.5F, 3.9F, 4.6F});
  ASSERT_EQ(scene.lights.size(), 1U);
  expect_near(scene.lights[0].position, {0, 4.1F, 0});
  const Result<Scene> complete = complete_scene(scene, {}, 1.0F);
  ASSERT_TRUE(complete);
  EXPECT_EQ(complete->objects.size(), scene.objects.size()) << "a room needs no floor";
}

using Place = std::array<float, 3>;

Place place_of(const glm::vec3& at) {
  return {at.x, at.y, at.z};
}

TEST(IndexRoom, EveryObjectIsClosedAndFacesTheRightWay) {
  const Scene scene = index_room();
  for (const SceneObject& object : scene.objects) {
    std::map<std::pair<Place, Place>, int> edges;
    double volume = 0.0;
    for (std::uint32_t i = object.first_triangle; i < object.first_triangle + object.triangle_count; ++i) {
      const glm::uvec3 t = scene.triangles[i];
      const std::array<glm::vec3, 3> corner{scene.positions[t.x], scene.positions[t.y], scene.positions[t.z]};
      for (std::size_t k = 0; k < 3; ++k) ++edges[{place_of(corner[k]), place_of(corner[(k + 1) % 3])}];
      volume += glm::dot(glm::dvec3(corner[0]), glm::cross(glm::dvec3(corner[1]), glm::dvec3(corner[2]))) / 6.0;
      for (glm::length_t k = 0; k < 3; ++k)
        EXPECT_GT(glm::dot(front_of(scene, i), scene.normals[t[k]]), 0.7F) << object.name;
    }
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1) << object.name << ": an edge is used twice in one direction";
      ASSERT_TRUE(edges.contains({edge.second, edge.first})) << object.name << ": an open edge";
    }
    // The divergence theorem: outward fronts give the volume, the room's inward ones its negative.
    if (object.name == "room") {
      EXPECT_NEAR(volume, -600.0, 0.01);
    } else {
      EXPECT_GT(volume, 0.2) << object.name;
    }
  }
}

// The scene with only one object.
Scene alone(const Scene& scene, const SceneObject& object) {
  Scene out;
  out.positions = scene.positions;
  const auto first = scene.triangles.begin() + object.first_triangle;
  out.triangles.assign(first, first + object.triangle_count);
  return out;
}

bool crosses(const Scene& scene, const glm::uvec3& t, const glm::vec3& from, const glm::vec3& to) {
  const glm::dvec3 a(scene.positions[t.x]);
  const glm::dvec3 e1 = glm::dvec3(scene.positions[t.y]) - a;
  const glm::dvec3 e2 = glm::dvec3(scene.positions[t.z]) - a;
  const glm::dvec3 along = glm::dvec3(to) - glm::dvec3(from);
  const glm::dvec3 p = glm::cross(along, e2);
  const double det = glm::dot(e1, p);
  if (det == 0.0) return false;
  const glm::dvec3 s = glm::dvec3(from) - a;
  const glm::dvec3 q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / det;
  const double v = glm::dot(along, q) / det;
  const double w = glm::dot(e2, q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && w > 1e-3 && w < 1.0 - 1e-3;
}

TEST(IndexRoom, ObjectsStandApartAndFreeOfLightAndCamera) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Scene scene = index_room();
  for (const SceneObject& object : scene.objects) {
    const Scene one = alone(scene, object);
    EXPECT_GT(distance_to_nearest_triangle(one, scene.lights[0].position), 0.5F) << object.name;
    EXPECT_GT(distance_to_nearest_triangle(one, scene.cameras[0].position), 0.3F) << object.name;
    for (const SceneObject& other : scene.objects) {
      if (&other == &object) continue;
      for (std::uint32_t i = other.first_triangle; i < other.first_triangle + other.triangle_count; ++i) {
        for (glm::length_t k = 0; k < 3; ++k) {
          const glm::vec3 from = scene.positions[scene.triangles[i][k]];
          const glm::vec3 to = scene.positions[scene.triangles[i][(k + 1) % 3]];
          if (k == 0) {
            ASSERT_GT(distance_to_nearest_triangle(one, from), 0.01F) << object.name << " " << other.name;
          }
          for (const glm::uvec3& t : one.triangles)
            ASSERT_FALSE(crosses(one, t, from, to)) << object.name << " and " << other.name;
        }
      }
    }
  }
}

TEST(IndexRoom, TheTorusShadowsItself) {
  const Scene scene = index_room();
  const Scene torus = alone(scene, scene.objects[1]);
  const glm::vec3 light = scene.lights[0].position;
  int toward_light = 0;
  int shadowed_by_itself = 0;
  for (std::size_t i = 0; i < torus.triangles.size(); ++i) {
    const glm::uvec3 t = torus.triangles[i];
    const glm::vec3 at = (torus.positions[t.x] + torus.positions[t.y] + torus.positions[t.z]) / 3.0F;
    if (glm::dot(front_of(torus, i), light - at) <= 0.0F) continue;
    ++toward_light;
    bool hidden = false;
    for (const glm::uvec3& other : torus.triangles) hidden = hidden || (other != t && crosses(torus, other, light, at));
    shadowed_by_itself += hidden ? 1 : 0;
  }
  EXPECT_GT(toward_light, 200);
  EXPECT_GT(shadowed_by_itself, 40);
}

TEST(CornellBox, HasItsWallsBoxesCameraAndSpotLight) {
  Result<Scene> read = read_scene(kScenes / "cornell_box.gltf");
  ASSERT_TRUE(read) << read.error().text();
  const Scene& scene = *read;
  expect_contract(scene);
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects) names.push_back(object.name);
  EXPECT_EQ(names, (std::vector<std::string>{"room", "tall box", "low box"}));
  // The left wall is red, the right one green, and both face inward.
  int left = 0, right = 0;
  for (std::uint32_t i = 0; i < scene.objects[0].triangle_count; ++i) {
    const glm::vec3 at = scene.positions[scene.triangles[i].x], front = front_of(scene, i);
    const glm::vec3 color = scene.materials[scene.triangle_material[i]].base_color;
    EXPECT_GT(glm::dot(front, glm::vec3(0, 3, 0) - at), 0.0F);
    if (front.x > 0.9F && color.r > 3.0F * color.g) ++left;
    if (front.x < -0.9F && color.g > 3.0F * color.r) ++right;
  }
  EXPECT_EQ(left, 72);
  EXPECT_EQ(right, 72);
  ASSERT_EQ(scene.cameras.size(), 1U);
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].kind, LightKind::spot);
  EXPECT_NEAR(scene.lights[0].spot_degrees, 100.0F, 1e-3F);
  EXPECT_LT(scene.lights[0].direction.y, -0.9F);
  SceneSetup setup;
  setup.light_kinds = {.point = false, .spot = true};
  EXPECT_TRUE(complete_scene(scene, setup, 1.0F));
}

}  // namespace
}  // namespace ninebit::scene_tests
