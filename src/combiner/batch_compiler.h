// Compiles a program of integer arithmetic to vector operations.
#pragma once

#include "ninebit/combiner/batch_program.h"
#include "src/combiner/value_graph.h"
#include "src/combiner/vector_code.h"

namespace ninebit::detail {

// A wanted plane, and the value that it holds at the end.
struct WantedValue {
  PlanePlace plane;
  Value value = 0;
};

VectorCode compile_batch(const Program& program, const BatchOutputs& outputs, const ComponentSet& varying_constants,
                         BatchInputs inputs);

// Orders the operations that the wanted values need, and assigns planes to them.
VectorCode schedule(const ValueGraph& graph, const std::vector<WantedValue>& wanted);

}  // namespace ninebit::detail
