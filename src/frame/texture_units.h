// Counting the texture units that a technique needs.
#pragma once

#include "ninebit/combiner/program.h"

namespace ninebit {

// The number of texture registers that the program's output colour depends on.
[[nodiscard]] int texture_units_read(const Program& program);

}  // namespace ninebit
