// Which register components a value depends on.
#pragma once

#include <array>

#include "src/study/proof/proof_side.h"

namespace ninebit::proof {

// By component after a general combiner: the components at the start of the flow that it depends on.
using ComponentFlow = std::array<ComponentMask, kComponents>;

// Through the general combiners [from, to). A product with a factor that is always 0 depends on nothing.
[[nodiscard]] ComponentFlow flow_through(const Program& program, int from, int to);

// The components before general combiner `from` that the target depends on; after the last one if `from` is their
// number.
[[nodiscard]] ComponentMask reads_of(const Program& program, int from, const ProofTarget& target);

}  // namespace ninebit::proof
