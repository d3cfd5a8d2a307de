#include "src/frame/views.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>

#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

DepthRange depth_range(const Scene& scene, const glm::vec3& eye, float cos_corner) {
  const Bounds bounds = bounds_of(scene);
  const glm::vec3 farthest = glm::max(glm::abs(bounds.low - eye), glm::abs(bounds.high - eye));
  // A scene that is one point at the eye has no extent: any positive range works.
  const float far_plane = std::max(glm::length(farthest) * 1.01F, 1e-6F);
  const float nearest = std::min(distance_to_nearest_triangle(scene, eye), far_plane);
  return {std::max(nearest * cos_corner * 0.9F, far_plane / 65536.0F), far_plane};
}

namespace {

DepthRange camera_range(const Scene& scene, const Camera& camera, float aspect_ratio) {
  const float half_height = std::tan(glm::radians(camera.vertical_fov_degrees) * 0.5F);
  const float half_width = half_height * aspect_ratio;
  const float cos_corner = 1.0F / std::sqrt(1.0F + half_height * half_height + half_width * half_width);
  return depth_range(scene, camera.position, cos_corner);
}

}  // namespace

glm::mat4 camera_projection(const Scene& scene, const Camera& camera, float aspect_ratio) {
  const DepthRange range = camera_range(scene, camera, aspect_ratio);
  const glm::mat4 projection =
      glm::perspective(glm::radians(camera.vertical_fov_degrees), aspect_ratio, range.near_plane, range.far_plane);
  return projection * glm::lookAt(camera.position, camera.look_at, camera.up);
}

glm::mat4 infinite_camera_projection(const Scene& scene, const Camera& camera, float aspect_ratio) {
  glm::mat4 m = camera_projection(scene, camera, aspect_ratio);
  for (int column = 0; column < 4; ++column) m[column][2] = m[column][3];
  m[3][2] -= 2.0F * camera_range(scene, camera, aspect_ratio).near_plane;
  return m;
}

namespace {

// The view matrix along a direction of unit length. Its y points toward a coordinate axis that is not parallel to it.
glm::mat4 view_along(const glm::vec3& eye, const glm::vec3& direction) {
  const glm::vec3 size = glm::abs(direction);
  const glm::vec3 axis =
      size.y <= size.x || size.y <= size.z ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F);
  const glm::vec3 right = glm::normalize(glm::cross(direction, axis)), up = glm::cross(right, direction);
  glm::mat4 m(1.0F);
  const auto set_row = [&](int row, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) m[i][row] = v[i];
    m[3][row] = -glm::dot(v, eye);
  };
  set_row(0, right);
  set_row(1, up);
  set_row(2, -direction);
  return m;
}

}  // namespace

glm::mat4 light_projection(const Scene& scene, const Light& light) {
  if (light.kind == LightKind::spot) {
    const float half = std::tan(glm::radians(light.spot_degrees) * 0.5F);
    const DepthRange range = depth_range(scene, light.position, 1.0F / std::sqrt(1.0F + 2.0F * half * half));
    return glm::perspective(glm::radians(light.spot_degrees), 1.0F, range.near_plane, range.far_plane) *
           view_along(light.position, light.direction);
  }
  const Bounds bounds = bounds_of(scene);
  const float radius = std::max(bounds.diagonal() * 0.5F * 1.01F, 1e-6F);
  return glm::ortho(-radius, radius, -radius, radius, 0.0F, 2.0F * radius) *
         view_along(bounds.center() - light.direction * radius, light.direction);
}

glm::mat4 cube_face_projection(CubeFace face, const DepthRange& range) {
  const CubeFaceAxes& axes = cube_face_axes(face);
  const float n = range.near_plane, f = range.far_plane;
  const auto vector = [](const std::array<int, 3>& a) {
    return glm::vec3(static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2]));
  };
  const glm::vec3 s = vector(axes.s), t = vector(axes.t), major = vector(axes.major);
  glm::mat4 m(0.0F);
  const auto set_row = [&](int row, const glm::vec3& axis, float scale, float offset) {
    for (int i = 0; i < 3; ++i) m[i][row] = axis[i] * scale;
    m[3][row] = offset;
  };
  set_row(0, s, 1.0F, 0.0F);
  set_row(1, t, 1.0F, 0.0F);
  set_row(2, major, (f + n) / (f - n), -2.0F * f * n / (f - n));
  set_row(3, major, 1.0F, 0.0F);
  return m;
}

std::array<glm::mat4, 6> cube_face_projections(const DepthRange& range) {
  std::array<glm::mat4, 6> projections{};
  for (std::size_t i = 0; i < projections.size(); ++i) projections[i] = cube_face_projection(kCubeFaces[i], range);
  return projections;
}

namespace {

// Row `row` of m · (p, 1), in a fixed order.
float row_times(const glm::mat4& m, int row, const glm::vec3& p) {
  return ((m[0][row] * p.x + m[1][row] * p.y) + m[2][row] * p.z) + m[3][row];
}

}  // namespace

glm::mat4 scaled_to_w_buffer(const glm::mat4& projection, std::span<const glm::vec3> positions,
                             DepthStencilFormat format) {
  const DepthStencilLayout& layout = layout_of(format);
  if (!layout.is_w) return projection;
  float largest = 0.0F;
  for (const glm::vec3& p : positions) largest = std::max(largest, row_times(projection, 3, p));
  if (!(largest > 0.0F)) return projection;
  // Numbers below 2^bits fit. A floating-point buffer of 24 bits is as fine everywhere, and holds more than a float.
  const int bits = layout.exponent_bits == 0 ? layout.depth_bits : std::min((1 << layout.exponent_bits) / 2 + 1, 24);
  return projection * std::ldexp(1.0F, bits - 1 - std::ilogb(largest));
}

LightBeam::LightBeam(const Scene& scene, const Light& light)
    : light_(light), projection_(light_projection(scene, light)), middle_(bounds_of(scene).center()) {}

LightBeam::Coordinates LightBeam::coordinates(std::span<const glm::vec3> positions) const {
  Coordinates out;
  out.str.resize(positions.size());
  out.q.resize(positions.size());
  out.direction.resize(positions.size());
  parallel_for(positions.size(), kGrainOfCheapItems, [&](std::size_t i) {
    const float x = row_times(projection_, 0, positions[i]), y = row_times(projection_, 1, positions[i]),
                z = row_times(projection_, 2, positions[i]), w = row_times(projection_, 3, positions[i]);
    out.str[i] = {0.5F * x + 0.5F * w, 0.5F * y + 0.5F * w, 0.5F * z + 0.5F * w};
    out.q[i] = w;
    out.direction[i] = {x, y, w};
  });
  return out;
}

MapResolution LightBeam::resolution(int map_size, std::uint32_t depth_codes) const {
  const glm::dmat4 m(projection_);
  const glm::dvec3 axis(light_.direction);
  const auto gradient = [&](int row) { return glm::dvec3(m[0][row], m[1][row], m[2][row]); };
  const auto value = [&](int row, const glm::dvec3& p) { return glm::dot(gradient(row), p) + m[3][row]; };
  glm::dvec3 p(middle_);
  // Along the axis z + w is linear, and it is 0 at the near plane. The far plane lies behind the whole scene.
  const double near_slope = glm::dot(gradient(2) + gradient(3), axis);
  const double to_near = -(value(2, p) + value(3, p)) / near_slope;
  if (to_near > 0.0) p += axis * to_near;
  const double z = value(2, p), w = value(3, p);
  // Window depth is (z/w + 1) / 2.
  const double depth_per_unit = 0.5 * (glm::dot(gradient(2), axis) * w - z * glm::dot(gradient(3), axis)) / (w * w);
  return {.texel_size = 2.0 * w / (glm::length(gradient(0)) * map_size),
          .depth_step = 1.0 / (depth_per_unit * static_cast<double>(depth_codes))};
}

bool LightBeam::lights_front(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const {
  const glm::vec3 to_light = light_.kind == LightKind::directional ? -light_.direction : light_.position - a;
  return glm::dot(glm::cross(b - a, c - a), to_light) > 0.0F;
}

}  // namespace ninebit
