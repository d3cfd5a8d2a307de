// The triangles between a point and the light. Boxes give candidates; crossing() decides, in doubles.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "src/shadow/ground_truth/ground_truth_geometry.h"

namespace ninebit {

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
