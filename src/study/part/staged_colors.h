// One fragment's colours, with one more stage computed as in the profile each time.
#pragma once

#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/program.h"
#include "src/combiner/real_batch.h"

namespace ninebit {

// Runs fragment after fragment of a program with integer arithmetic, on one thread.
class StagedColors {
 public:
  explicit StagedColors(const Program& program);
  // Not copyable: exact_ refers to the programs in rest_.
  StagedColors(const StagedColors&) = delete;
  StagedColors& operator=(const StagedColors&) = delete;

  // The colours of colors_by_stage; valid until the next call.
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
  std::vector<ExactColors> exact_;  // of the programs in rest_
  std::vector<RealColor> colors_;
};

}  // namespace ninebit
