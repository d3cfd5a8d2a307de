// A trace as text for people.
#pragma once

#include <string>

#include "ninebit/combiner/trace.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// One table per portion, with aligned columns: the code that the hardware holds, the number that it represents, and the
// ideal number. `colors` adds escape sequences that highlight losses and cuts.
[[nodiscard]] std::string trace_text(const Program& program, const Trace& trace, bool colors);

}  // namespace ninebit::tools
