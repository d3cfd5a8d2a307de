// A record of a technique's drawing, made while it draws: its passes, and the memory of its maps.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/frame/rendering.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/texture.h"

namespace ninebit {

// In the order of CubeFace.
inline constexpr std::array kCubeFaceNames{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

// Adds a pass that is drawn with this state to Rendering::drawn. A name is added once: a pass may take several draws.
void note_pass(Rendering& rendering, std::string_view name, const PipelineState& state);

// The same for a pass that is computed in floats, beyond the hardware. `marks_shadows`: it is the comparison.
void note_float_pass(Rendering& rendering, std::string_view name, bool marks_shadows);

// Memory of all levels and faces: three components take four bytes, 24 bits of depth as well.
[[nodiscard]] std::uint64_t texture_bytes(const Texture& texture);

// Counting the texture units that a technique needs.

// The number of texture registers that the program's output colour depends on.
[[nodiscard]] int texture_units_read(const Program& program);

// Times and progress of a technique's passes.

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
