// The batch evaluator for programs whose arithmetic is not integer.
#pragma once

#include <cstddef>
#include <memory>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

void evaluate_real_batch(const Program& program, RegisterBatch& registers, std::size_t count, OutputBatch& out);

// Computes evaluate_real's `color` in exact numbers for one fragment after another, faster: each number is within 1e-11
// of the exact one instead of the nearest double. Not thread-safe.
class ExactColors {
 public:
  // The program must outlive this object. Between fragments only its constants may change.
  explicit ExactColors(const Program& program);
  ~ExactColors();
  ExactColors(ExactColors&&) noexcept;

  [[nodiscard]] RealColor operator()(const RegisterFile& initial);

 private:
  struct Runners;
  std::unique_ptr<Runners> runners_;
};

}  // namespace ninebit
