// Before a draw call: the right fragment shader becomes current.
#pragma once

#include "src/gl_layer/context/context.h"

namespace ninebit::gl_layer {

// Whether combiners or texture shaders are enabled, so that the layer computes colours.
[[nodiscard]] bool computes_colors(const Context& context);

// Whether prepare_draw would do anything.
[[nodiscard]] bool needs_preparation(const Context& context);

// Makes the shader of the current state the driver's program, or the program's own (none) if the combiners are off or
// something takes precedence over them. Not between glBegin and glEnd, nor while a list of the driver is open.
void prepare_draw(Context& context);

// GL_SHADER_CONSISTENT_NV of a unit, with the textures that are bound.
[[nodiscard]] bool is_consistent(Context& context, int unit);

// A draw call with the shader of the last preparation follows.
void count_draw(const Context& context);

}  // namespace ninebit::gl_layer
