// The readers of scene files, one for each format.
//
// Each takes the whole content of a file, checks every count, offset and index against what is there before it uses it,
// and makes the scene. Diagnostics come without a file name: read_scene() adds it. The scene has no name yet.
#pragma once

#include <filesystem>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "ninebit/scene/scene_io.h"
#include "src/scene/named_files.h"

namespace ninebit {

[[nodiscard]] Result<Scene> read_off(std::string_view content);
[[nodiscard]] Result<Scene> read_ply(std::string_view content);

// `beside` gives the material libraries.
[[nodiscard]] Result<Scene> read_obj(std::string_view content, const NamedFiles& beside);

// .glb if binary, otherwise .gltf; `beside` gives the buffers. Compressed meshes come by way of Draco, after our own
// check.
[[nodiscard]] Result<Scene> read_gltf(std::string_view content, const NamedFiles& beside, bool binary,
                                      const SceneReadOptions& options);

// By way of Assimp, after our own check.
[[nodiscard]] Result<Scene> read_3ds(std::string_view content, const std::filesystem::path& file,
                                     const SceneReadOptions& options);

}  // namespace ninebit
