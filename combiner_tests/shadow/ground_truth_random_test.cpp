// Each pixel's truth, against every triangle tried in turn by another formula and in longer numbers.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "combiner_tests/shadow/ground_truth_support.h"

namespace shadow_test {
namespace {

using namespace ninebit;
using Real = long double;
using Vec = glm::vec<3, Real>;

constexpr Real kNear = 1e-5L;  // fractions: what is nearer to an edge or an end is left to either side

// Where origin + t * way meets a triangle, solved for t and two edges; empty if it passes beside it.
struct Hit {
  Real t;
  bool near_edge;
};
std::optional<Hit> meet(const Scene& scene, std::uint32_t triangle, const Vec& origin, const Vec& way) {
  const glm::uvec3& n = scene.triangles[triangle];
  const Vec a(scene.positions[n.x]), e1 = Vec(scene.positions[n.y]) - a, e2 = Vec(scene.positions[n.z]) - a;
  const Vec p = glm::cross(way, e2), s = origin - a, q = glm::cross(s, e1);
  const Real det = glm::dot(e1, p);
  if (det == 0) return std::nullopt;
  const Real u = glm::dot(s, p) / det, v = glm::dot(way, q) / det, least = std::min({u, v, 1 - u - v});
  if (least < -kNear) return std::nullopt;
  return Hit{glm::dot(e2, q) / det, least < kNear};
}

// Whether the light reaches a point; empty where that is decided within kNear.
std::optional<bool> is_shadowed(const Scene& scene, std::uint32_t own, const Vec& point) {
  const Light& light = scene.lights[0];
  const bool endless = light.kind == LightKind::directional;
  const Vec way = endless ? -Vec(light.direction) : Vec(light.position) - point;
  bool doubtful = false;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (t == own) continue;
    const auto met = meet(scene, t, point, way);
    if (!met || met->t < -kNear || (!endless && met->t > 1 + kNear)) continue;
    const bool near_end = met->t < kNear || (!endless && met->t > 1 - kNear);
    if (!met->near_edge && !near_end) return true;
    doubtful = true;
  }
  if (doubtful) return std::nullopt;
  return false;
}

Scene random_scene(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24F;
  };
  const auto point = [&](float reach) {
    const float x = number(-reach, reach), y = number(-reach, reach);
    return glm::vec3(x, y, number(-reach, reach));
  };
  Scene scene = scene_with(point(1.0F) + glm::vec3(0.0F, 1.0F, 6.0F), point(0.5F), point(4.0F));
  Light& light = scene.lights[0];
  light.kind = seed % 2 == 0 ? LightKind::point : LightKind::directional;
  light.direction = glm::normalize(point(1.0F) + glm::vec3(0.1F));
  const std::uint32_t triangles = 20 + 2 * seed;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const glm::vec3 middle = point(2.0F);
    for (int k = 0; k < 3; ++k) scene.positions.push_back(middle + point(0.4F + 0.1F * static_cast<float>(t % 12)));
    scene.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
  }
  scene.normals.assign(scene.positions.size(), glm::vec3(0.0F));
  scene.objects.push_back({"soup", 0, triangles});
  scene.triangle_object.assign(triangles, 0);
  scene.triangle_material.assign(triangles, 0);
  return scene;
}

TEST(GroundTruth, EveryTriangleTriedInTurn) {
  std::array<int, 3> seen{};
  for (unsigned seed = 1; seed <= 24; ++seed) {
    const Scene scene = random_scene(seed);
    const RenderSettings settings = judged_settings(80, 60);
    const Rendering r = all_lit(scene, settings);
    const GroundTruth truth = judged(scene, settings, r);
    const Camera& camera = scene.cameras[0];
    const Vec eye(camera.position), forward = glm::normalize(Vec(camera.look_at) - eye);
    const Vec right = glm::normalize(glm::cross(forward, Vec(camera.up))), up = glm::cross(right, forward);
    const Real tangent = std::tan(camera.vertical_fov_degrees * 3.14159265358979323846L / 360.0L);
    for_each_pixel(settings, [&](int x, int y, std::size_t i) {
      const std::uint32_t own = r.frame.primitive()[i];
      if (own == 0xFFFFFFFF) {
        EXPECT_EQ(truth.truth[i], PixelTruth::background);
        return;
      }
      const Real sx = ((x + 0.5L) / settings.width * 2 - 1) * tangent * settings.width / settings.height;
      const Real sy = ((y + 0.5L) / settings.height * 2 - 1) * tangent;
      const Vec way = forward + right * sx + up * sy;
      const auto met = meet(scene, own, eye, way);
      const auto shadowed = met ? is_shadowed(scene, own, eye + way * met->t) : std::nullopt;
      ++seen[!shadowed ? 2 : *shadowed ? 1 : 0];
      if (!shadowed) return;
      EXPECT_EQ(truth.truth[i], *shadowed ? PixelTruth::shadowed : PixelTruth::lit)
          << "seed " << seed << ", pixel " << x << "," << y;
    });
  }
  EXPECT_GT(seen[0], 10000);
  EXPECT_GT(seen[1], 5000);
  EXPECT_LT(seen[2], (seen[0] + seen[1]) / 50) << "most pixels should be told";
}

}  // namespace
}  // namespace shadow_test
