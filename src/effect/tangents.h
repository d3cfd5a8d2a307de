// Tangents of a mesh from its texture coordinates.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "ninebit/scene/scene.h"

namespace ninebit {

// A tangent per vertex, as glTF has them: xyz has length one, is perpendicular to the normal and points where s grows;
// w × cross(normal, tangent) is the bitangent, which points where t shrinks: up in a picture. The scene's own, where it
// has them, made perpendicular to the normal. Otherwise, Eric Lengyel's method:
// the sum of the triangles' tangents, made perpendicular to the normal. A vertex whose triangles give no tangent gets
// any perpendicular one. The scene must be valid and have texture coordinates.
[[nodiscard]] std::vector<glm::vec4> tangents_of(const Scene& scene);

}  // namespace ninebit
