// Languages of shaders that are not combiner programs, for messages that name them.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/numerics/visibility.h"

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {

// The language of a program with this header, such as "!!ARBfp1.0" or "vs.1.1", with its article: "an ARB fragment
// program". Empty: the header is unknown, or that of a language for combiners (!!RC1.0, !!PS1.0, ps.1.1).
[[nodiscard]] std::string_view language_of_header(std::string_view header);

// The language that a whole text seems to be in, with its article: by its header, or by words that only GLSL, HLSL or
// Cg have. Empty: unknown. Looks at the first 64 KiB.
[[nodiscard]] std::string_view foreign_language(std::string_view text);

// The purpose of a text of GL calls that sets no combiners: "code for ATI_fragment_shader". Empty: unknown.
[[nodiscard]] std::string_view foreign_calls(std::string_view text);

// "this is an ARB fragment program, which register combiners cannot run".
[[nodiscard]] std::string cannot_run(std::string_view language);

}  // namespace ninebit
