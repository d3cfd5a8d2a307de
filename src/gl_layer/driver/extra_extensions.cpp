#include "src/gl_layer/driver/extra_extensions.h"

#include <cstdlib>
#include <string>

#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {
namespace {

Extras named(std::string_view word) {
  Extras extras;
  for (const ExtraExtension& one : kExtraExtensions) {
    const std::string_view name = one.name;
    if (word == "all" || word == name || word == name.substr(3)) extras.add(one.extra);
  }
  return extras;
}

}  // namespace

Extras wanted_extras() {
  const char* const text = std::getenv("NINEBIT_GL_EXTENSIONS");
  std::string_view list = text != nullptr ? text : "";
  Extras extras;
  while (!list.empty()) {
    const std::string_view word = list.substr(0, list.find(','));
    list.remove_prefix(word.size() < list.size() ? word.size() + 1 : word.size());
    const Extras some = named(word);
    extras.bits |= some.bits;
    if (some.bits != 0 || word == "none") continue;
    std::string message = "--extensions: '" + std::string(word) + "' is none of all, none";
    for (const ExtraExtension& one : kExtraExtensions) message += std::string(", ") + one.name;
    log_once(message);
  }
  return extras;
}

bool belongs_to_unwanted(std::string_view function) {
  const bool is_fence = function.ends_with("FenceNV") || function.ends_with("FencesNV") || function == "glGetFenceivNV";
  if (is_fence) return !wanted_extras().have(Extra::fence);
  const bool is_range = function.ends_with("ArrayRangeNV") || function.ends_with("MemoryNV");
  return is_range && !wanted_extras().have(Extra::vertex_array_range);
}

}  // namespace ninebit::gl_layer
