// A program as a GLSL function that uses only integers: the same bits as the reference evaluator on every conforming
// GLSL.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_program.h"

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

// The languages of emit_pixel_shader.
enum class PixelLanguage : std::uint8_t {
  glsl_130,  // OpenGL 2.1 with integers in its shaders
  glsl_330,  // OpenGL 3.3 core
  glsl_450,  // OpenGL 4.5 core
  es_300,    // OpenGL ES 3.0
  hlsl       // Direct3D 10 and later: shader model 4
};

// The same function for emulators: one function for each general combiner, in vectors of red, green and blue, and
// constants in an array that the text declares, which has the elements of emit_glsl_with_uniform_constants. In HLSL,
// vectors are int4, and the array is in a `cbuffer FUNCTION_of_program`. Registers are a struct, FUNCTION_registers,
// which FUNCTION_stageN changes and FUNCTION_final reads; stages that write nothing that is read have no function.
//
// Programs that differ only in their constants give the same text, apart from comments. Returns a Diagnostic as
// emit_glsl does.
[[nodiscard]] Result<std::string> emit_pixel_shader(const Program& program, PixelLanguage language,
                                                    std::string_view function = "ninebit_combine");

// Whether the numbers of a stage that animations change stand in the text or in uniforms.
enum class StageNumbers : std::uint8_t {
  literal,  // in the text
  uniform   // `vec4 FUNCTION_matrix[4]`, `vec2 FUNCTION_scale[4]` (scale, bias), `vec3 FUNCTION_eye[4]`, by stage
};

// Texture-shader stages as a GLSL function, for the same shader as the function of the combiners: without a #version
// line, for GLSL 1.30 and ES 3.00 and later, with `precision highp float` where the language wants one.
//
//   bool ninebit_texture_shader(vec4 at0, vec4 at1, vec4 at2, vec4 at3,
//                               out ivec4 texture0, out ivec4 texture1, out ivec4 texture2, out ivec4 texture3,
//                               out float depth)
//
// returns whether a stage culls the fragment. `atI` is s, t, r, q of unit I, not divided by q; `textureI` is what
// ninebit_combine reads, as register codes of the profile; `depth` is the depth that replaces the fragment's, in the
// program's unit, or 0. For each unit I that a stage reads the text declares `ivec4 FUNCTION_texelI(vec3 at)`, which
// the caller defines: the filtered bytes of the unit's texture at s, t, r, as FetchTexel (evaluate_stages.h) gives
// them.
//
// Whole numbers are exact. Floats follow the order of operations of evaluate(); a GLSL that rounds or contracts them in
// another way may differ in their last bit. NaN becomes the byte 0; other uses of NaN are up to the GLSL. The profile
// must be that of compile(). Returns a Diagnostic for an invalid name.
[[nodiscard]] Result<std::string> emit_glsl_texture_shader(const TextureShaderProgram& program,
                                                           const HardwareProfile& profile,
                                                           StageNumbers numbers = StageNumbers::literal,
                                                           std::string_view function = "ninebit_texture_shader");

}  // namespace ninebit
