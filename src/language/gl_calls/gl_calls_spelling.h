// The spellings of GL's names that programs of the time have: function pointers, wrappers, other languages' bindings.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "src/language/gl_calls/gl_calls_names.h"

namespace ninebit::detail {

// The call that a name means: GL's name or that of a function pointer (docs/languages.md); nullptr: none. A qualifier
// such as gl. or vtkgl:: is not part of the name.
[[nodiscard]] const GlSignature* find_gl_call(std::string_view name);

// The call that a method of an object or a function of a namespace means, beyond find_gl_call: gl.enable, GL.Disable.
[[nodiscard]] const GlSignature* find_gl_method(std::string_view name);

// Whether a name before a parenthesis converts a value, and changes nothing in it: GLenum, TGLboolean, Byte, Ord,
// static_cast, wrap.
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
