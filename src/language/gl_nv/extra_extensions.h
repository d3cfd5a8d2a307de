// Extensions beside the combiners that programs of the time ask for, and that the OpenGL layer can add to a driver.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace ninebit {

enum class Extra : unsigned {
  fence = 1,
  vertex_array_range = 2,
  depth_texture = 4,
  shadow = 8,
  vertex_program = 16,
  vertex_program1_1 = 32,  // which has the functions of the one before
  paletted_texture = 64,
  shared_texture_palette = 128,  // the same
};

struct ExtraExtension {
  Extra extra;
  std::string_view name;
};
inline constexpr std::array kExtraExtensions{
    ExtraExtension{Extra::fence, "GL_NV_fence"},
    ExtraExtension{Extra::vertex_array_range, "GL_NV_vertex_array_range"},
    ExtraExtension{Extra::depth_texture, "GL_SGIX_depth_texture"},
    ExtraExtension{Extra::shadow, "GL_SGIX_shadow"},
    ExtraExtension{Extra::vertex_program, "GL_NV_vertex_program"},
    ExtraExtension{Extra::vertex_program1_1, "GL_NV_vertex_program1_1"},
    ExtraExtension{Extra::paletted_texture, "GL_EXT_paletted_texture"},
    ExtraExtension{Extra::shared_texture_palette, "GL_EXT_shared_texture_palette"}};

// Some of them.
struct Extras {
  unsigned bits = 0;
  void add(Extra extra) { bits |= static_cast<unsigned>(extra); }
  [[nodiscard]] bool have(Extra extra) const { return (bits & static_cast<unsigned>(extra)) != 0; }
};

// Those of a list with commas: names, with or without "GL_", "all" or "none". Empty: a word is none of these; `unknown`
// is that word.
[[nodiscard]] std::optional<Extras> parse_extras(std::string_view list, std::string& unknown);

}  // namespace ninebit
