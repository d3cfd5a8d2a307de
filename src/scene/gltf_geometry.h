// A glTF file reduced to its geometry.
#pragma once

#include <string>

#include "src/scene/json_value.h"

namespace ninebit {

// The JSON text of the same file with its node hierarchy, triangles, normals and base colours only. Skins, animations,
// morph targets, images and texture coordinates are left out: nothing here uses them, a missing picture must not keep
// a scene from being read, and Assimp does not survive every fault in them.
[[nodiscard]] std::string gltf_geometry(const Json& root);

}  // namespace ninebit
