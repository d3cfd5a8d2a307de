// A program as a C99 function with the same bits as the reference evaluator; it is valid C++ too.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_program.h"

namespace NINEBIT_PUBLIC ninebit {

// A source that includes only <stdint.h> and defines one function:
//
//   void ninebit_combine(const int32_t primary[4], const int32_t secondary[4], const int32_t fog[4],
//                        const int32_t texture0[4], const int32_t texture1[4], const int32_t texture2[4],
//                        const int32_t texture3[4], int32_t spare0_alpha, int32_t result[4])
//
// Arrays are red, green, blue, alpha; `result` must not overlap the others. Arguments, result, `function`, helper
// functions (static) and Diagnostics are as in emit_glsl (glsl.h). Sources of several programs with different names may
// be concatenated into one file.
[[nodiscard]] Result<std::string> emit_c(const Program& program, std::string_view function = "ninebit_combine");

// Texture-shader stages as a source that includes only <stdint.h>:
//
//   int ninebit_texture_shader(const float at0[4], const float at1[4], const float at2[4], const float at3[4],
//                              void (*texel)(void *data, int unit, const float at[3], int32_t rgba[4]), void *data,
//                              int32_t texture0[4], int32_t texture1[4], int32_t texture2[4], int32_t texture3[4],
//                              float *depth)
//
// returns 1 if a stage culls the fragment, else 0. `atI` is s, t, r, q of unit I, not divided by q; `textureI` gets
// what ninebit_combine reads; `depth` gets the depth that replaces the fragment's, in the program's unit, or 0. For
// each texture that is read, `texel` is called with `data` and gives the filtered bytes of the unit's texture at s, t,
// r, as FetchTexel (evaluate_stages.h) does. Numbers are as in emit_glsl_texture_shader(); a compiler must not contract
// floats
// (-ffp-contract=off). The profile must be that of compile(). Returns a Diagnostic for an invalid name.
[[nodiscard]] Result<std::string> emit_c_texture_shader(const TextureShaderProgram& program,
                                                        const HardwareProfile& profile,
                                                        std::string_view function = "ninebit_texture_shader");

}  // namespace ninebit
