// How often a mesh goes around a point, and what complete_scene makes of it: lights inside solids.
#include <algorithm>
#include <numbers>

#include "combiner_tests/scene/scene_test_support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::scene_tests {
namespace {

const std::filesystem::path kRoom = std::filesystem::path(NINEBIT_SOURCE_DIR) / "scenes" / "index_room.gltf";
const std::filesystem::path kBunny = "/usr/share/glmark2/models/bunny.obj";
constexpr double kTiny = 1e-9;

double winding(const Scene& scene, const glm::vec3& point, std::size_t object = 0) {
  return winding_number(scene, scene.objects[object], point);
}

// The first object without its last `count` triangles.
Scene without_last(Scene scene, std::uint32_t count) {
  const std::size_t kept = scene.triangles.size() - count;
  scene.triangles.resize(kept);
  scene.triangle_object.resize(kept);
  scene.triangle_material.resize(kept);
  scene.objects[0].triangle_count -= count;
  return scene;
}

// A ring around the y axis, radius 2, its tube 0.5.
Scene torus(std::uint32_t around, std::uint32_t across) {
  Scene scene;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * k / across;
      const double radius = 2.0 + 0.5 * std::cos(v);
      scene.positions.emplace_back(radius * std::cos(u), 0.5 * std::sin(v), radius * std::sin(u));
      const std::uint32_t i1 = (i + 1) % around, k1 = (k + 1) % across;
      const std::uint32_t a = i * across + k, b = i * across + k1, c = i1 * across + k1, d = i1 * across + k;
      scene.triangles.insert(scene.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  scene.normals.assign(scene.positions.size(), {0, 1, 0});
  scene.triangle_object.assign(scene.triangles.size(), 0);
  scene.triangle_material.assign(scene.triangles.size(), 0);
  scene.objects = {{"torus", 0, static_cast<std::uint32_t>(scene.triangles.size())}};
  scene.materials = {{}};
  return scene;
}

TEST(WindingNumber, Box) {
  const Scene out = box({-1, -2, -3}, {1, 2, 3});
  const Scene in = box({-1, -2, -3}, {1, 2, 3}, true);
  for (const glm::vec3 inside : {glm::vec3(0), glm::vec3(0.999F, 1.9F, -2.9F), glm::vec3(0.5F, 0, 0)}) {
    EXPECT_NEAR(winding(out, inside), 1.0, kTiny);
    EXPECT_NEAR(winding(in, inside), -1.0, kTiny);
  }
  for (const glm::vec3 outside : {glm::vec3(1.001F, 0, 0), glm::vec3(9, 2, 3), glm::vec3(0, 1e12F, 0)}) {
    EXPECT_NEAR(winding(out, outside), 0.0, kTiny);
    EXPECT_NEAR(winding(in, outside), 0.0, kTiny);
  }
}

TEST(WindingNumber, OnTheSurface) {
  const Scene scene = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_NEAR(winding(scene, {1, 0.25F, 0.5F}), 0.5, kTiny) << "on a triangle";
  EXPECT_NEAR(winding(scene, {1, 0, 0}), 0.5, kTiny) << "on the edge between two";
  EXPECT_NEAR(winding(scene, {1, 1, 0.5F}), 0.25, kTiny) << "on an edge of the box";
  EXPECT_NEAR(winding(scene, {1, 1, 1}), 0.125, kTiny) << "at a corner";
  EXPECT_NEAR(winding(scene, {1, 7, 0.5F}), 0.0, kTiny) << "in the plane of a side";
}

TEST(WindingNumber, OpenMeshesLieBetween) {
  const Scene open = without_last(box({-1, -1, -1}, {1, 1, 1}), 2);
  EXPECT_NEAR(winding(open, {0, 0, 0}), 5.0 / 6.0, kTiny) << "the missing side fills a sixth of all directions";
  EXPECT_NEAR(winding(open, {0, 0, 1}), 0.5, kTiny) << "in the opening";
  EXPECT_LT(winding(open, {0, 0, 1.5F}), 0.4);
  // One side that is seen from behind and from the front.
  Scene side = without_last(box({-1, -1, -1}, {1, 1, 1}), 10);
  EXPECT_NEAR(winding(side, {0, 0, 0}), 1.0 / 6.0, kTiny);
  EXPECT_NEAR(winding(side, {-2, 0, 0}), -1.0 / 6.0, kTiny);
}

TEST(WindingNumber, TorusAndItsHole) {
  const Scene scene = torus(48, 24);
  EXPECT_NEAR(winding(scene, {2, 0, 0}), 1.0, kTiny);
  EXPECT_NEAR(winding(scene, {0, 0.3F, -2.1F}), 1.0, kTiny);
  EXPECT_NEAR(winding(scene, {0, 0, 0}), 0.0, kTiny);
  EXPECT_NEAR(winding(scene, {2, 0.6F, 0}), 0.0, kTiny);
}

TEST(WindingNumber, DegenerateTrianglesAddNothing) {
  Scene scene = box({-1, -1, -1}, {1, 1, 1});
  const glm::vec3 point(0.1F, 0.2F, 0.3F);
  scene.positions.insert(scene.positions.end(), {point, point + glm::vec3(1, 2, 3), point - glm::vec3(2, 4, 6)});
  for (const glm::uvec3 t :
       {glm::uvec3(0, 0, 1), glm::uvec3(2, 2, 2), glm::uvec3(8, 9, 10), glm::uvec3(8, 8, 8), glm::uvec3(9, 10, 9)}) {
    scene.triangles.push_back(t);
  }
  scene.objects[0].triangle_count += 5;
  EXPECT_NEAR(winding(scene, point), 1.0, kTiny);
  EXPECT_NEAR(winding(scene, {0, 5, 0}), 0.0, kTiny);
  scene.triangles.emplace_back(8, 0, 1);
  scene.objects[0].triangle_count += 1;
  EXPECT_NEAR(winding(scene, point), 1.0, kTiny) << "a triangle with its corner at the point";
}

TEST(WindingNumber, OnlyTheObjectCounts) {
  Scene scene = box({-1, -1, -1}, {1, 1, 1});
  add_box(scene, {3, 3, 3}, {5, 5, 5}, "other");
  EXPECT_NEAR(winding(scene, {4, 4, 4}, 0), 0.0, kTiny);
  EXPECT_NEAR(winding(scene, {4, 4, 4}, 1), 1.0, kTiny);
}

TEST(WindingNumber, OfALargeMesh) {
  const Scene scene = torus(550, 110);
  ASSERT_EQ(scene.triangles.size(), 121000U);
  EXPECT_NEAR(winding(scene, {2, 0.1F, 0}), 1.0, kTiny);
}

std::string fault_of(const Scene& scene, const glm::vec3& light, std::optional<glm::vec3> camera = {}) {
  SceneSetup setup;
  setup.light = light;
  setup.camera = camera;
  const Result<Scene> result = complete_scene(scene, setup, 1.0F);
  return result ? "" : result.error().message;
}

TEST(LightInSolid, Bunny) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Result<Scene> bunny = read_scene(kBunny);
  ASSERT_TRUE(bunny) << bunny.error().text();
  EXPECT_NEAR(winding(*bunny, {0, 0, 0}), 1.0, kTiny);
  EXPECT_NE(fault_of(*bunny, {0, 0, 0}).find("the light at (0, 0, 0) is inside a solid (\""), std::string::npos);
  // Next to thin parts, where a picture taken from the light may show a front.
  EXPECT_NE(fault_of(*bunny, {-0.126F, -0.19F, 0.135F}).find("(-0.126, -0.19, 0.135) is inside a solid"),
            std::string::npos);
  EXPECT_EQ(fault_of(*bunny, {0, 2, 0}), "");
  EXPECT_EQ(fault_of(*bunny, {0.9F, 0.9F, 0.7F}), "") << "in the box, beside the model";
}

TEST(LightInSolid, IndexRoom) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Result<Scene> room = read_scene(kRoom);
  ASSERT_TRUE(room) << room.error().text();
  const glm::vec3 light = room->lights[0].position;
  EXPECT_NEAR(winding(*room, light), -1.0, kTiny) << "the room faces inward";
  for (std::size_t i = 1; i < room->objects.size(); ++i) EXPECT_NEAR(winding(*room, light, i), 0.0, kTiny) << i;
  EXPECT_TRUE(complete_scene(*room, {}, 1.0F));
  for (std::size_t i = 2; i < room->objects.size(); ++i) {
    // Every part but the torus holds the middle of its box.
    glm::vec3 low(1e9F), high(-1e9F);
    const SceneObject& object = room->objects[i];
    for (std::size_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t) {
      for (glm::length_t k = 0; k < 3; ++k) {
        low = glm::min(low, room->positions[room->triangles[t][k]]);
        high = glm::max(high, room->positions[room->triangles[t][k]]);
      }
    }
    const std::string message = fault_of(*room, (low + high) * 0.5F);
    EXPECT_NE(message.find("inside a solid (\"" + object.name + "\")"), std::string::npos) << object.name << message;
  }
}

TEST(LightInSolid, TheCameraDecidesInARoomWoundTheWrongWay) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Scene outward = box({-4, -4, -4}, {4, 4, 4});
  const Scene inward = box({-4, -4, -4}, {4, 4, 4}, true);
  const glm::vec3 inside(2, 1, 3);
  const glm::vec3 outside(9, 9, 9);
  EXPECT_EQ(fault_of(outward, {0, 1, 0}, inside), "");
  EXPECT_EQ(fault_of(outward, {0, 1, 0}, outside),
            "the light at (0, 1, 0) is inside a solid (\"box\") and the camera is not; expected a light in the open");
  EXPECT_EQ(fault_of(inward, {0, 1, 0}, inside), "");
  EXPECT_EQ(fault_of(inward, {0, 1, 0}, outside), "");
  EXPECT_EQ(fault_of(outward, {0, 9, 0}, inside), "");
  // A solid around the light, within the room that holds both.
  Scene nested = outward;
  add_box(nested, {-1, -1, -1}, {1, 1, 1}, "lamp shade");
  EXPECT_NE(fault_of(nested, {0, 0.5F, 0}, inside).find("\"lamp shade\""), std::string::npos);
}

TEST(LightInSolid, OnASurfaceOrInAPlaneIsInTheOpen) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const Scene scene = box({-1, -1, -1}, {1, 1, 1});
  const glm::vec3 camera(7, 5, 9);
  for (const glm::vec3 light : {glm::vec3(1, 0.3F, 0.1F), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0.5F), glm::vec3(-1),
                                glm::vec3(1, 5, 0), glm::vec3(std::nextafter(1.0F, 0.0F), 0.3F, 0.1F)}) {
    EXPECT_EQ(fault_of(scene, light, camera), "") << light.x << " " << light.y << " " << light.z;
  }
  EXPECT_NE(fault_of(scene, {0.999F, 0.3F, 0.1F}, camera), "");
  // Points on tilted triangles, off by the rounding to floats.
  const Scene ring = torus(31, 17);
  for (const glm::uvec3& t : ring.triangles) {
    const glm::vec3 middle = (ring.positions[t.x] + ring.positions[t.y] + ring.positions[t.z]) / 3.0F;
    ASSERT_EQ(fault_of(ring, middle, camera), "");
  }
}

TEST(LightInSolid, SheetsInFrontOfTheLightAreNoSolid) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  // Twelve sheets turn their backs on the light and fill more than all directions together.
  Scene scene;
  for (int i = 0; i < 12; ++i) {
    const float y = -0.05F * static_cast<float>(i);
    const auto base = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::vec2 corner : {glm::vec2(-9, -9), glm::vec2(9, -9), glm::vec2(9, 9), glm::vec2(-9, 9)})
      scene.positions.emplace_back(corner.x, y, corner.y);
    scene.triangles.insert(scene.triangles.end(), {{base, base + 1, base + 2}, {base, base + 2, base + 3}});
  }
  scene.normals.assign(scene.positions.size(), {0, -1, 0});
  scene.triangle_object.assign(24, 0);
  scene.triangle_material.assign(24, 0);
  scene.objects = {{"blinds", 0, 24}};
  scene.materials = {{}};
  const glm::vec3 light(0, 0.5F, 0);
  EXPECT_GT(winding(scene, light), 2.0);
  EXPECT_EQ(fault_of(scene, light, glm::vec3(0, -8, 3)), "");
}

}  // namespace
}  // namespace ninebit::scene_tests
