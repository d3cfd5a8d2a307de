#include "src/gl_layer/driver/extra_extensions.h"

#include <cstdlib>
#include <string>

#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {

Extras wanted_extras() {
  const char* const list = std::getenv("NINEBIT_GL_EXTENSIONS");
  if (list == nullptr || *list == '\0') return {};
  std::string unknown;
  const auto extras = parse_extras(list, unknown);
  if (!extras) log_once("NINEBIT_GL_EXTENSIONS: '" + unknown + "' is not an extension that can be added");
  return extras.value_or(Extras{});
}

std::optional<Extra> extra_of(std::string_view function) {
  const bool is_fence = function.ends_with("FenceNV") || function.ends_with("FencesNV") || function == "glGetFenceivNV";
  if (is_fence) return Extra::fence;
  const bool is_range = function.ends_with("VertexArrayRangeNV") || function.ends_with("MemoryNV");
  if (is_range) return Extra::vertex_array_range;
  const bool is_palette = function.ends_with("EXT") && (function.find("ColorTable") != function.npos ||
                                                        function.find("ColorSubTable") != function.npos);
  if (is_palette) return Extra::paletted_texture;
  const bool is_vertex_program =
      function.ends_with("NV") && (function.find("Program") != function.npos ||
                                   function.find("VertexAttrib") != function.npos || function == "glTrackMatrixNV");
  return is_vertex_program ? std::optional(Extra::vertex_program) : std::nullopt;
}

bool belongs_to_unwanted(std::string_view function) {
  const auto extra = extra_of(function);
  return extra && !wanted_extras().have(*extra);
}

}  // namespace ninebit::gl_layer
