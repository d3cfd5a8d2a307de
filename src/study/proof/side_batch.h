// A part of a side's program over batches of cases, where constants that are not set vary, too.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "src/study/proof/subject.h"

namespace ninebit::proof {

class SideBatch {
 public:
  // `side` must outlive it. Without a program run() does nothing.
  SideBatch(const Subject& side, const std::optional<Program>& program, const BatchOutputs& outputs);

  // The values of one of the side's components, one a case.
  [[nodiscard]] s9* plane(int index);
  // Runs the cases; registers change only if `outputs` has them, or for real numbers.
  void run(std::size_t count, OutputBatch& out);

 private:
  void run_in_rows(std::size_t count, OutputBatch& out);

  const Subject& side_;
  std::optional<Program> program_;
  BatchOutputs outputs_;
  std::optional<BatchProgram> batch_;  // none if cases are run one after another
  std::array<std::optional<ConstantName>, 2> varying_{};
  std::unique_ptr<RegisterBatch> registers_;
  std::vector<std::array<s9, kBatchSize>> constants_;  // of side_.components past the registers
};

}  // namespace ninebit::proof
