// Files of NVIDIA's fp20 profile: an !!RC1.0 program beside programs for the units before it, one after the other.
#pragma once

#include <optional>
#include <string>

#include "src/language/source/source_faults.h"

namespace ninebit::detail {

// The text with its other parts, such as !!TS1.0, replaced by blanks, each named by a note; empty: there are none.
// Reports parts whose headers are unknown.
[[nodiscard]] std::optional<std::string> only_rc10(std::string_view text, SourceFaults& faults, SourceFaults& notes);

}  // namespace ninebit::detail
