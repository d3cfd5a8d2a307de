#include "src/scene/files/named_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "src/scene/files/file_kind.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"
#include "src/system/inside_folder.h"
#include "src/system/stream.h"

namespace ninebit {

Result<std::string> read_whole_file(const std::filesystem::path& file, std::uint64_t most) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > most) return fault_of(fmt::format("has {} bytes; at most {} are read", size, most));
  error.clear();
  std::string content = posix::read_file(file, static_cast<std::size_t>(most), error);
  if (error == std::errc::no_such_file_or_directory) return fault_of("cannot be opened: there is no such file");
  if (error == std::errc::is_a_directory) return fault_of("is a folder, not a scene file");
  if (error == posix::not_a_regular_file()) return fault_of("is not a regular file");
  if (error) return fault_of(fmt::format("cannot be opened: {}", error.message()));
  if (content.empty()) return fault_of("is empty");
  return content;
}

Status NamedFiles::check(std::string_view name) const {
  if (name.empty() || name.find('\0') != std::string_view::npos)
    return fault_of("names a file whose name is empty or has a byte 0");
  if (alone_) return fault_of("names another file, and files are read alone here");
  if (allow_outside_) return {};
  if (const std::optional<std::string> why = posix::why_outside(folder_, name))
    return fault_of(fmt::format("names a file that is not allowed: {}", *why));
  return {};
}

std::filesystem::path NamedFiles::path_of(std::string_view name) const {
  // After a symbolic link, ".." is not the folder in the text; such names are only read if the user allows them.
  const std::filesystem::path path = folder_ / name;
  return allow_outside_ ? path : path.lexically_normal();
}

Result<std::string> NamedFiles::read(std::string_view name, std::uint64_t most) const {
  return read_whole_file(path_of(name), most);
}

void name_picture(const NamedFiles& beside, const std::string& name, SceneTexture& out) {
  out.name = name;
  if (const Status allowed = beside.check(name); !allowed) {
    out.fault = allowed.error().message;
  } else {
    out.file = beside.path_of(name);
  }
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

std::optional<Result<Scene>> read_own_format(const SceneFile& from, std::string_view content,
                                             std::string_view extension, const SceneReadOptions& options) {
  if (extension == ".obj") return read_obj(content, from.beside);
  if (extension == ".off") return read_off(content);
  if (extension == ".ply") return read_ply(content);
  if (extension == ".gltf" || extension == ".glb") return read_gltf(from, content, extension == ".glb", options);
  return std::nullopt;
}

void name_and_turn(const std::filesystem::path& file, std::optional<UpAxis> up, Scene& scene) {
  scene.name = file.filename().string();
  if (!up || *up == scene.up) return;
  turn_up(*up, scene);
  scene.up = *up;
}

Result<Scene> scene_of_bytes(std::string_view content, const std::string& name, std::optional<UpAxis> up,
                             std::uint64_t most_triangles) {
  const std::filesystem::path file = name;
  SceneReadOptions options;
  options.most_triangles = most_triangles;
  Result<Scene> scene = fault_of("is empty");
  if (!content.empty()) {
    const NamedFiles beside = NamedFiles::alone(file);
    scene = read_own_format({file, beside}, content, lower_extension(file), options)
                .value_or(fault_of("is not read here; expected a .gltf, .glb, .obj, .ply or .off file"));
  }
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
  name_and_turn(file, up, *scene);
  return scene;
}

}  // namespace ninebit
