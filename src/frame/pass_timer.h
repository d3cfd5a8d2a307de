// Times and progress of a technique's passes.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "ninebit/frame/rendering.h"

namespace ninebit {

// Calls the caller's progress function before each pass, and measures how long the pass takes.
class PassTimer {
 public:
  explicit PassTimer(Progress progress) : progress_(std::move(progress)) {}

  // Runs `work`, a function without arguments that returns a Status, and adds its time to `milliseconds`. `done` is the
  // part of the whole that is finished, from 0 to 1. Reports Fault::cancelled, without running `work`, if the progress
  // function says stop.
  template <class Work>
  Status run(std::string_view name, double done, double& milliseconds, const Work& work) {
    if (progress_ && !progress_(name, done)) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    const auto start = std::chrono::steady_clock::now();
    Status status = work();
    milliseconds += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return status;
  }

  // The same for `work` that returns a Result<Value>; its value is stored in `made`.
  template <class Value, class Work>
  Status make(std::string_view name, double done, double& milliseconds, std::optional<Value>& made, const Work& work) {
    return run(name, done, milliseconds, [&]() -> Status {
      Result<Value> result = work();
      if (!result) return result.error();
      made.emplace(std::move(*result));
      return {};
    });
  }

 private:
  Progress progress_;
};

}  // namespace ninebit
