// --dump: the programs that were drawn with, and one frame's draw calls, as files.
#pragma once

#include "src/gl_layer/context.h"

namespace ninebit::gl_layer {

// A draw call is the first with this program.
void dump_program(const Context& context, const CachedProgram& cached);

// Before a draw call: returns whether it is captured. Then end_capture follows the call.
[[nodiscard]] bool begin_capture(Context& context, const char* call);
void end_capture(Context& context);

void frame_ended(const Context& context);

}  // namespace ninebit::gl_layer
