// dlsym itself, which programs call. A file of its own, because its compilation must leave the stack alone
// (CMakeLists.txt).
#include "src/gl_layer/driver/symbols.h"

extern "C" {

// The sanitizers' own start calls dlsym, before anything that they have compiled may run.
#if defined(__has_feature)
#define NINEBIT_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define NINEBIT_SANITIZED 1
#else
#define NINEBIT_SANITIZED 0
#endif

#if !NINEBIT_SANITIZED
// RTLD_NEXT means the library that calls, and what it gets is right as it is: this library's function where that stands
// behind the caller. So the C library's function has to be jumped to, which GCC and Clang do with a call at a
// function's end when they optimize. Under a name of its own in C++, because Clang does not jump out of a function that
// may not throw, as <dlfcn.h> has it.
__attribute__((visibility("default"))) void* ninebit_dlsym(void* handle, const char* name) __asm__("dlsym");
#if defined(__clang__)
#define NINEBIT_JUMP [[clang::musttail]] return
#else
#define NINEBIT_JUMP return
__attribute__((optimize("O2")))
#endif
void* ninebit_dlsym(void* handle, const char* name) {
  if (void* const own = ninebit::gl_layer::own_symbol(handle, name)) {
    return ninebit::gl_layer::looked_up(handle, name, own, __builtin_return_address(0));
  }
  NINEBIT_JUMP ninebit::gl_layer::next_dlsym()(handle, name);
}
#endif

}  // extern "C"
