// Evaluates a program on eval's batches, with either engine.
#pragma once

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/program.h"
#include "src/tools/input/eval_table.h"

namespace ninebit::tools {

enum class EvalEngine { reference, simd };

class EvalRunner {
 public:
  // `state` must be valid for the profile. Constants that are columns of `rows` replace the program's own, in every
  // stage and in the final combiner.
  EvalRunner(const CombinerState& state, const HardwareProfile& profile, const EvalRows& rows, EvalEngine engine);

  // Evaluates the batch: sets its outputs, and its registers to those after the general combiners.
  void run(EvalBatch& batch);

 private:
  void set_constants(const EvalBatch& batch, std::size_t row);
  void run_reference(EvalBatch& batch);

  Program program_;
  BatchProgram batch_program_;
  EvalEngine engine_;
  Rgba9 constant0_, constant1_;            // the program's own, for --registers
  std::vector<EvalColumn> constants_;      // columns of the rows
  std::vector<EvalColumn> own_constants_;  // not columns of the rows
};

}  // namespace ninebit::tools
