// What the layer needs of a driver.
#pragma once

#include "src/gl_layer/context.h"

namespace ninebit::gl_layer {

// Asks the driver of the context that has just become current. What is missing is written to the log.
[[nodiscard]] DriverFeatures find_features();

// Whether a list of words, separated by spaces, has this one.
[[nodiscard]] bool has_word(const char* list, const char* word);

}  // namespace ninebit::gl_layer
