// Shaders of the rivals.
#pragma once

#include <string>

#include "ninebit/numerics/result.h"
#include "src/bench/gl_functions.h"

namespace ninebit::bench {

// A linked program. Reports what the driver says of a shader that does not compile, and shaders that do not link.
[[nodiscard]] Result<GLuint> link_program(const Gl& gl, const std::string& vertex, const std::string& fragment);

}  // namespace ninebit::bench
