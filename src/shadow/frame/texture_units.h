// Counting the texture units that a technique needs.
#pragma once

#include "ninebit/combiner/program.h"

namespace ninebit {

// How many texture registers the colour that leaves the program depends on.
[[nodiscard]] int texture_units_read(const Program& program);

}  // namespace ninebit
