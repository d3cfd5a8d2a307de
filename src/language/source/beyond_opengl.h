// What the NV2A's registers can ask for and OpenGL, and so the languages that end in its calls, cannot.
#pragma once

#include <string>

#include "ninebit/combiner/program.h"

namespace ninebit {

// What of it has an effect in a program, as in "mux by the lowest bit of spare0's alpha (general combiner 1)"; empty:
// nothing.
[[nodiscard]] std::string beyond_opengl(const Program& program);

}  // namespace ninebit
