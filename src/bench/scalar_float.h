// The rival of the batch evaluator: the combiners in floats, one fragment at a time, as emulators of that hardware do.
#pragma once

#include <cstddef>
#include <span>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::bench {

// Runs a program over fragments.size() fragments in floats, whatever the program's own arithmetic. The style is MAME's:
// registers are floats in [-1, 1]; the stages' settings are read again for each fragment, each input is fetched and
// mapped by a switch, each output is biased, scaled and clamped; the colour is rounded to the nearest codes. The code
// follows the equations of NV_register_combiners and shares nothing with the library's engines. `colors` has room for
// fragments.size() colours.
void evaluate_scalar_float(const Program& program, std::span<const RegisterFile> fragments, Rgba9* colors);

}  // namespace ninebit::bench
