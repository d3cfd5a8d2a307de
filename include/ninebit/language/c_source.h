// A program as a C99 function with the same bits as the reference evaluator; it is valid C++ too.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

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

}  // namespace ninebit
