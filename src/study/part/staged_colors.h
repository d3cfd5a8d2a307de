// One fragment's colours with more and more stages as a profile computes them.
#pragma once

#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/program.h"
#include "src/combiner/real_batch.h"

namespace ninebit {

// For one thread; runs fragment after fragment of a program of integer arithmetic.
class StagedColors {
 public:
  explicit StagedColors(const Program& program);
  // The numbers refer to the programs beside them.
  StagedColors(const StagedColors&) = delete;
  StagedColors& operator=(const StagedColors&) = delete;

  // What colors_by_stage gives; valid until the next call.
  [[nodiscard]] const std::vector<RealColor>& operator()(RegisterFile registers);

  // Lets `put` change the constants of all programs that are run.
  template <class Put>
  void change_constants(const Put& put) {
    for (Program& program : stage_) put(program);
    for (Program& program : rest_) put(program);
  }

 private:
  std::vector<Program> stage_;      // one general combiner each
  std::vector<Program> rest_;       // the program without its first k general combiners
  std::vector<ExactColors> exact_;  // of those
  std::vector<RealColor> colors_;
};

}  // namespace ninebit
