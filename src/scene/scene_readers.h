// The readers of scene files, one per format.
//
// Each reader gets the whole content of a file, checks every count, offset and index against the content before using
// it, and returns the scene. Diagnostics have no file name: read_scene() adds it. The scene has no name yet.
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

// `beside` reads the material libraries.
[[nodiscard]] Result<Scene> read_obj(std::string_view content, const NamedFiles& beside);

// .glb if binary, otherwise .gltf; `beside` reads the buffers. Draco decodes compressed meshes after check_draco().
[[nodiscard]] Result<Scene> read_gltf(std::string_view content, const NamedFiles& beside, bool binary,
                                      const SceneReadOptions& options);

// Read with Assimp, after a check of the file without it.
[[nodiscard]] Result<Scene> read_3ds(std::string_view content, const std::filesystem::path& file,
                                     const SceneReadOptions& options);

}  // namespace ninebit
