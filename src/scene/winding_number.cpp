#include <cmath>
#include <numbers>

#include "ninebit/scene/scene.h"

namespace ninebit {
namespace {

// Half the signed solid angle that a triangle fills, seen from the origin: positive if its back is seen. After A. van
// Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", IEEE Transactions on Biomedical Engineering 30 (2),
// 1983.
double half_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  // Larger than the rounding error of a triple product of zero, and too small to affect the sum noticeably.
  constexpr double kInPlane = 1e-14;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double triple = glm::dot(a, glm::cross(b, c));
  const double lengths = la * lb * lc;
  // Edge-on, degenerate, or touching the origin, where an atan2 of +-0 and a negative number would be +-pi.
  if (!(std::abs(triple) > kInPlane * lengths)) return 0.0;
  return std::atan2(triple, lengths + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

}  // namespace

double winding_number(const Scene& scene, const SceneObject& object, const glm::vec3& point) {
  const glm::dvec3 from(point);
  double sum = 0.0;
  for (std::size_t i = 0; i < object.triangle_count; ++i) {
    const glm::uvec3& t = scene.triangles[object.first_triangle + i];
    sum += half_solid_angle(glm::dvec3(scene.positions[t.x]) - from, glm::dvec3(scene.positions[t.y]) - from,
                            glm::dvec3(scene.positions[t.z]) - from);
  }
  return sum / (2.0 * std::numbers::pi);
}

}  // namespace ninebit
