// A draw call's state for people, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "src/gl_layer/context/context.h"

namespace ninebit::gl_layer {

// The call, what is current in the driver (viewport, tests, blending, fog, textures), and the combiners' program and
// constants; "program" is null for a draw call without combiners.
[[nodiscard]] nlohmann::ordered_json describe_draw(const Context& context, const char* call);

}  // namespace ninebit::gl_layer
