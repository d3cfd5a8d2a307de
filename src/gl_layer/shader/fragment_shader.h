// The GLSL of a fragment shader that takes the place of OpenGL's texture environment, colour sum and fog.
#pragma once

#include <string>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/gl_layer/shader/shader_inputs.h"

namespace ninebit::gl_layer {

// Uniforms: "ninebit_textureI", the sampler of unit I, and the array "ninebit_combine_constants" (glsl.h). Everything
// else comes from OpenGL's fixed functions. The program's profile must be `profile`. With `write_inputs` the shader
// writes gl_FragData[0], the colour, then primary colour, secondary colour, fog colour with the fog factor as alpha,
// and the texels of units 0 to 3, as floats. Returns a Diagnostic for a program that cannot be emitted (glsl.h).
[[nodiscard]] Result<std::string> fragment_shader(const Program& program, const HardwareProfile& profile,
                                                  const ShaderInputs& inputs);

}  // namespace ninebit::gl_layer
