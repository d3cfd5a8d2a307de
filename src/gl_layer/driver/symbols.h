// How a program finds OpenGL's functions: the dynamic linker, dlsym and the window systems' GetProcAddress. Each of
// them gives this library's function where there is one.
#pragma once

#include <string_view>

namespace ninebit::gl_layer {

using AnyFunction = void (*)();

// This library's function of that name; nullptr if it has none.
[[nodiscard]] AnyFunction own_function(std::string_view name);

// Whether the program has looked up an entry point of the combiners, and so may use them.
[[nodiscard]] bool combiners_looked_up();

// Whether it has looked up a function that makes images of textures without this library's knowledge.
[[nodiscard]] bool unseen_image_calls_looked_up();

// The function that a program would get without this library; nullptr if there is none.
[[nodiscard]] AnyFunction next_function(const char* name);

// The C library's dlsym.
using FindSymbol = void* (*)(void*, const char*) noexcept;  // as it is declared there
[[nodiscard]] FindSymbol next_dlsym() noexcept;
// This library's function that dlsym may give for a name; nullptr: the C library's answer is right as it is.
[[nodiscard]] void* own_symbol(void* handle, const char* name);
// The result of dlsym for that name: the function, if the handle's library is a driver, else the library's own. An
// interposer behind this library, in which `caller` is an address, gets the driver's.
[[nodiscard]] void* looked_up(void* handle, const char* name, void* own, const void* caller);

template <class Function>
Function next_function_as(const char* name) {
  return reinterpret_cast<Function>(next_function(name));
}

}  // namespace ninebit::gl_layer
