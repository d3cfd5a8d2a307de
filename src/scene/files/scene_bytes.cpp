#include "src/scene/files/scene_bytes.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "src/scene/fault_of.h"
#include "src/scene/files/named_files.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/files/up_axis.h"

namespace ninebit {
namespace {

Result<Scene> scene_in(std::string_view content, const std::filesystem::path& file, std::uint64_t most_triangles) {
  const std::string extension = file.extension().string();
  const auto is = [&](std::string_view other) {
    return std::equal(extension.begin(), extension.end(), other.begin(), other.end(), [](char a, char b) {
      return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
  };
  const NamedFiles beside = NamedFiles::alone(file);
  if (is(".obj")) return read_obj(content, beside);
  if (is(".off")) return read_off(content);
  if (is(".ply")) return read_ply(content);
  if (!is(".gltf") && !is(".glb")) return fault_of("is not read here; expected a .gltf, .glb, .obj, .ply or .off file");
  SceneReadOptions options;
  options.most_triangles = most_triangles;
  return read_gltf({file, beside}, content, is(".glb"), options);
}

}  // namespace

Result<Scene> scene_of_bytes(std::string_view content, const std::string& name, std::optional<UpAxis> up,
                             std::uint64_t most_triangles) {
  Result<Scene> scene = content.empty() ? fault_of("is empty") : scene_in(content, name, most_triangles);
  if (scene && scene->triangles.empty()) scene = fault_of("has no triangles");
  if (scene && scene->triangles.size() > most_triangles) {
    scene = fault_of("has more than " + std::to_string(most_triangles) + " triangles");
  }
  if (!scene) {
    Diagnostic fault = scene.error();
    fault.message.resize(std::min<std::size_t>(fault.message.size(), 400));
    fault.file = name;
    return fault;
  }
  scene->name = std::filesystem::path(name).filename().string();
  if (up && *up != scene->up) {
    turn_up(*up, *scene);
    scene->up = *up;
  }
  return scene;
}

}  // namespace ninebit
