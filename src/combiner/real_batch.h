// The batch evaluator for programs whose arithmetic is not integer.
#pragma once

#include <cstddef>

#include "ninebit/combiner/evaluate.h"

namespace ninebit {

void evaluate_real_batch(const Program& program, RegisterBatch& registers, std::size_t count, OutputBatch& out);

}  // namespace ninebit
