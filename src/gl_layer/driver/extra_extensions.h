// The extensions beside the combiners that the layer adds: those that NINEBIT_GL_EXTENSIONS names and the driver lacks.
#pragma once

#include "src/language/gl_nv/extra_extensions.h"

namespace ninebit::gl_layer {

// For OpenGL's functions, which stand in no namespace.
using ninebit::Extra;
using ninebit::ExtraExtension;
using ninebit::kExtraExtensions;

// Those that the user wants; none is the default. A list with another word counts as none, and is reported once.
[[nodiscard]] Extras wanted_extras();

// The one that a function of the layer's belongs to; empty: none.
[[nodiscard]] std::optional<Extra> extra_of(std::string_view function);

// Whether a function belongs to one that is not wanted: then the driver's is the program's.
[[nodiscard]] bool belongs_to_unwanted(std::string_view function);

}  // namespace ninebit::gl_layer
