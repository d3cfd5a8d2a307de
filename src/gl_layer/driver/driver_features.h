// The driver's features that the layer needs.
#pragma once

#include "src/gl_layer/driver/extra_extensions.h"

namespace ninebit::gl_layer {

// The features of a context's driver.
struct DriverFeatures {
  bool enough = false;  // what the layer needs; without it the layer leaves the context alone
  bool fragment_program = false, vertex_program = false, rectangle = false;
  bool texture_shader_formats = false;  // that store those of NV_texture_shader
  bool texture_storage = false;         // glTexStorage, and its query
  Extras extras{};                      // that the layer adds to it
};

// Asks the driver of the context that has just become current. What is missing is written to the log.
[[nodiscard]] DriverFeatures find_features();

// Whether a list of words, separated by spaces, has this one.
[[nodiscard]] bool has_word(const char* list, const char* word);

}  // namespace ninebit::gl_layer
