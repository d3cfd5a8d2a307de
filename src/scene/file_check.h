// What a scene file says about itself, read without Assimp.
//
// Assimp forgives: it clamps or drops indices that are out of range, takes a file that ends early for a shorter one,
// and can run for minutes on a senseless count. These checks read each format's own structure first; what passes them
// goes to Assimp, and the number of triangles that Assimp then gives is held against the number counted here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

// A scene's file, and each file of its buffers, in bytes: its lines can be counted in an int.
inline constexpr std::uint64_t kMostSceneBytes = (std::uint64_t{1} << 31U) - 1;

// What a file may place of triangles, and of meshes without any: a few nodes can place a large mesh again and again.
inline constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 27U;

struct FileFacts {
  std::optional<std::uint64_t> triangles;  // what the nodes of the file place, polygons counted as n - 2 triangles
  bool at_least = false;                   // nodes may place a mesh again: the number is a lower limit
  std::vector<Camera> cameras;             // perspective ones only; look_at is one unit ahead
  std::vector<Light> lights;               // directions not yet of unit length
  std::optional<std::string> for_assimp;   // in place of the file: the same without what Assimp trips over
  bool in_root_space = false;              // cameras and lights still lack the transform of Assimp's root node
};

// Each takes the whole content of the file. Diagnostics come without a file name: the caller adds it.
[[nodiscard]] Result<FileFacts> check_obj(std::string_view content);
[[nodiscard]] Result<FileFacts> check_off(std::string_view content);
[[nodiscard]] Result<FileFacts> check_ply(std::string_view content);
[[nodiscard]] Result<FileFacts> check_3ds(std::string_view content);

// .gltf or .glb; file is needed for the buffers that lie beside it.
[[nodiscard]] Result<FileFacts> check_gltf(std::string_view content, const std::filesystem::path& file, bool binary);

}  // namespace ninebit
