// OpenGL on a software renderer, without a window and without linking to it.
#pragma once

#include <memory>
#include <string>

#include "ninebit/numerics/result.h"

namespace ninebit::bench {

// While it lives, a context of OpenGL 3.3 (core) on Mesa's llvmpipe is current to the thread that made it.
class EglContext {
 public:
  // `threads` is what LP_NUM_THREADS gets: the threads that draw tiles, besides the one that calls. The process's
  // environment changes. Reports a build without EGL's headers, a machine without EGL or without llvmpipe.
  [[nodiscard]] static Result<std::unique_ptr<EglContext>> make(int threads);
  virtual ~EglContext() = default;

  // The entry point of that name; nullptr where there is none.
  using Function = void (*)();
  [[nodiscard]] virtual Function function(const char* name) const = 0;
};

// What the driver allocates meanwhile and keeps for good is no leak of ours, where the leak sanitizer looks on.
class DriverCode {
 public:
  DriverCode();
  ~DriverCode();
  DriverCode(const DriverCode&) = delete;
  DriverCode& operator=(const DriverCode&) = delete;
};

}  // namespace ninebit::bench
