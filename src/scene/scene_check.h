// Checks of scenes, before and after complete_scene changes them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

[[nodiscard]] inline Diagnostic invalid(std::string message) {
  return {std::move(message), "", 0, Fault::invalid_input};
}

[[nodiscard]] bool is_finite(const glm::vec3& v);

// validate() without cameras and lights, which may still be replaced.
[[nodiscard]] Status validate_geometry(const Scene& scene);

// Reports a point with a coordinate outside of -1e12 to 1e12, where squares, triple products and their sums might not
// be finite in floats. `what` begins the message: "the camera".
[[nodiscard]] Status check_range(const std::string& what, const glm::vec3& at);

// The same for the vertices from `first_vertex` on; `what` is subject and verb, "the floor is".
[[nodiscard]] Status check_positions(const Scene& scene, std::size_t first_vertex, const std::string& what);

// Reports a light inside a solid that the camera is outside of. A light within 1e-6 of the object's diagonal from its
// surface counts as on the surface, which is in the open.
[[nodiscard]] Status check_light_in_the_open(const Scene& scene, const Light& light, const Camera& camera);

// Diagnostics for faults of a scene file; the reader adds the file's name.

inline Diagnostic fault_of(std::string message) {
  return {std::move(message), "", 0, Fault::invalid_input};
}

}  // namespace ninebit
