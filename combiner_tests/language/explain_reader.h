// Computes what an equation of explain says, from its text alone, in real numbers: a reader of the equations that knows
// nothing of the code which writes them.
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::test {

using Real3 = std::array<double, 3>;

// The red, green and blue of an expression; in an alpha portion all three are the value. `constants` are const0 and
// const1 where the equation stands. Throws std::runtime_error with the place of what it cannot read.
Real3 value_of(std::string_view expression, const Datapath& datapath, const RegisterFile& registers,
               const Rgba9& constant0, const Rgba9& constant1);

}  // namespace ninebit::test
