// How the functions of NV_vertex_program begin: they are the driver's where the layer does not add the extension.
#pragma once

#include "src/gl_layer/draw/vertex_programs.h"
#include "src/gl_layer/driver/driver.h"

// Defines gl##name, which calls `own` in this file.
#define NINEBIT_VERTEX_CALL(result, name, parameters, arguments, own)             \
  GLAPI result GLAPIENTRY gl##name parameters {                                   \
    using namespace ninebit::gl_layer;                                            \
    if (has_vertex_programs(current())) return own arguments;                     \
    static const auto next = next_function_as<decltype(&::gl##name)>("gl" #name); \
    return next != nullptr ? next arguments : static_cast<result>(0);             \
  }
#define NINEBIT_VERTEX_PROCEDURE(name, parameters, arguments, own) \
  NINEBIT_VERTEX_CALL(void, name, parameters, arguments, own)
