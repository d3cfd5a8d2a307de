// The rival of the batch: the combiners as emulators of that hardware run them, a fragment at a time in floats.
#pragma once

#include <cstddef>
#include <span>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::bench {

// Runs a program over fragments.size() fragments, whatever the program's own arithmetic. As in MAME's style: registers
// are floats in [-1, 1]; for each fragment the stages' settings are looked at anew, each input is fetched and mapped by
// a switch, each output is biased, scaled and clamped; the colour leaves as codes rounded to nearest. It follows the
// equations of NV_register_combiners and shares no code with the library's engines. `colors` has room for as many.
void evaluate_scalar_float(const Program& program, std::span<const RegisterFile> fragments, Rgba9* colors);

}  // namespace ninebit::bench
