// The node hierarchy of a glTF file: what it places, and its cameras and lights in world space.
#pragma once

#include "src/scene/file_check.h"
#include "src/scene/json_value.h"

namespace ninebit {

// Walks the file's scene. Perspective cameras with the file's own vertical angle; KHR_lights_punctual lights of type
// "point", colours with their largest channel as 1. The number of triangles counts every mesh once a node that has it.
[[nodiscard]] Result<FileFacts> read_gltf_nodes(const Json& root);

}  // namespace ninebit
