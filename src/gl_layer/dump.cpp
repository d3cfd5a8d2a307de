#include "src/gl_layer/dump.h"

#include <cstdlib>

namespace ninebit::gl_layer {

bool writes_inputs() {
  static const bool writes = [] {
    const char* const value = std::getenv("NINEBIT_GL_WRITE_INPUTS");
    return value != nullptr && *value != '\0';
  }();
  return writes;
}

void dump_program(const CachedProgram&, const std::string&) {}
bool begin_capture(Context&, const char*) { return false; }
void end_capture(Context&) {}
void frame_ended(Context&) {}

}  // namespace ninebit::gl_layer
