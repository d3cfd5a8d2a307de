// Features of the NV2A's registers that OpenGL, and the languages that translate to its calls, cannot express.
#pragma once

#include <string>

#include "ninebit/combiner/program.h"

namespace ninebit {

// The features that have an effect in a program, such as "mux by the lowest bit of spare0's alpha (general combiner
// 1)"; empty: none.
[[nodiscard]] std::string beyond_opengl(const Program& program);

}  // namespace ninebit
