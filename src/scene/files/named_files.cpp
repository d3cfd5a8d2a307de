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
