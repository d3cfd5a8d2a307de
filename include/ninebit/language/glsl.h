// A program as a GLSL function that uses only integers: the same bits as the reference evaluator on every conforming
// GLSL.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The GLSL version to emit; the versions differ in the #version line and the precision qualifiers.
enum class GlslVersion : std::uint8_t {
  glsl_130,  // OpenGL 2.1 with integers in its shaders
  glsl_330,  // OpenGL 3.3 core
  es_300     // OpenGL ES 3.0
};

// The text starts with its #version line and defines one function:
//
//   ivec4 ninebit_combine(ivec4 primary, ivec4 secondary, ivec4 fog,
//                         ivec4 texture0, ivec4 texture1, ivec4 texture2, ivec4 texture3, int spare0_alpha)
//
// The caller appends its own main(). Arguments are register codes in [lowest, one] of the profile that the program was
// compiled for; spare0's other components and spare1 start as 0. The result is codes in [0, one]. `function` is the
// function's name: a letter, then letters, digits and single underscores, not ending in an underscore. Helper
// functions, if any, have names that begin with the function's name and an underscore, so several programs fit into one
// shader after all #version lines but the first are removed.
//
// Returns a Diagnostic for a program whose arithmetic is not integer, for codes too large for 32 bits, and for an
// invalid name.
[[nodiscard]] Result<std::string> emit_glsl(const Program& program, GlslVersion version,
                                            std::string_view function = "ninebit_combine");

// The number of elements in the uniform array of emit_glsl_with_uniform_constants.
inline constexpr int kGlslConstants = 2 * (kMaxGeneralCombiners + 1);

// The same function, but the program's constants are read from `uniform ivec4 FUNCTION_constants[kGlslConstants]`,
// which the text declares: elements 2 i and 2 i + 1 are the codes of constant colours 0 and 1 of general combiner i,
// the last two those of the final combiner. Programs that differ only in their constants give the same text, apart from
// comments.
[[nodiscard]] Result<std::string> emit_glsl_with_uniform_constants(const Program& program, GlslVersion version,
                                                                   std::string_view function = "ninebit_combine");

}  // namespace ninebit
