// Which operations a program runs, and in which order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "src/combiner/value_graph.h"
#include "src/combiner/vector_code.h"

namespace ninebit::detail {

// An operation whose planes are not chosen yet.
struct PlannedOperation {
  Value value = 0;  // its result
  Formula formula;
  std::uint32_t lines = 0;  // as in VectorOperation
  std::array<Line, kMostSources> line{};
  std::array<Value, kMostSources> of{};

  // Whether they differ in their planes alone.
  [[nodiscard]] bool is_like(const PlannedOperation& other) const {
    return formula == other.formula && lines == other.lines && line == other.line;
  }
};

// The operations that the wanted values need. Affine operations that only products read become lines of those. Like
// operations come one after the other where that is possible.
std::vector<PlannedOperation> plan(const ValueGraph& graph, std::span<const Value> wanted);

// Compiles a program of integer arithmetic to vector operations.

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
