// OpenGL's texture environments as GLSL, for texture shaders while the combiners are disabled.
#pragma once

#include <string>

#include "src/gl_layer/shader/shader_inputs.h"

namespace ninebit::gl_layer {

// Reads the state of the active unit, whose stage reads a texture of this target, or passes its coordinates through.
[[nodiscard]] Environment read_environment(StageTarget target);

// The lines that compute `color` from gl_Color and the texels `unit0` to `unit3`, then colour sum and fog, from
// `secondary_color` and `fog_factor` (OpenGL 1.3, 3.8.12, 3.9, 3.10).
[[nodiscard]] std::string environment_lines(const ShaderInputs& inputs);

}  // namespace ninebit::gl_layer
