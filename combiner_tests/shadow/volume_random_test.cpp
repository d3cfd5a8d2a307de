// Shadow volumes of random objects, pixel by pixel against rays.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/shadow/volume_support.h"
#include "combiner_tests/support/random.h"
#include "src/frame/views.h"

namespace {

using namespace ninebit;
using namespace shadow_test;
using test::Random;

glm::vec3 somewhere(Random& random, double reach) {
  return {random.real_f(-reach, reach), random.real_f(-reach, reach), random.real_f(-reach, reach)};
}

// Moves an object's vertices by a random rotation and scaling, then to `place`.
void toss(Random& random, Scene& scene, std::size_t first_vertex, const glm::vec3& place) {
  const glm::vec3 axis = glm::normalize(somewhere(random, 1.0) + glm::vec3(0.0F, 0.0F, 2.0F));
  const glm::mat3 turn(glm::rotate(glm::mat4(1.0F), random.real_f(0, 6), axis));
  const glm::vec3 size(random.real_f(0.3, 1.2), random.real_f(0.3, 1.2), random.real_f(0.3, 1.2));
  for (std::size_t i = first_vertex; i < scene.positions.size(); ++i) {
    scene.positions[i] = turn * (scene.positions[i] * size) + place;
  }
}

enum class Kind { closed, open };

// A room of a large box, or a floor, with some objects.
Scene random_scene(Random& random, Kind kind) {
  Scene scene = scene_with(somewhere(random, 3.5), somewhere(random, 1.0), somewhere(random, 3.5));
  scene.cameras[0].up = glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F));
  scene.cameras[0].vertical_fov_degrees = random.real_f(40, 90);
  Light& light = scene.lights[0];
  light.kind = random.pick({LightKind::point, LightKind::point, LightKind::spot, LightKind::directional});
  light.direction = glm::normalize(-light.position + somewhere(random, 0.5));
  light.spot_degrees = random.real_f(60, 120);
  if (kind == Kind::closed && light.kind != LightKind::directional) {
    add_box(scene, "room", glm::vec3(-4.0F), glm::vec3(4.0F));
    for (glm::uvec3& t : scene.triangles) std::swap(t.y, t.z);
  } else if (kind == Kind::open) {
    add_quad(scene, "floor", {{{-5, -2, 5}, {5, -2, 5}, {5, -2, -5}, {-5, -2, -5}}});
  }
  const int objects = random.between(2, 5);
  for (int i = 0; i < objects; ++i) {
    const std::size_t first = scene.positions.size();
    const glm::vec3 place = somewhere(random, 2.0);
    if (kind == Kind::open && random.one_in(2)) {
      // Triangles without order or common winding, some of which share edges.
      std::vector<glm::vec3> positions;
      std::vector<glm::uvec3> triangles;
      for (int v = 0; v < 7; ++v) positions.push_back(somewhere(random, 1.2));
      for (int t = 0; t < 6; ++t) {
        const int a = random.below(7);
        triangles.emplace_back(a, (a + random.between(1, 3)) % 7, (a + random.between(4, 6)) % 7);
      }
      add_object(scene, positions, triangles);
    } else if (random.one_in(2)) {
      add_ball(scene, glm::vec3(0.0F), 1.0F, random.between(2, 5));
      if (kind == Kind::open && random.one_in(2)) {  // with a hole
        scene.triangles.pop_back();
        scene.triangle_object.pop_back();
        scene.triangle_material.pop_back();
        --scene.objects.back().triangle_count;
      }
    } else {
      add_box(scene, "box", glm::vec3(-1.0F), glm::vec3(1.0F));
    }
    toss(random, scene, first, place);
  }
  return scene;
}

// Whether a light shines from within an object that is closed outward: what is inside of it is no room.
bool is_inside_an_object(const Scene& scene, const glm::vec3& point) {
  for (const SceneObject& object : scene.objects) {
    if (winding_number(scene, object, point) > 0.4) return true;
  }
  return false;
}

void expect_as_rays(Kind kind, std::uint64_t seed, int scenes) {
  int drawn = 0, directional = 0, spot = 0;
  Compared sum;
  for (std::uint64_t index = 0; drawn < scenes; ++index) {
    Random random(seed, index);
    const Scene scene = random_scene(random, kind);
    const Light& light = scene.lights[0];
    const bool has_place = light.kind != LightKind::directional;
    if (has_place && is_inside_an_object(scene, light.position)) continue;
    if (is_inside_an_object(scene, scene.cameras[0].position)) continue;
    ++drawn;
    directional += has_place ? 0 : 1;
    spot += light.kind == LightKind::spot ? 1 : 0;
    RenderSettings settings = volume_settings();
    settings.width = 80;
    settings.height = 60;
    settings.shadow_volume.two_sided = random.one_in(2);
    const Rendering rendering = render_volumes(scene, settings);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(rendering, "open_objects") > 0, kind == Kind::open) << index;
    const Compared c = compare_with_rays(scene, settings, rendering);
    EXPECT_EQ(c.wrong, 0) << "scene " << index << ": " << c.first_wrong << ", light " << static_cast<int>(light.kind);
    sum.lit += c.lit;
    sum.shadowed += c.shadowed;
    sum.skipped += c.skipped;
  }
  EXPECT_GE(directional, 1);
  EXPECT_GE(spot, 1);
  EXPECT_GT(sum.lit, scenes * 500);
  EXPECT_GT(sum.shadowed, scenes * 500);
  EXPECT_LT(sum.skipped, scenes * 4800 / 3);
}

TEST(VolumeRandom, ClosedObjectsAreAsRaysSay) {
  expect_as_rays(Kind::closed, 0x5010, 20);
}

TEST(VolumeRandom, OpenObjectsAreAsRaysSay) {
  expect_as_rays(Kind::open, 0x5011, 20);
}

// From outside of all volumes, both methods count the same, in one pass or two, in any number of threads.
TEST(VolumeRandom, MethodsAgreeToTheBit) {
  int drawn = 0, shadowed = 0;
  for (std::uint64_t index = 0; drawn < 25; ++index) {
    Random random(0x5012, index);
    Scene scene = random_scene(random, random.one_in(2) ? Kind::closed : Kind::open);
    scene.cameras[0].position *= 4.0F;
    const Light& light = scene.lights[0];
    const bool has_place = light.kind != LightKind::directional;
    const glm::dvec3 eye(scene.cameras[0].position);
    const glm::dvec3 source = has_place ? glm::dvec3(light.position) : eye - glm::dvec3(light.direction) * 100.0;
    RenderSettings settings = volume_settings();
    // No volume may reach into the view before its near plane.
    const glm::mat4 projection = infinite_camera_projection(scene, scene.cameras[0], 4.0F / 3.0F);
    const double near_plane = static_cast<double>(projection[3][3] - projection[3][2]) / 2;
    const Rays rays(scene);
    bool is_outside = true;
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 ray = rays.direction(settings, random.real(0, settings.width), random.real(0, settings.height));
      is_outside = is_outside && rays.between(source, eye + ray * (near_plane * random.real(0, 1.01))) == 0;
    }
    // (The pyramid of a spot light is cut by that plane as well.)
    if (!is_outside || light.kind == LightKind::spot) continue;
    ++drawn;
    const Rendering first = render_volumes(scene, settings);
    shadowed += static_cast<int>(first.shadowed);
    for (const VolumeMethod method : {VolumeMethod::depth_fail, VolumeMethod::depth_pass}) {
      for (const bool two_sided : {true, false}) {
        settings.shadow_volume = {method, two_sided};
        const int threads = random.between(1, 4);
        test::with_threads(threads, [&] {
          const Rendering again = render_volumes(scene, settings);
          EXPECT_EQ(again.frame.stencil(), first.frame.stencil()) << index;
          EXPECT_EQ(again.frame.color(0), first.frame.color(0)) << index;
        });
      }
    }
  }
  EXPECT_GT(shadowed, 4000);
}

}  // namespace
