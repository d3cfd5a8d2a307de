// Scene files through the whole of each reader, and JSON.
#include <algorithm>
#include <string>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "src/scene/files/file_kind.h"
#include "src/scene/files/json_value.h"
#include "src/scene/files/scene_readers.h"

namespace ninebit::fuzz {
namespace {

// Messages quote the file: read_scene() makes one line of them.
std::string wrong_with_diagnostic(const Diagnostic& why, std::string_view text) {
  if (why.message.empty()) return "a fault has no message";
  const auto lines = 1 + std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
  return why.line >= 0 && why.line <= lines ? "" : "line " + std::to_string(why.line) + ": " + why.message;
}

std::string wrong_with_json(std::string_view text) {
  const auto parsed = parse_json(text);
  if (!parsed) return wrong_with_diagnostic(parsed.error(), text);
  const std::string printed = parsed->dump(-1, ' ', false, JsonValue::error_handler_t::replace);
  const auto back = parse_json(printed);
  if (!back) return "JSON that was read is refused when it is printed: " + back.error().message + "\n" + printed;
  return back->dump(-1, ' ', false, JsonValue::error_handler_t::replace) == printed ? "" : "another JSON comes back";
}

// A scene that was read keeps the promises of scene.h, but for cameras and lights, and follows from the bytes alone.
std::string wrong_with(const char* format, const Result<Scene>& scene, const Result<Scene>& again,
                       std::string_view content) {
  const std::string where = std::string(format) + ": ";
  if (scene.ok() != again.ok()) return where + "read once, and refused the second time";
  if (!scene) {
    const std::string wrong = wrong_with_diagnostic(scene.error(), content);
    return wrong.empty() ? "" : where + wrong;
  }
  if (scene->triangles != again->triangles || scene->positions != again->positions) return where + "another scene";
  if (scene->triangles.empty()) return {};
  Scene geometry = *scene;
  geometry.cameras.clear();
  geometry.lights.clear();
  const Status valid = validate(geometry);
  return valid ? "" : where + valid.error().message;
}

std::string wrong_with_kind(std::string_view content) {
  for (const char* extension : {".obj", ".off", ".ply", ".3ds", ".gltf", ".glb", ".stl", ".dae", ".fbx"}) {
    const auto kind = other_kind(content, extension);
    if (kind && kind->empty()) return "a kind without a name";
  }
  return {};
}

}  // namespace

std::string check_scene(std::string_view bytes) {
  // Assimp and Draco may crash and leak; what counts is that nothing but a fault or a right scene comes back.
  static const SceneReadOptions kIsolated{.isolated = true};
  // No file stands where these names lead.
  const std::filesystem::path gltf("/nonexistent/scene.gltf"), glb("scene.glb"), autodesk("scene.3ds");
  const NamedFiles beside(gltf, false);
  const auto each = [&](const char* format, auto read) { return wrong_with(format, read(), read(), bytes); };
  return first_of(
      wrong_with_json(bytes), [&] { return wrong_with_kind(bytes); },
      [&] { return each("gltf", [&] {
              return read_gltf({gltf, beside}, bytes, false, kIsolated);
            }); },
      [&] { return each("glb", [&] {
              return read_gltf({glb, beside}, bytes, true, kIsolated);
            }); },
      [&] { return each("obj", [&] { return read_obj(bytes, beside); }); },
      [&] { return each("off", [&] { return read_off(bytes); }); },
      [&] { return each("ply", [&] { return read_ply(bytes); }); },
      [&] { return each("3ds", [&] {
              return read_3ds({autodesk, beside}, bytes, kIsolated);
            }); });
}

}  // namespace ninebit::fuzz
