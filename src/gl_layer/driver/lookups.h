// What a program looks up, gets and uses, for the last lines of the log file: they say what to add, and what is not
// needed.
#pragma once

#include <string_view>

#include "src/gl_layer/driver/extra_extensions.h"

namespace ninebit::gl_layer {

// An extension of the layer's. The numbers are bits.
enum class Asked : unsigned {
  combiners = 1,
  fence = 2,
  vertex_array_range = 4,
  vertex_program = 8,
  paletted_texture = 16,
};

// The program has looked up a function of the layer's, whether it gets it or not.
void note_lookup(std::string_view function);

// The program has asked a window system's GetProcAddress for a function and got none.
void note_missing(std::string_view function);

// The program has used an extension that the layer has given it.
void note_use(Asked extension);

// The driver has one of the further extensions itself.
void note_drivers_own(Extra extra);

}  // namespace ninebit::gl_layer
