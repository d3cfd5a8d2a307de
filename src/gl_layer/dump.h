// --dump: the programs that were drawn with, and one frame's draw calls, as files.
#pragma once

#include <string>

#include "src/gl_layer/context.h"

namespace ninebit::gl_layer {

// Whether shaders write their inputs to the colour buffers after the first: NINEBIT_GL_WRITE_INPUTS is set.
[[nodiscard]] bool writes_inputs();

// A program of the cache was compiled.
void dump_program(const CachedProgram& cached, const std::string& shader);

// Before a draw call: returns whether it is captured. Then end_capture follows the call.
[[nodiscard]] bool begin_capture(Context& context, const char* call);
void end_capture(Context& context);

void frame_ended(Context& context);

}  // namespace ninebit::gl_layer
