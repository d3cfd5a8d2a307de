#include "combiner_tests/shadow/shadow_map_support.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace shadow_test {

using ninebit::Light;
using ninebit::LightKind;
using ninebit::Scene;

Light spot_light(const glm::vec3& position, const glm::vec3& target, float degrees) {
  return {.name = "spot",
          .position = position,
          .kind = LightKind::spot,
          .direction = glm::normalize(target - position),
          .spot_degrees = degrees};
}

Light directional_light(const glm::vec3& direction) {
  return {.name = "sun", .kind = LightKind::directional, .direction = glm::normalize(direction)};
}

ninebit::Rendering render_map(const Scene& scene, const ninebit::RenderSettings& settings) {
  return render_by("shadow-map", scene, settings);
}

namespace {

const glm::dvec3 kLow(-0.1, 0.0, -0.8), kHigh(0.1, 1.2, 0.8);  // the wall
constexpr float kFloor = 4.0F;                                 // half a side

struct Ray {
  glm::dvec3 origin, direction;
};

// Where a ray enters and leaves the wall's box; empty where it misses it.
std::optional<std::pair<double, double>> through_wall(const Ray& ray) {
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  for (int k = 0; k < 3; ++k) {
    const double a = (kLow[k] - ray.origin[k]) / ray.direction[k], b = (kHigh[k] - ray.origin[k]) / ray.direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter < leave)) return std::nullopt;
  return std::pair{enter, leave};
}

// Through window position (x, y).
Ray camera_ray(const ninebit::Camera& camera, const ninebit::RenderSettings& settings, double x, double y) {
  const glm::dvec3 eye(camera.position), forward = glm::normalize(glm::dvec3(camera.look_at) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
  const glm::dvec3 up = glm::cross(right, forward);
  const double tangent = std::tan(camera.vertical_fov_degrees * 3.14159265358979323846 / 360.0);
  const double across = (2.0 * x - settings.width) / settings.height;
  const double upward = (2.0 * y - settings.height) / settings.height;
  return {eye, forward + tangent * (across * right + upward * up)};
}

struct Hit {
  glm::dvec3 point;
  int axis = 1;       // that the surface stands across
  double sign = 1.0;  // of its outward normal along it
  bool wall = false;
};

std::optional<Hit> hit_of(const Ray& ray) {
  if (const auto wall = through_wall(ray); wall && wall->first > 0.0) {
    Hit hit{.point = ray.origin + wall->first * ray.direction, .wall = true};
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      for (const double side : {kLow[k], kHigh[k]}) {
        if (std::fabs(hit.point[k] - side) >= nearest) continue;
        nearest = std::fabs(hit.point[k] - side);
        hit.axis = k;
        hit.sign = side == kHigh[k] ? 1.0 : -1.0;
      }
    }
    return hit;
  }
  const double t = -ray.origin.y / ray.direction.y;
  const glm::dvec3 p = ray.origin + t * ray.direction;
  if (t < 0.0 || std::fabs(p.x) > kFloor || std::fabs(p.z) > kFloor) return std::nullopt;
  return Hit{.point = p};
}

// (The pyramid stands upright in this scene: see views.h.)
bool in_beam(const Light& light, const glm::dvec3& p) {
  const glm::dvec3 axis(light.direction), to(p - glm::dvec3(light.position));
  const glm::dvec3 right = glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0))), up = glm::cross(right, axis);
  const double reach = glm::dot(to, axis) * std::tan(light.spot_degrees * 3.14159265358979323846 / 360.0);
  return reach > 0.0 && std::fabs(glm::dot(to, right)) < reach && std::fabs(glm::dot(to, up)) < reach;
}

// Whether light arrives at a point outside of the wall.
bool arrives(const Light& light, const glm::dvec3& p) {
  if (!in_beam(light, p)) return false;
  const auto wall = through_wall({p, glm::dvec3(light.position) - p});
  return !wall || wall->second < 0.0 || wall->first > 1.0;
}

// The same at a point of the same surface as the hit, which does not shade itself by rounding.
bool arrives(const Light& light, const Hit& hit, const glm::dvec3& p) {
  if (!hit.wall) return arrives(light, p);
  return in_beam(light, p) && hit.sign * (static_cast<double>(light.position[hit.axis]) - p[hit.axis]) > 0.0;
}

// The surface at the pixel's centre, if snapping cannot make it show another one.
std::optional<Hit> hit_of_pixel(const ninebit::Camera& camera, const ninebit::RenderSettings& settings, int x, int y) {
  const auto hit_at = [&](double dx, double dy) { return hit_of(camera_ray(camera, settings, x + dx, y + dy)); };
  const auto hit = hit_at(0.5, 0.5);
  for (const double dx : {0.3, 0.7}) {
    for (const double dy : {0.3, 0.7}) {
      const auto beside = hit_at(dx, dy);
      if (!hit || !beside || beside->wall != hit->wall || beside->axis != hit->axis) return std::nullopt;
    }
  }
  return hit;
}

bool on_surface(const Hit& hit, const glm::dvec3& p) {
  if (!hit.wall) return std::fabs(p.x) < kFloor && std::fabs(p.z) < kFloor;
  for (int k = 0; k < 3; ++k) {
    if (k != hit.axis && (p[k] < kLow[k] || p[k] > kHigh[k])) return false;
  }
  return true;
}

}  // namespace

Scene wall_on_floor() {
  Scene scene = scene_with({3.4F, 2.2F, 2.4F}, {0.4F, 0.4F, 0.0F}, {});
  scene.lights[0] = spot_light({-3.0F, 3.0F, 0.7F}, {0.2F, 0.4F, 0.0F}, 60.0F);
  add_quad(scene, "floor", {{{-kFloor, 0, kFloor}, {kFloor, 0, kFloor}, {kFloor, 0, -kFloor}, {-kFloor, 0, -kFloor}}});
  add_box(scene, "wall", glm::vec3(kLow), glm::vec3(kHigh));
  return scene;
}

WallErrors wall_errors(const Scene& scene, const ninebit::RenderSettings& settings, const ninebit::Rendering& rendering,
                       double margin) {
  const Light& light = scene.lights[0];
  WallErrors errors;
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      const auto hit = hit_of_pixel(scene.cameras[0], settings, x, y);
      if (!hit) continue;
      const bool lit = arrives(light, *hit, hit->point);
      // A surface that the light grazes lies within a texel of its own outline.
      glm::dvec3 above = hit->point;
      above[hit->axis] += margin * hit->sign;
      bool certain = arrives(light, above) == lit;
      for (int u = -1; u <= 1; ++u) {
        for (int v = -1; v <= 1; ++v) {
          glm::dvec3 p = hit->point;
          p[(hit->axis + 1) % 3] += margin * u;
          p[(hit->axis + 2) % 3] += margin * v;
          // A point of the floor beneath the wall is in the dark as the floor beside it is.
          certain = certain && on_surface(*hit, p) && arrives(light, *hit, p) == lit;
        }
      }
      if (!certain) continue;
      const bool drawn_lit =
          rendering.frame.stencil()[static_cast<std::size_t>(y) * static_cast<std::size_t>(settings.width) +
                                    static_cast<std::size_t>(x)] == 0;
      ++(lit ? errors.judged_lit : errors.judged_shadowed);
      if (lit && !drawn_lit) ++errors.acne;
      if (!lit && drawn_lit) ++errors.leaks;
    }
  }
  return errors;
}

}  // namespace shadow_test
