// The light's view of a scene: positions in its shadow map.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/scene/scene.h"

namespace ninebit {

// The map's resolution at a point: world units per texel across the light's axis, and per step of the depth codes along
// it.
struct MapResolution {
  double texel_size;
  double depth_step;
};

// A spot or directional light's beam.
class LightBeam {
 public:
  // The scene has triangles.
  LightBeam(const Scene& scene, const Light& light);

  // World space to the map's clip space.
  [[nodiscard]] const glm::mat4& projection() const { return projection_; }

  // One entry per position: (s, t, r) and q of the map, where inside the beam s/q, t/q and r/q are from 0 to 1 and q is
  // positive; and a direction whose major axis is +z only inside the beam.
  struct Coordinates {
    std::vector<glm::vec3> str;
    std::vector<float> q;
    std::vector<glm::vec3> direction;
  };
  [[nodiscard]] Coordinates coordinates(std::span<const glm::vec3> positions) const;

  // At the middle of the scene's bounding box, or on the near plane if the middle lies in front of it.
  [[nodiscard]] MapResolution resolution(int map_size, std::uint32_t depth_codes) const;

  // Whether a triangle's front faces the light.
  [[nodiscard]] bool lights_front(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const;

 private:
  Light light_;
  glm::mat4 projection_;
  glm::vec3 middle_;
};

}  // namespace ninebit
