// The geometry of ground truth, in doubles and in a fixed order of operations: the point that a pixel shows, and the
// triangles between it and the light.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "ninebit/scene/scene.h"

namespace ninebit {

struct Corners {
  glm::dvec3 a, b, c;
};
[[nodiscard]] inline Corners corners_of(const Scene& scene, std::uint32_t triangle) {
  const glm::uvec3& t = scene.triangles[triangle];
  return {scene.positions[t.x], scene.positions[t.y], scene.positions[t.z]};
}

// The rays of a camera through the centres of pixels.
class PixelRays {
 public:
  PixelRays(const Camera& camera, int width, int height);

  // The point of a triangle that pixel (x, y), y up, shows: where its ray intersects the triangle or, if it misses, the
  // triangle's point nearest to the ray.
  [[nodiscard]] glm::dvec3 point_on(const Corners& triangle, int x, int y) const;

 private:
  glm::dvec3 eye_, forward_, across_, up_;  // `across_` and `up_` reach from the picture's middle to its sides
  int width_, height_;
};

// A ray from a point to the light, or without end toward a directional light.
struct LightRay {
  glm::dvec3 from{0.0};
  glm::dvec3 way{0.0};  // to the light; for a directional light a unit vector
  bool endless = false;
};
[[nodiscard]] LightRay light_ray(const Light& light, const glm::dvec3& from);

// Where along the ray (0 to 1; endless: in units of length) it passes through a triangle, edges included. Empty if it
// misses, if either end of the ray is nearer to the triangle's plane than `touching`, or if an endless ray runs in the
// plane.
[[nodiscard]] std::optional<double> crossing(const LightRay& ray, const Corners& triangle, double touching);

// The distance within which points touch: four units in the last place of a float at the size of the scene's largest
// coordinate.
[[nodiscard]] double touching_distance(const Scene& scene);

// Whether a point is in the square pyramid that a spot light shines through.
[[nodiscard]] bool in_spot(const glm::dmat4& light_projection, const glm::dvec3& point);

// Whether two different triangles belong to the same object and have a corner's position in common.
[[nodiscard]] bool are_neighbours(const Scene& scene, std::uint32_t first, std::uint32_t second);

}  // namespace ninebit
