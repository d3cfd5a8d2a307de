// Scenes from memory, where no other file is at hand.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/scene/scene_io.h"

namespace ninebit {

// Reads the content of a .gltf, .glb, .obj, .ply or .off file, by the extension of its name, as read_scene() does.
// Reports what read_scene() reports, with the name as the file; files that the scene names, except pictures, which stay
// unread; glTF 1.0 and Draco in a build without their libraries; and more than `most_triangles`.
[[nodiscard]] Result<Scene> scene_of_bytes(std::string_view content, const std::string& name, std::optional<UpAxis> up,
                                           std::uint64_t most_triangles);

}  // namespace ninebit
