// A trace as people read it.
#pragma once

#include <string>

#include "ninebit/combiner/trace.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// Tables of aligned columns, one for each portion: what the hardware holds, the number that this is, and the ideal one.
// `colors`: with escape sequences that make losses and cuts stand out.
[[nodiscard]] std::string trace_text(const Program& program, const Trace& trace, bool colors);

}  // namespace ninebit::tools
