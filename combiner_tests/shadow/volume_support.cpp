#include "combiner_tests/shadow/volume_support.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

namespace shadow_test {

using ninebit::LightKind;
using ninebit::Scene;

ninebit::RenderSettings volume_settings(ninebit::VolumeMethod method) {
  ninebit::RenderSettings settings;
  settings.width = 120;
  settings.height = 90;
  settings.shadow_volume.method = method;
  return settings;
}

ninebit::Rendering render_volumes(const Scene& scene, const ninebit::RenderSettings& settings) {
  return render_by("shadow-volume", scene, settings);
}

void add_object(Scene& scene, const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({"object " + std::to_string(object), static_cast<std::uint32_t>(scene.triangles.size()),
                           static_cast<std::uint32_t>(triangles.size())});
  for (const glm::vec3& p : positions) {
    scene.positions.push_back(p);
    scene.normals.emplace_back(0.0F);
  }
  for (const glm::uvec3& t : triangles) scene.triangles.push_back(t + first);
  scene.triangle_object.insert(scene.triangle_object.end(), triangles.size(), object);
  scene.triangle_material.insert(scene.triangle_material.end(), triangles.size(), 0);
}

void add_ball(Scene& scene, const glm::vec3& middle, float radius, int rings, bool inward) {
  constexpr double kPi = 3.14159265358979323846;
  const int columns = 2 * rings;
  std::vector<glm::vec3> positions;
  for (int row = 0; row <= rings; ++row) {
    for (int column = 0; column <= columns; ++column) {
      // The same numbers at both ends of the seam, and at a pole.
      const double a = column % columns * 2 * kPi / columns, b = row * kPi / rings;
      const double around = row == 0 || row == rings ? 0.0 : std::sin(b);
      const glm::dvec3 p(around * std::cos(a), std::cos(b), around * std::sin(a));
      positions.push_back(middle + radius * glm::vec3(p));
    }
  }
  std::vector<glm::uvec3> triangles;
  const auto add = [&](int a, int b, int c) {
    if (inward) std::swap(b, c);
    triangles.emplace_back(a, b, c);
  };
  for (int row = 0; row < rings; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int a = row * (columns + 1) + column, b = a + columns + 1;
      if (row > 0) add(a, a + 1, b + 1);
      if (row + 1 < rings) add(a, b + 1, b);
    }
  }
  add_object(scene, positions, triangles);
}

Rays::Rays(const Scene& scene) : scene_(&scene) {
  for (const glm::uvec3& t : scene.triangles) {
    const glm::dvec3 a(scene.positions[t.x]);
    triangles_.push_back({a, glm::dvec3(scene.positions[t.y]) - a, glm::dvec3(scene.positions[t.z]) - a});
  }
}

std::optional<double> Rays::meets(std::size_t triangle, const glm::dvec3& origin, const glm::dvec3& direction) const {
  const auto& [a, ab, ac] = triangles_[triangle];
  const glm::dvec3 p = glm::cross(direction, ac), s = origin - a;
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return std::nullopt;
  const double u = glm::dot(s, p) / determinant;
  if (u < 0.0 || u > 1.0) return std::nullopt;
  const glm::dvec3 q = glm::cross(s, ab);
  const double v = glm::dot(direction, q) / determinant;
  if (v < 0.0 || u + v > 1.0) return std::nullopt;
  return glm::dot(ac, q) / determinant;
}

std::optional<Rays::Hit> Rays::nearest(const glm::dvec3& origin, const glm::dvec3& direction) const {
  std::optional<Hit> hit;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto distance = meets(t, origin, direction);
    if (distance && *distance > 0.0 && (!hit || *distance < hit->distance)) hit = Hit{t, *distance};
  }
  return hit;
}

int Rays::between(const glm::dvec3& a, const glm::dvec3& b) const {
  int count = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto distance = meets(t, a, b - a);
    if (distance && *distance > 1e-6 && *distance < 1.0 - 1e-6) ++count;
  }
  return count;
}

glm::dvec3 Rays::direction(const ninebit::RenderSettings& settings, double x, double y) const {
  const ninebit::Camera& camera = scene_->cameras[0];
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.look_at) - glm::dvec3(camera.position));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
  const double tangent = std::tan(camera.vertical_fov_degrees * 3.14159265358979323846 / 360.0);
  return forward + right * ((x / settings.width * 2 - 1) * tangent * settings.width / settings.height) +
         glm::cross(right, forward) * ((y / settings.height * 2 - 1) * tangent);
}

namespace {

// Whether a spot light shines there: within a square pyramid whose sides stand along the rows of the library's view.
bool is_in_pyramid(const ninebit::Light& light, const glm::dvec3& point) {
  const glm::dvec3 d(light.direction), from = point - glm::dvec3(light.position);
  const glm::dvec3 size = glm::abs(d);
  const glm::dvec3 axis = size.y <= size.x || size.y <= size.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::normalize(glm::cross(d, axis)), up = glm::cross(right, d);
  const double reach = glm::dot(from, d) * std::tan(light.spot_degrees * 3.14159265358979323846 / 360.0);
  return reach > 0.0 && std::fabs(glm::dot(from, right)) <= reach && std::fabs(glm::dot(from, up)) <= reach;
}

struct Look {
  Seen seen;
  bool is_grazed;  // the light hardly rises above the surface, or the view does
};

Look look_at(const Rays& rays, const Scene& scene, const glm::dvec3& direction) {
  const glm::dvec3 eye(scene.cameras[0].position);
  const auto hit = rays.nearest(eye, direction);
  if (!hit) return {Seen::background, false};
  const glm::uvec3& t = scene.triangles[hit->triangle];
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a)), point = eye + direction * hit->distance;
  const ninebit::Light& light = scene.lights[0];
  const glm::dvec3 source =
      light.kind == LightKind::directional ? point - glm::dvec3(light.direction) * 1000.0 : glm::dvec3(light.position);
  const double to_light = glm::dot(normal, glm::normalize(source - point));
  const double to_eye = -glm::dot(normal, glm::normalize(direction));
  const bool is_turned_away = (to_light > 0.0) != (to_eye > 0.0);
  const bool is_dark = light.kind == LightKind::spot && !is_in_pyramid(light, point);
  const bool is_shadowed = is_turned_away || is_dark || rays.between(point, source) > 0;
  return {is_shadowed ? Seen::shadowed : Seen::lit, std::fabs(to_light) < 0.05 || std::fabs(to_eye) < 0.05};
}

}  // namespace

Seen seen_at(const Rays& rays, const Scene& scene, const ninebit::RenderSettings& settings, int x, int y) {
  const Look centre = look_at(rays, scene, rays.direction(settings, x + 0.5, y + 0.5));
  if (centre.is_grazed) return Seen::near_a_border;
  for (const double dx : {0.05, 0.275, 0.5, 0.725, 0.95}) {
    for (const double dy : {0.05, 0.275, 0.5, 0.725, 0.95}) {
      const Look look = look_at(rays, scene, rays.direction(settings, x + dx, y + dy));
      if (look.seen != centre.seen || look.is_grazed) return Seen::near_a_border;
    }
  }
  return centre.seen;
}

Compared compare_with_rays(const Scene& scene, const ninebit::RenderSettings& settings,
                           const ninebit::Rendering& rendering) {
  const Rays rays(scene);
  Compared all;
  for_each_pixel(settings, [&](int x, int y, std::size_t at) {
    const Seen expected = seen_at(rays, scene, settings, x, y);
    const bool is_far = rendering.frame.depth()[at] == 0xFFFFFF;
    const Seen found = is_far ? Seen::background : rendering.frame.stencil()[at] == 0 ? Seen::lit : Seen::shadowed;
    if (expected == Seen::near_a_border) {
      ++all.skipped;
      return;
    }
    ++(expected == Seen::lit ? all.lit : expected == Seen::shadowed ? all.shadowed : all.background);
    if (found == expected) return;
    if (all.wrong++ == 0) all.first_wrong = std::to_string(x) + ' ' + std::to_string(y);
  });
  return all;
}

}  // namespace shadow_test
