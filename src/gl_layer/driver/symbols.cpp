#include "src/gl_layer/driver/symbols.h"

#include <dlfcn.h>
#include <link.h>

#include <array>
#include <cstring>

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/lookups.h"

namespace ninebit::gl_layer {
namespace {

using GetProcAddress = AnyFunction (*)(const char*);

// The window systems' lookups that a program has found in a library which is not in the global scope.
constinit GetProcAddress loaded_glx = nullptr, loaded_egl = nullptr;

// A function of the C library by the version that it has on this processor. Other libraries may stand in front of it,
// and look up functions themselves when theirs is called.
template <class Function>
Function in_c_library(const char* name) {
  for (const char* version : {"GLIBC_2.34", "GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.1", "GLIBC_2.0"}) {
    if (void* const symbol = dlvsym(RTLD_NEXT, name, version)) return reinterpret_cast<Function>(symbol);
  }
  return nullptr;
}

using OpenLibrary = void* (*)(const char*, int);
OpenLibrary next_dlopen() {
  static const auto found = in_c_library<OpenLibrary>("dlopen");
  return found;
}

// A symbol of an OpenGL driver that the program has loaded, perhaps without making its symbols global; nullptr: none
// has it, or none that `accept` takes.
template <class Accept>
void* from_loaded_library(const char* name, const Accept& accept) {
  for (const char* file : {"libGL.so.1", "libOpenGL.so.0", "libGLX.so.0", "libEGL.so.1"}) {
    void* const library = next_dlopen()(file, RTLD_LAZY | RTLD_NOLOAD);
    if (library == nullptr) continue;
    void* const symbol = next_dlsym()(library, name);
    dlclose(library);
    if (symbol != nullptr && accept(symbol)) return symbol;
  }
  return nullptr;
}

void remember(std::string_view name, void* symbol) {
  if (name == "glXGetProcAddress" || name == "glXGetProcAddressARB") {
    loaded_glx = reinterpret_cast<GetProcAddress>(symbol);
  } else if (name == "eglGetProcAddress") {
    loaded_egl = reinterpret_cast<GetProcAddress>(symbol);
  }
}

// The library of an address, in the list of those that are loaded; nullptr: none.
const link_map* library_of(const void* address) {
  Dl_info ignored{};
  void* library = nullptr;
  return dladdr1(address, &ignored, &library, RTLD_DL_LINKMAP) != 0 ? static_cast<link_map*>(library) : nullptr;
}

// The library that was loaded last when this one was: those after it came by dlopen, and are in nobody's RTLD_NEXT
// unless they are global.
const link_map* last_at_start() {
  static const link_map* const last = [] {
    const link_map* library = library_of(reinterpret_cast<const void*>(&library_of));
    while (library != nullptr && library->l_next != nullptr) library = library->l_next;
    return library;
  }();
  return last;
}

[[maybe_unused]] const link_map* const looked_up_at_start = last_at_start();

// Whether a library has a function of that name itself.
bool defines(const link_map* library, const char* name) {
  void* const handle = next_dlopen()(library->l_name, RTLD_LAZY | RTLD_NOLOAD);
  if (handle == nullptr) return false;
  void* const symbol = next_dlsym()(handle, name);
  dlclose(handle);
  return symbol != nullptr && library_of(symbol) == library;
}

// Whether the code at an address belongs to an interposer behind this library, which its calls reach, perhaps through
// other interposers. The layer's function would call it again.
bool stands_behind(const char* name, const void* caller) {
  const link_map* const callers = library_of(caller);
  if (callers == nullptr) return false;
  void* const next = next_dlsym()(RTLD_NEXT, name);
  if (next == nullptr) return false;
  if (library_of(next) == callers) return true;
  const link_map* library = library_of(reinterpret_cast<const void*>(&library_of));
  while (library != callers && library != nullptr && library != last_at_start()) library = library->l_next;
  return library == callers && defines(callers, name);
}

// Whether the library of a symbol makes contexts of a window system itself: a driver under a name of its own.
bool is_of_a_window_systems_library(void* handle, void* symbol) {
  Dl_info library{}, other{};
  if (dladdr(symbol, &library) == 0) return false;
  for (const char* name : {"glXCreateContext", "eglCreateContext"}) {
    void* const creates = next_dlsym()(handle, name);
    if (creates != nullptr && dladdr(creates, &other) != 0 && other.dli_fbase == library.dli_fbase) return true;
  }
  return false;
}

// Whether a symbol of OpenGL's name is the driver's, which this library stands in front of. It is not where a library
// has functions of the same names for purposes of its own (OSMesa), or stands in front of this one (a tracer).
bool is_the_drivers(void* handle, const char* name, void* symbol) {
  const auto is_it = [symbol](void* found) { return found == symbol; };
  if (is_it(next_dlsym()(RTLD_NEXT, name))) return true;
  if (is_it(next_dlsym()(RTLD_DEFAULT, name))) return false;
  return from_loaded_library(name, is_it) != nullptr || is_of_a_window_systems_library(handle, symbol);
}

AnyFunction proc_address(const char* name, const char* lookup, GetProcAddress loaded) {
  if (name == nullptr) return nullptr;
  const AnyFunction own = own_function(name);
  const auto next = next_function_as<GetProcAddress>(lookup);
  const GetProcAddress get = next != nullptr ? next : loaded;
  const AnyFunction found = own != nullptr ? own : get != nullptr ? get(name) : nullptr;
  if (found == nullptr) note_missing(name);
  return found;
}

}  // namespace

FindSymbol next_dlsym() noexcept {
  static const auto found = in_c_library<FindSymbol>("dlsym");
  return found;
}

void* own_symbol(void* handle, const char* name) {
  const bool may_be_ours =
      name != nullptr && ((name[0] == 'g' && name[1] == 'l') || (name[0] == 'e' && name[1] == 'g'));
  const AnyFunction own = may_be_ours ? own_function(name) : nullptr;
  return handle != RTLD_NEXT ? reinterpret_cast<void*>(own) : nullptr;
}

void* looked_up(void* handle, const char* name, void* own, const void* caller) {
  void* symbol = next_dlsym()(handle, name);
  if (symbol == own) return symbol;
  if (symbol != nullptr) {
    const bool ours = is_the_drivers(handle, name, symbol) && !stands_behind(name, caller);
    if (ours) remember(name, symbol);
    dlerror();  // of the lookups since
    return ours ? own : symbol;
  }
  // A driver that lacks the combiners' functions.
  const char* const known = "glBegin";
  symbol = std::strstr(name, "Combiner") != nullptr ? next_dlsym()(handle, known) : nullptr;
  const bool ours = symbol != nullptr &&
                    (symbol == reinterpret_cast<void*>(own_function(known)) || is_the_drivers(handle, known, symbol));
  if (!ours) return next_dlsym()(handle, name);  // once more, for what dlerror says
  dlerror();
  return own;
}

AnyFunction next_function(const char* name) {
  if (void* const symbol = next_dlsym()(RTLD_NEXT, name)) return reinterpret_cast<AnyFunction>(symbol);
  void* const loaded = from_loaded_library(name, [](void*) { return true; });
  if (loaded != nullptr) return reinterpret_cast<AnyFunction>(loaded);
  for (const GetProcAddress get : {loaded_glx, loaded_egl}) {
    if (get == nullptr || std::strstr(name, "GetProcAddress") != nullptr) continue;
    if (const AnyFunction found = get(name)) return found;
  }
  // Functions that the library does not export.
  for (const char* lookup : {"glXGetProcAddressARB", "eglGetProcAddress"}) {
    if (name[0] == 'e' || name[2] == 'X') break;
    void* const symbol = next_dlsym()(RTLD_NEXT, lookup);
    if (symbol == nullptr) continue;
    if (const AnyFunction found = reinterpret_cast<GetProcAddress>(symbol)(name)) return found;
  }
  return nullptr;
}

Driver found_driver;

GLint driver_integer(GLenum name) {
  GLint value = 0;
  found_driver.GetIntegerv(name, &value);
  return value;
}

bool driver_enables(GLenum cap) {
  return found_driver.IsEnabled(cap) == GL_TRUE;
}

const Driver& find_driver() {
  static const bool found = [] {
#define NINEBIT_FIND(name) found_driver.name = next_function_as<decltype(found_driver.name)>("gl" #name);
    NINEBIT_CORE_FUNCTIONS(NINEBIT_FIND)
    NINEBIT_LATER_FUNCTIONS(NINEBIT_FIND)
#undef NINEBIT_FIND
    return true;
  }();
  static_cast<void>(found);
  return found_driver;
}

}  // namespace ninebit::gl_layer

extern "C" {

__attribute__((visibility("default"))) ninebit::gl_layer::AnyFunction glXGetProcAddress(const GLubyte* name) {
  return ninebit::gl_layer::proc_address(reinterpret_cast<const char*>(name), "glXGetProcAddress",
                                         ninebit::gl_layer::loaded_glx);
}

__attribute__((visibility("default"))) ninebit::gl_layer::AnyFunction glXGetProcAddressARB(const GLubyte* name) {
  return glXGetProcAddress(name);
}

__attribute__((visibility("default"))) ninebit::gl_layer::AnyFunction eglGetProcAddress(const char* name) {
  return ninebit::gl_layer::proc_address(name, "eglGetProcAddress", ninebit::gl_layer::loaded_egl);
}

}  // extern "C"
