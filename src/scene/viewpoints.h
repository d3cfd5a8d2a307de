// The cameras and lights of a file, before they are added to its scene.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

struct Viewpoints {
  std::vector<Camera> cameras;  // perspective ones only
  std::vector<Light> lights;    // directions not yet of unit length
};

// Adds the cameras and lights to a scene, which has its triangles: transformed by `place`, with unit directions and
// colours whose largest channel is 1. Returns a fault for values that are not finite and for missing directions.
[[nodiscard]] std::optional<Diagnostic> add_viewpoints(const Viewpoints& viewpoints, const glm::dmat4& place,
                                                       Scene& scene);

// Moves the cameras' look-at points along their axes to beside the scene's middle, for files that only give a
// direction.
void move_look_at_points(Scene& scene);

}  // namespace ninebit
