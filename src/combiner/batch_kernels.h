// The kernels. They are compiled once for every SIMD target; the best one is chosen at run time.
#pragma once

#include <cstddef>

#include "src/combiner/vector_code.h"

namespace ninebit::detail {

// Runs the operations over the first `count` lanes, rounded up to whole vectors.
void run_vector_code(const VectorCode& code, RegisterBatch& registers, std::size_t count, OutputBatch& out);

}  // namespace ninebit::detail
