// How a program finds OpenGL's functions: the dynamic linker, dlsym and the window systems' GetProcAddress. Each of
// them gives this library's function where there is one.
#pragma once

#include <string_view>

namespace ninebit::gl_layer {

using AnyFunction = void (*)();

// This library's function of that name; nullptr if it has none.
[[nodiscard]] AnyFunction own_function(std::string_view name);

// The function that a program would get without this library; nullptr if there is none.
[[nodiscard]] AnyFunction next_function(const char* name);

template <class Function>
Function next_function_as(const char* name) {
  return reinterpret_cast<Function>(next_function(name));
}

}  // namespace ninebit::gl_layer
