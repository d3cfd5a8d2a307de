#include "src/system/shared_library.h"

#include <dlfcn.h>

namespace ninebit::posix {

void* load_library(const std::filesystem::path& file) {
  return ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
}

void* find_symbol(void* library, const char* name) {
  return ::dlsym(library, name);
}

std::string library_error() {
  const char* const why = ::dlerror();
  return why == nullptr ? "" : why;
}

}  // namespace ninebit::posix
