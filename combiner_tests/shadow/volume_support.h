// Scenes for shadow volumes, and rays that say what is in shadow.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "combiner_tests/shadow/support.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/shadow_volume.h"

namespace shadow_test {

// Small, without layers.
ninebit::RenderSettings volume_settings(ninebit::VolumeMethod method = ninebit::VolumeMethod::depth_fail);

// Renders, failing the test where that fails.
ninebit::Rendering render_volumes(const ninebit::Scene& scene, const ninebit::RenderSettings& settings);

// Adds a closed ball of rings × 2 rings quads, cut into triangles; `inward` turns its faces to the middle. Vertices at
// its seam and poles are there several times, as with normals of their own.
void add_ball(ninebit::Scene& scene, const glm::vec3& middle, float radius, int rings, bool inward = false);

// Adds triangles as one object.
void add_object(ninebit::Scene& scene, const std::vector<glm::vec3>& positions,
                const std::vector<glm::uvec3>& triangles);

// A scene's triangles, hit by rays in doubles.
class Rays {
 public:
  explicit Rays(const ninebit::Scene& scene);

  struct Hit {
    std::size_t triangle;
    double distance;  // in lengths of `direction`
  };
  // The nearest triangle along a ray.
  [[nodiscard]] std::optional<Hit> nearest(const glm::dvec3& origin, const glm::dvec3& direction) const;
  // How many triangles the open segment from a to b meets.
  [[nodiscard]] int between(const glm::dvec3& a, const glm::dvec3& b) const;

  // The ray through a window position of the scene's camera, of length 1 along the view axis.
  [[nodiscard]] glm::dvec3 direction(const ninebit::RenderSettings& settings, double x, double y) const;

 private:
  [[nodiscard]] std::optional<double> meets(std::size_t triangle, const glm::dvec3& origin,
                                            const glm::dvec3& direction) const;
  const ninebit::Scene* scene_;
  struct Triangle {
    glm::dvec3 a, ab, ac;  // a corner, and the two edges there
  };
  std::vector<Triangle> triangles_;
};

// The surface that a camera's pixel should show, and whether that is beyond doubt.
enum class Seen { background, lit, shadowed, near_a_border };

// The answer of rays from the eye, then from what they meet to the light (or, of a directional one, from far away).
// Near a border is what looks different anywhere in the pixel.
Seen seen_at(const Rays& rays, const ninebit::Scene& scene, const ninebit::RenderSettings& settings, int x, int y);

// Compares every pixel that is not near a border; returns how many lit and shadowed ones there were.
struct Compared {
  int lit = 0, shadowed = 0, background = 0, skipped = 0, wrong = 0;
  std::string first_wrong;
};
Compared compare_with_rays(const ninebit::Scene& scene, const ninebit::RenderSettings& settings,
                           const ninebit::Rendering& rendering);

}  // namespace shadow_test
