// OpenGL on a software renderer, without a window and without linking to OpenGL.
#pragma once

#include <memory>
#include <string>

#include "ninebit/numerics/result.h"

namespace ninebit::bench {

// During its lifetime an OpenGL 3.3 core context on Mesa's llvmpipe is current on the thread that made it.
class EglContext {
 public:
  // `threads` becomes LP_NUM_THREADS: the number of threads that draw tiles, in addition to the caller's. Changes the
  // process's environment. Reports a build without EGL's headers, and a machine without EGL or without llvmpipe.
  [[nodiscard]] static Result<std::unique_ptr<EglContext>> make(int threads);
  virtual ~EglContext() = default;

  // The entry point of that name; nullptr if there is none.
  using Function = void (*)();
  [[nodiscard]] virtual Function function(const char* name) const = 0;
};

// During its lifetime the leak sanitizer, if present, ignores allocations: the driver keeps some of them forever.
class DriverCode {
 public:
  DriverCode();
  ~DriverCode();
  DriverCode(const DriverCode&) = delete;
  DriverCode& operator=(const DriverCode&) = delete;
};

}  // namespace ninebit::bench
