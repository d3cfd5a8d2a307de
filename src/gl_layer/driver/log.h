// Messages for people: lines on standard error, or in the file that NINEBIT_GL_LOG names.
#pragma once

#include <atomic>
#include <string_view>

namespace ninebit::gl_layer {

// Writes "ninebit: MESSAGE" as one line.
void log_line(std::string_view message);
// The same, but only the first time in the process that this message is written.
void log_once(std::string_view message);

// A message of one place in the source, where a program may come for each vertex: no lock after the first time.
class LogOnce {
 public:
  void write(std::string_view message) {
    if (!written_.exchange(true, std::memory_order_relaxed)) log_line(message);
  }

 private:
  std::atomic<bool> written_ = false;
};

}  // namespace ninebit::gl_layer
