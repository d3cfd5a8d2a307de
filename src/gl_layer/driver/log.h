// Messages for people: lines on standard error, or in the file that NINEBIT_GL_LOG names.
#pragma once

#include <string_view>

namespace ninebit::gl_layer {

// Writes "ninebit: MESSAGE" as one line.
void log_line(std::string_view message);
// The same, but only the first time in the process that this message is written.
void log_once(std::string_view message);

}  // namespace ninebit::gl_layer
