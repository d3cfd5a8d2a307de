// The batch evaluator for programs whose arithmetic is not integer.
#pragma once

#include <cstddef>
#include <memory>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

void evaluate_real_batch(const Program& program, RegisterBatch& registers, std::size_t count, OutputBatch& out);

// The colour of fragment after fragment in exact numbers: evaluate_real's `color`, faster, each number within 1e-11 of
// the exact one instead of the nearest double. For one thread.
class ExactColors {
 public:
  // The program's constants may change between fragments, nothing else; the program must outlive this.
  explicit ExactColors(const Program& program);
  ~ExactColors();
  ExactColors(ExactColors&&) noexcept;

  [[nodiscard]] RealColor operator()(const RegisterFile& initial);

 private:
  struct Runners;
  std::unique_ptr<Runners> runners_;
};

}  // namespace ninebit
