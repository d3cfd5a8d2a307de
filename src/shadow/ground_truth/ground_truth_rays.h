// The triangles between a point and the light. Boxes give candidates; crossing() decides, in doubles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "ninebit/scene/scene.h"
#include "ninebit/shadow/ground_truth.h"

namespace ninebit {

// The geometry of ground truth, in doubles and in a fixed order of operations: the point that a pixel shows, and the
// triangles between it and the light.

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

struct RayCrossing {
  std::uint32_t triangle;
  double at;  // along the ray, as crossing() returns it
};

// The decision about the candidates of one ray.
class CandidateTest {
 public:
  // `own`: the triangle where the ray begins, which is left out. `all` collects the crossed triangles; nullptr: the
  // first one ends the search. The references must outlive it.
  CandidateTest(const GroundTruthScene::Rays& rays, const LightRay& ray, std::uint32_t own,
                std::vector<RayCrossing>* all)
      : rays_(rays), ray_(ray), own_(own), all_(all) {}

  // Returns whether the search can end.
  bool take(std::uint32_t triangle);

 private:
  const GroundTruthScene::Rays& rays_;
  const LightRay& ray_;
  std::uint32_t own_;
  std::vector<RayCrossing>* all_;
};

// Finds candidates: the triangles whose boxes a ray passes through.
class BoxSearch {
 public:
  virtual ~BoxSearch() = default;
  // Offers each candidate to the test, in any order, until the test ends the search. Returns whether it did. Boxes that
  // the ray misses may be among the candidates.
  [[nodiscard]] virtual bool search(const LightRay& ray, CandidateTest& test) const = 0;
};

struct GroundTruthScene::Rays {
  // The scene must outlive it.
  Rays(const Scene& judged, std::unique_ptr<BoxSearch> search);

  // Whether any triangle but `own` lies on the way to the light.
  [[nodiscard]] bool blocked(const LightRay& ray, std::uint32_t own) const;
  // All of them, by number.
  void find_all(const LightRay& ray, std::uint32_t own, std::vector<RayCrossing>& crossed) const;

  const Scene* scene;
  double touching;  // touching_distance
  std::unique_ptr<BoxSearch> boxes;
};

// By how much the box of a triangle is larger than the triangle, on each side. Where a caster turns a ray into floats,
// origin and direction are each rounded by half a unit in the last place; across the scene the direction moves it by as
// much again.
[[nodiscard]] inline double box_margin(const Scene& scene) {
  return 8.0 * touching_distance(scene);
}

struct TriangleBox {
  glm::vec3 low, high;
};
// The box of a triangle, enlarged by `margin`.
[[nodiscard]] TriangleBox box_of(const Scene& scene, std::uint32_t triangle, double margin);

// Reports a scene that cannot be judged.
[[nodiscard]] Status check_judged(const Scene& scene);

}  // namespace ninebit
