// Display lists that hold commands of this layer. The driver's lists cannot hold them, so such a list is a sequence of
// steps: lists of the driver, and commands between them. Lists without such commands are the driver's alone.
#pragma once

#include "src/gl_layer/context.h"

namespace ninebit::gl_layer {

// Ends the driver's list that is open and makes it a step of the context's open list.
void close_driver_list(Context& context);
// Opens the next list of the driver.
void open_driver_list(Context& context);

// Before a draw call that goes into a list: what a shader depends on may be different from here on.
void prepare_list_for_draw(Context& context);

}  // namespace ninebit::gl_layer
