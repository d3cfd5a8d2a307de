// Shared by the rivals: shaders, the driver's name, the picture that was drawn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/bench/gl_functions.h"

namespace ninebit::bench {

// A linked program. Reports what the driver says of a shader that does not compile, and shaders that do not link.
[[nodiscard]] Result<GLuint> link_program(const Gl& gl, const std::string& vertex, const std::string& fragment);

// The driver's renderer and version.
[[nodiscard]] std::string renderer_of(const Gl& gl);

// The bound framebuffer's colours, red, green, blue, alpha, by rows from below.
[[nodiscard]] Result<std::vector<std::uint8_t>> picture_of(const Gl& gl, GLsizei width, GLsizei height);

}  // namespace ninebit::bench
