// The registers and constants of a fragment that somebody gives, where no draw makes them.
#pragma once

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"

namespace ninebit {

// The registers before any is given: those of a fragment whose bytes are 0, with fog and all texture units off, as the
// profile defines them. A caller that is given texture 0's alpha, but not spare0's, copies it there.
[[nodiscard]] RegisterFile default_registers(const HardwareProfile& profile);

// Gives a constant's component a code, in all general combiners and in the final combiner.
void replace_constant(Program& program, Register constant, int component, s9 code);

}  // namespace ninebit
