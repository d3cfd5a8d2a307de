// The readers of scene files, one per format.
//
// Each reader gets the whole content of a file, checks every count, offset and index against the content before using
// it, and returns the scene. Diagnostics have no file name: read_scene() adds it. The scene has no name yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "ninebit/scene/scene_io.h"
#include "src/scene/files/json_value.h"
#include "src/scene/files/named_files.h"

namespace ninebit {

[[nodiscard]] Result<Scene> read_off(std::string_view content);
[[nodiscard]] Result<Scene> read_ply(std::string_view content);

// `beside` reads the material libraries.
[[nodiscard]] Result<Scene> read_obj(std::string_view content, const NamedFiles& beside);

// A scene file, and the files beside it.
struct SceneFile {
  const std::filesystem::path& file;
  const NamedFiles& beside;
};

// .glb if binary, otherwise .gltf. Draco decodes compressed meshes after check_draco(). Assimp reads version 1.0.
[[nodiscard]] Result<Scene> read_gltf(const SceneFile& from, std::string_view content, bool binary,
                                      const SceneReadOptions& options);

// Read with Assimp, after a check of the file without it.
[[nodiscard]] Result<Scene> read_3ds(const SceneFile& from, std::string_view content, const SceneReadOptions& options);

// Read with Assimp in an isolated child process; what it gives is checked.
[[nodiscard]] Result<Scene> read_stl(const SceneFile& from, std::string_view content, const SceneReadOptions& options);
[[nodiscard]] Result<Scene> read_collada(const SceneFile& from, std::string_view content,
                                         const SceneReadOptions& options);
[[nodiscard]] Result<Scene> read_fbx(const SceneFile& from, std::string_view content, const SceneReadOptions& options);
// `root`: of a file of glTF 1.0; `body`: the bytes after it in a .glb file, otherwise empty.
[[nodiscard]] Result<Scene> read_gltf1(const SceneFile& from, JsonValue root, std::string_view body,
                                       const SceneReadOptions& options);

// The limits of a scene; docs/internals/limits.md lists them.

// The bytes of a scene file, and of each file that it names: the lines can be counted in an int.
inline constexpr std::uint64_t kMostSceneBytes = (std::uint64_t{1} << 31U) - 1;

// The triangles of a scene. A few nodes can place a large mesh many times, and many primitives can share their data, so
// a scene has at most kMostPlacedAgain triangles more than its files have bytes.
inline constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 27U;
inline constexpr std::uint64_t kMostPlacedAgain = std::uint64_t{1} << 23U;

// The most buffers of a glTF file, and the most material libraries of an OBJ file.
inline constexpr std::uint64_t kMostBuffers = 4096;
inline constexpr std::uint64_t kMostLibraries = 256;

}  // namespace ninebit
