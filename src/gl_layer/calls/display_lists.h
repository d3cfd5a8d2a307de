// Display lists that hold commands of this layer. The driver's lists cannot hold them, so such a list is a sequence of
// steps: lists of the driver, and commands between them. Lists without such commands are the driver's alone.
#pragma once

#include <utility>

#include "src/gl_layer/context/context.h"

namespace ninebit::gl_layer {

// Ends the driver's list that is open and makes it a step of the context's open list.
void close_driver_list(Context& context);
// Opens the next list of the driver.
void open_driver_list(Context& context);

// Whether a command that the layer has to see when it is executed becomes a step of the list that is compiled. Between
// glBegin and glEnd the driver's list cannot be split: Mesa 22.3 draws other primitives wrongly after a list that ends
// there.
[[nodiscard]] bool goes_into_steps(const Context& context);

// Puts a command into the display list that is being compiled, and executes it if the list's mode says so.
void record(Context& context, const std::function<void()>& command);

// The same for a command of the layer between glBegin and glEnd, which is an error.
void record_begin_error(Context& context);

// Runs something that is not of a display list, but calls functions of the driver that would go into its open list.
template <class Command>
void run_beside_list(Context& context, const Command& command) {
  if (context.open_list == nullptr || context.list_in_begin()) return command();
  close_driver_list(context);
  auto list = std::move(context.open_list);
  command();
  context.open_list = std::move(list);
  open_driver_list(context);
}

// Whether that is possible: between glBegin and glEnd in a list that is only compiled it is not, because the driver's
// list cannot be split there. Then the error GL_INVALID_OPERATION is raised, with a line in the log.
[[nodiscard]] bool can_run_beside_list(Context& context);

// Raises the error of a command of the layer, if a list is open when it is played.
void raise_or_record(Context& context, unsigned error);

// Before a draw call that goes into a list: what a shader depends on may be different from here on.
void prepare_list_for_draw(Context& context);

// Before a draw call that goes into a list: the vertex program takes these attributes from arrays.
void prepare_list_for_vertices(Context& context, unsigned arrays);

// After a command that changes what a shader depends on: the next draw call looks again.
void mark_stale();
// The same where fog alone may have changed.
void mark_fog_stale();
// The same for a command that makes or deletes images of textures.
void mark_images_changed();

// After a glEnd that goes into a list.
void end_in_list(Context& context);

}  // namespace ninebit::gl_layer
