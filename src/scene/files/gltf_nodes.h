// The node hierarchy of a glTF file: its placed meshes, and its cameras and lights in world space.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "src/scene/files/json_value.h"
#include "src/scene/framing.h"

namespace ninebit {

// A mesh as a node places it.
struct GltfPlacement {
  std::uint64_t node = 0;
  std::uint64_t mesh = 0;
  glm::dmat4 world{1.0};
};

struct GltfNodes {
  std::vector<GltfPlacement> placements;  // in depth-first order: a node, then its children
  Viewpoints viewpoints;
};

// Reads the file's scene: placed meshes; perspective cameras with the file's vertical angle and look-at points one unit
// ahead; KHR_lights_punctual lights.
[[nodiscard]] Result<GltfNodes> read_gltf_nodes(const JsonValue& root);

}  // namespace ninebit
