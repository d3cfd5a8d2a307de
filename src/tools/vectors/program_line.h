// A program of a pack as one line of JSON.
#pragma once

#include <string>

#include "ninebit/combiner/state.h"

namespace ninebit::tools {

// The canonical JSON form on one line, without what has its default value: parsing returns the same state.
[[nodiscard]] std::string program_line(const CombinerState& state);

}  // namespace ninebit::tools
