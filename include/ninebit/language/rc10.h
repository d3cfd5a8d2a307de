// The !!RC1.0 language of NVIDIA's nvparse.
#pragma once

#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Translates a program as nvparse did. docs/languages.md lists where nvparse was wrong and what ninebit does instead:
// `one` means one in every spelling. Makes every error check of the language and reports all faults.
[[nodiscard]] Parsed<CombinerState> parse_rc10(const SourceText& source, const HardwareProfile& profile);

// The state as a program text, or a Diagnostic that names what the language cannot express. parse_rc10 of the text
// returns a state that normalizes to the same program.
[[nodiscard]] Result<std::string> print_rc10(const CombinerState& state, const HardwareProfile& profile);

}  // namespace ninebit
