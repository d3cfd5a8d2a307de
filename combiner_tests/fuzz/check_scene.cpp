// Scene files, as far as our own code reads them: each format's check, and JSON.
#include <algorithm>
#include <string>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "src/scene/file_check.h"
#include "src/scene/json_value.h"

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
  const std::string printed = parsed->dump(-1, ' ', false, Json::error_handler_t::replace);
  const auto back = parse_json(printed);
  if (!back) return "JSON that was read is refused when it is printed: " + back.error().message + "\n" + printed;
  return back->dump(-1, ' ', false, Json::error_handler_t::replace) == printed ? "" : "another JSON comes back";
}

// What goes to Assimp must say the same of itself as the file did.
std::string wrong_with_gltf(std::string_view content, bool binary) {
  const auto facts = check_gltf(content, kFile, binary);
  if (!facts) return wrong_with_diagnostic(facts.error(), content);
  if (!facts->for_assimp) return "nothing is left for the importer";
  const auto again = check_gltf(*facts->for_assimp, kFile, binary);
  if (!again) return "its geometry alone is refused: " + again.error().message + "\n" + *facts->for_assimp;
  if (again->triangles != facts->triangles) return "its geometry alone has another number of triangles";
  if (again->for_assimp != facts->for_assimp) return "its geometry is another one again";
  return {};
}

std::string wrong_with_text(Result<FileFacts> (*check)(std::string_view), std::string_view content) {
  const auto facts = check(content);
  return facts ? "" : wrong_with_diagnostic(facts.error(), content);
}

}  // namespace

std::string check_scene(std::string_view bytes) {
  return first_of(
      wrong_with_json(bytes), [&] { return wrong_with_gltf(bytes, false); },
      [&] { return wrong_with_gltf(bytes, true); }, [&] { return wrong_with_text(check_obj, bytes); },
      [&] { return wrong_with_text(check_off, bytes); }, [&] { return wrong_with_text(check_ply, bytes); },
      [&] { return wrong_with_text(check_3ds, bytes); });
}

}  // namespace ninebit::fuzz
