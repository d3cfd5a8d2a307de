// The kernels. They are compiled once for every SIMD target; the best one is chosen at run time.
#pragma once

#include <cstddef>

#include "src/combiner/vector_code.h"

namespace ninebit::detail {

// Chooses the operations' kernels on the machine's best SIMD target.
void prepare_vector_code(VectorCode& code);

// Runs the operations over the first `count` lanes, rounded up to whole vectors.
void run_vector_code(const VectorCode& code, RegisterBatch& registers, std::size_t count, OutputBatch& out);

}  // namespace ninebit::detail
