// Running a program over eval's batches, by either engine.
#pragma once

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/program.h"
#include "src/tools/input/eval_table.h"

namespace ninebit::tools {

enum class EvalEngine { reference, simd };

// Puts a code in place of a constant's component, in every stage and in the final combiner.
void replace_constant(Program& program, const EvalColumn& column, s9 code);

class EvalRunner {
 public:
  // `state` is valid for the profile. Constants of columns that `rows` has stand in for the program's own, those of
  // every stage and of the final combiner alike.
  EvalRunner(const CombinerState& state, const HardwareProfile& profile, const EvalRows& rows, EvalEngine engine);

  // Evaluates the batch: its outputs, and as registers what the general combiners left.
  void run(EvalBatch& batch);

 private:
  void set_constants(const EvalBatch& batch, std::size_t row);
  void run_reference(EvalBatch& batch);

  Program program_;
  BatchProgram batch_program_;
  EvalEngine engine_;
  Rgba9 constant0_, constant1_;            // the program's, for the table of registers
  std::vector<EvalColumn> constants_;      // that the rows have
  std::vector<EvalColumn> own_constants_;  // that they do not have
};

}  // namespace ninebit::tools
