// A trace as JSON, in the library ninebit::json.
#pragma once

#include <string>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// One object, indented by two spaces; docs/languages.md lists its members. `trace` must be of this program.
[[nodiscard]] std::string print_json_trace(const Program& program, const Trace& trace);

}  // namespace ninebit
