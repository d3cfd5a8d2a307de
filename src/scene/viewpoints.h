// The cameras and lights of a file, on their way into its scene.
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

// Puts them into a scene that has its triangles: at `place`, directions of unit length, colours with their largest
// channel as 1. Reports what is not finite and what has no direction.
[[nodiscard]] std::optional<Diagnostic> add_viewpoints(const Viewpoints& viewpoints, const glm::dmat4& place,
                                                       Scene& scene);

// Moves the cameras' look-at points along their axes to beside the scene's middle, where a file gives but a direction.
void move_look_at_points(Scene& scene);

}  // namespace ninebit
