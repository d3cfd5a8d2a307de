// --dump: the programs that were drawn with, and one frame's draw calls, as files.
#pragma once

#include "src/gl_layer/context/context.h"

namespace ninebit::gl_layer {

// Before a draw call whose shader is prepared: writes its program if it is new, and returns whether the call is
// captured. Then end_capture follows it.
[[nodiscard]] bool begin_capture(Context& context, const char* call);
void end_capture(Context& context);

void frame_ended(const Context& context);

}  // namespace ninebit::gl_layer
