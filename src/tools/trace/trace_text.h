// A trace as text for people.
#pragma once

#include <string>

#include "ninebit/combiner/trace.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// How a trace looks on the reader's terminal.
struct TraceLayout {
  bool colors = false;  // escape sequences highlight losses and cuts
  int columns = 80;     // of the terminal; at least 80 are used
};

// One table per portion, with aligned columns: the code that the hardware holds, the number that it represents, and the
// ideal number.
[[nodiscard]] std::string trace_text(const Program& program, const Trace& trace, TraceLayout layout);

}  // namespace ninebit::tools
