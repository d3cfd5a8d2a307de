#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include "ninebit/scene/scene_io.h"
#include "src/scene/files/file_kind.h"
#include "src/scene/files/named_files.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

Result<Scene> read_content(std::string_view content, const std::filesystem::path& file, const std::string& extension,
                           const SceneReadOptions& options) {
  const NamedFiles beside(file, options.allow_outside);
  const SceneFile from{file, beside};
  if (auto scene = read_own_format(from, content, extension, options)) return *std::move(scene);
  if (extension == ".3ds") return read_3ds(from, content, options);
  if (extension == ".stl") return read_stl(from, content, options);
  if (extension == ".dae") return read_collada(from, content, options);
  return read_fbx(from, content, options);
}

// Messages quote the file, which may contain any bytes.
void make_one_line(std::string& message) {
  constexpr std::size_t kLongest = 400;
  if (message.size() > kLongest) message.resize(kLongest);
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  }
}

Result<Scene> read_unnamed(const std::filesystem::path& file, const SceneReadOptions& options) {
  constexpr std::array<const char*, 9> kKnown{".gltf", ".glb", ".obj", ".ply", ".off", ".3ds", ".stl", ".dae", ".fbx"};
  const std::string extension = lower_extension(file);
  std::error_code error;
  const bool known = std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
  if (!known && std::filesystem::is_regular_file(file, error))
    return fault_of(
        fmt::format("{}; scenes are read from .gltf, .glb, .obj, .ply, .off, .3ds, .stl, .dae and .fbx files",
                    extension.empty() ? "has no extension" : fmt::format("has the unknown extension '{}'", extension)));
  const Result<std::string> content = read_whole_file(file, kMostSceneBytes);
  if (!content) return content.error();
  Result<Scene> scene = read_content(*content, file, extension, options);
  if (!scene || scene->triangles.empty()) {
    if (const auto kind = other_kind(*content, extension))
      return fault_of(fmt::format("seems to be {}; expected what its extension {} says", *kind, extension));
  }
  if (scene && scene->triangles.empty()) return fault_of("has no triangles");
  if (!scene) return scene;
  name_and_turn(file, options.up, *scene);
  return scene;
}

}  // namespace

Result<Scene> read_scene(const std::filesystem::path& file, const SceneReadOptions& options) {
  Result<Scene> scene = read_unnamed(file, options);
  if (scene) return scene;
  Diagnostic fault = scene.error();
  make_one_line(fault.message);
  fault.file = file.string();
  return fault;
}

}  // namespace ninebit
