// The registers and constants of a fragment that somebody gives, where no draw makes them.
#pragma once

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"

namespace ninebit {

// The registers before any is given: 0, but for the alpha of fog and of the textures, which is 1.0. Spare0's alpha is
// that of texture 0 where it is not given either.
[[nodiscard]] RegisterFile default_registers(const HardwareProfile& profile);

// Gives a constant's component a code, in all general combiners and in the final combiner.
void replace_constant(Program& program, Register constant, int component, s9 code);

}  // namespace ninebit
