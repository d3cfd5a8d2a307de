// Formats that Assimp reads without a check of ours in front: always in an isolated child process.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "src/scene/files/assimp_import.h"
#include "src/scene/files/file_kind.h"
#include "src/scene/files/gltf_storage.h"
#include "src/scene/files/isolated_import.h"
#include "src/scene/files/json_value.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"
#include "src/system/hashing/openssl.h"

namespace ninebit {
namespace {

// COLLADA's <up_axis>; y if it is missing.
bool declares_z_up(std::string_view content) {
  constexpr std::string_view kTag = "<up_axis>";
  const std::size_t at = content.find(kTag);
  if (at == std::string_view::npos) return false;
  std::string_view value = content.substr(at + kTag.size());
  value.remove_prefix(std::min(value.find_first_not_of(" \t\r\n"), value.size()));
  return value.starts_with("Z_UP");
}

constexpr const char* kBody = "binary_glTF";
const std::string kBytes = "data:application/octet-stream;base64,";

// A list of a glTF 1.0 file, which is an object; empty if there is none.
JsonValue& list_in(JsonValue& root, const char* name) {
  JsonValue& list = root[name];
  if (!list.is_object()) list = JsonValue::object();
  return list;
}

// Makes the buffers part of the file, because the importer may open no file.
std::optional<Diagnostic> embed_buffers(JsonValue& root, std::string_view body, const NamedFiles& beside) {
  std::uint64_t left = kMostSceneBytes;
  for (auto& [name, buffer] : list_in(root, "buffers").items()) {
    const std::string uri = text_of(item(buffer, "uri"));
    if (!buffer.is_object()) continue;
    if (name == kBody) {
      // Padding follows the buffer.
      buffer["uri"] = kBytes + base64(body.substr(0, index_of(item(buffer, "byteLength")).value_or(body.size())));
      continue;
    }
    if (uri.empty() || uri.starts_with("data:")) continue;
    const std::string file = decode_percent(uri);
    if (const Status allowed = beside.check(file); !allowed) return allowed.error();
    const Result<std::string> bytes = beside.read(file, left);
    if (!bytes) return fault_of(fmt::format("its buffer '{}' {}", file, bytes.error().message));
    left -= bytes->size();
    buffer["uri"] = kBytes + base64(*bytes);
  }
  return std::nullopt;
}

// Makes the pictures that lie in the body of a .glb file (KHR_binary_glTF) data of the file.
void embed_pictures(JsonValue& root, std::string_view body) {
  const JsonValue views = list_in(root, "bufferViews");
  for (auto& [name, image] : list_in(root, "images").items()) {
    const JsonValue& binary = item(image, "extensions", "KHR_binary_glTF");
    const JsonValue& view = item(views, text_of(item(binary, "bufferView")).c_str());
    const std::uint64_t offset = index_of(item(view, "byteOffset")).value_or(0);
    const std::uint64_t length = index_of(item(view, "byteLength")).value_or(0);
    if (view.is_null() || offset > body.size() || length > body.size() - offset) continue;
    const std::string kind = text_of(item(binary, "mimeType"));
    image = {{"uri", "data:" + (kind.empty() ? "image/png" : kind) + ";base64," + base64(body.substr(offset, length))}};
  }
}

Result<Scene> import(const SceneFile& from, std::string_view content, const SceneReadOptions& options) {
  Result<Imported> imported = import_isolated(&import_geometry, from.file, content, options.go_on);
  if (!imported) return imported.error();
  Scene& scene = imported->scene;
  find_pictures(from.beside, scene);
  if (imported->has_viewpoints) scene.notes.emplace_back("cameras and lights");
  if (imported->z_up) scene.up = UpAxis::z;
  return std::move(scene);
}

}  // namespace

Result<Scene> read_stl(const SceneFile& from, std::string_view content, const SceneReadOptions& options) {
  Result<Scene> scene = import(from, content, options);
  if (!scene) return scene;
  // The format says nothing; its printers and CAD programs have z up. Assimp leaves the axes as they are.
  turn_up(UpAxis::z, *scene);
  scene->up = UpAxis::z;
  return scene;
}

Result<Scene> read_collada(const SceneFile& from, std::string_view content, const SceneReadOptions& options) {
  Result<Scene> scene = import(from, content, options);
  if (scene && declares_z_up(content)) scene->up = UpAxis::z;
  return scene;
}

Result<Scene> read_fbx(const SceneFile& from, std::string_view content, const SceneReadOptions& options) {
  Result<Scene> scene = import(from, content, options);
  // Assimp leaves the axes as they are.
  if (scene && scene->up == UpAxis::z) turn_up(UpAxis::z, *scene);
  return scene;
}

Result<Scene> read_gltf1(const SceneFile& from, JsonValue root, std::string_view body,
                         const SceneReadOptions& options) {
  if (!item(root, "accessors").is_object()) {
    return fault_of("declares glTF version 1.0, but its accessors are not an object; versions 1.0 and 2.0 are read");
  }
  root["asset"] = {{"version", "1.0"}};
  if (auto fault = embed_buffers(root, body, from.beside)) return *fault;
  embed_pictures(root, body);
  if (JsonValue used = item(root, "extensionsUsed"); used.is_array()) {
    for (std::size_t i = used.size(); i-- > 0;) {
      if (used[i] == "KHR_binary_glTF") used.erase(i);
    }
    root["extensionsUsed"] = std::move(used);
  }
  // Assimp tells the kinds of file by their extension.
  const std::filesystem::path name("scene.gltf");
  return import({name, from.beside}, root.dump(), options);
}

}  // namespace ninebit
