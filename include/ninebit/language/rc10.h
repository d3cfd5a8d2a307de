// The !!RC1.0 language of NVIDIA's nvparse.
#pragma once

#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Translates a program as nvparse did (docs/languages.md says where it was wrong and what ninebit does instead: `one`
// means one in every spelling). Every error check of the language is made; all faults are reported.
[[nodiscard]] Parsed<CombinerState> parse_rc10(const SourceText& source, const HardwareProfile& profile);

// The program of a state, or a Diagnostic that says what of it the language cannot express. parse_rc10 gives a state
// that normalizes to the same program.
[[nodiscard]] Result<std::string> print_rc10(const CombinerState& state, const HardwareProfile& profile);

}  // namespace ninebit
