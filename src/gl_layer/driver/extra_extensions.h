// Extensions beside the combiners that programs of the time ask for. The layer adds those that NINEBIT_GL_EXTENSIONS
// names and the driver lacks.
#pragma once

#include <array>
#include <string_view>

namespace ninebit::gl_layer {

enum class Extra : unsigned { fence = 1, vertex_array_range = 2, depth_texture = 4, shadow = 8 };

struct ExtraExtension {
  Extra extra;
  const char* name;
};
inline constexpr std::array kExtraExtensions{
    ExtraExtension{Extra::fence, "GL_NV_fence"}, ExtraExtension{Extra::vertex_array_range, "GL_NV_vertex_array_range"},
    ExtraExtension{Extra::depth_texture, "GL_SGIX_depth_texture"}, ExtraExtension{Extra::shadow, "GL_SGIX_shadow"}};

// Some of them.
struct Extras {
  unsigned bits = 0;
  void add(Extra extra) { bits |= static_cast<unsigned>(extra); }
  [[nodiscard]] bool have(Extra extra) const { return (bits & static_cast<unsigned>(extra)) != 0; }
};

// Those that the user wants: of a list with commas, "all" or "none", which is the default. A name that is none of them
// is reported once.
[[nodiscard]] Extras wanted_extras();

// Whether a function belongs to one that is not wanted: then the driver's is the program's.
[[nodiscard]] bool belongs_to_unwanted(std::string_view function);

}  // namespace ninebit::gl_layer
