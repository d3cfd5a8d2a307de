#include "src/frame/light_beam.h"

#include <cmath>
#include <cstdint>

#include "src/frame/views.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// Row `row` of m · (p, 1), in a fixed order.
float row_times(const glm::mat4& m, int row, const glm::vec3& p) {
  return ((m[0][row] * p.x + m[1][row] * p.y) + m[2][row] * p.z) + m[3][row];
}

}  // namespace

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
