// GL's names as text: of values and of the accepted calls.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/gl_nv.h"

namespace ninebit::detail {

// The value of an enumerant or boolean by its C name; empty if the name is unknown. GL_TEXTURE0 to GL_TEXTURE31 and
// GL_COMBINER0_NV to GL_COMBINER7_NV are all accepted: the GL call checks whether the profile has them.
[[nodiscard]] std::optional<gl::GLenum> value_of_name(std::string_view name);

enum class GlCommand {
  combiner_parameter_i,
  combiner_parameter_f,
  combiner_parameter_iv,
  combiner_parameter_fv,
  combiner_input,
  combiner_output,
  final_combiner_input,
  combiner_stage_parameter_fv,
  enable,
  disable,
  tex_env_i,
  tex_env_f,
  tex_env_iv,
  tex_env_fv,
  active_texture
};

// The GL name of a call without its prefix, and its parameters, one letter each: e an enumerant, b a boolean, i an
// integer, f a float, I and F arrays of integers and floats.
struct GlSignature {
  GlCommand command;
  std::string_view name;
  std::string_view parameters;
};

// All calls that are read.
[[nodiscard]] std::span<const GlSignature> gl_calls();

// The names of enumerants of the combiners, for suggestions.
[[nodiscard]] std::vector<std::string_view> gl_names();

// The C name of an enumerator; "0xFFFFFFFF", which GL refuses, for a value that is not an enumerator.
[[nodiscard]] std::string_view gl_name(Register reg);
[[nodiscard]] std::string_view gl_name(InputMapping mapping);
[[nodiscard]] std::string_view gl_name(ComponentUsage usage);
[[nodiscard]] std::string_view gl_name(Scale scale);
[[nodiscard]] std::string_view gl_name(Bias bias);

// The spellings of GL's names that programs of the time have: function pointers, wrappers, other languages' bindings.

// The call that a name means: GL's name or that of a function pointer (docs/languages.md); nullptr: none. A qualifier
// such as gl. or vtkgl:: is not part of the name.
[[nodiscard]] const GlSignature* find_gl_call(std::string_view name);

// The call of texture shaders that a name means: glTexEnvi and its kin, glActiveTextureARB, with the affixes of
// function pointers. Other calls of plain OpenGL have these names, too, so that find_gl_call() does not find them.
[[nodiscard]] const GlSignature* find_stage_call(std::string_view name);

// The value of an enumerant of texture shaders by its C name; empty if it is none.
[[nodiscard]] std::optional<gl::GLenum> stage_value_of_name(std::string_view name);

// The call that a method of an object or a function of a namespace means, beyond find_gl_call: gl.enable, GL.Disable.
[[nodiscard]] const GlSignature* find_gl_method(std::string_view name);

// Whether a name before a parenthesis converts a value, and changes nothing in it: GLenum, int, static_cast, wrap.
[[nodiscard]] bool is_conversion(std::string_view name);

// The value of an enumerant in another spelling than GL's: without GL_, or with other or no letters at the end
// (COMBINER0_NV, GL_COMBINER0, GL_TEXTURE0_EXT), or in CamelCase (Combiner0Nv). Names that are also ordinary words,
// such as RGB or TEXTURE0, need `qualified`: a qualifier stands before them (vtkgl::RGB); or an ending: SPARE0_NV.
[[nodiscard]] std::optional<gl::GLenum> value_of_spelling(std::string_view name, bool qualified);

// "; did you mean 'GL_SPARE0_NV'?" for a name that is not an enumerant; empty if no known name is near.
[[nodiscard]] std::string meant_enumerant(std::string_view name);
// The same for a call.
[[nodiscard]] std::string meant_call(std::string_view name);

}  // namespace ninebit::detail
