// The !!RC1.0 language of NVIDIA's nvparse, with the !!TS1.0 of the stages before the combiners.
#pragma once

#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// Translates a program as nvparse did. docs/languages.md lists where nvparse was wrong and what ninebit does instead:
// `one` means one in every spelling. Makes every error check of the language and reports all faults. With
// `texture_shader`, a part !!TS1.0 is read into it, and may stand alone: the combiners then have OpenGL's defaults, as
// a note says. Without it, that part is skipped, with a note.
[[nodiscard]] Parsed<CombinerState> parse_rc10(const SourceText& source, const HardwareProfile& profile,
                                               TextureShaderState* texture_shader = nullptr);

// The state as a program text, or a Diagnostic that names what the language cannot express. parse_rc10 of the text
// returns a state that normalizes to the same program. If `texture_shader` is enabled, !!TS1.0 stands before !!RC1.0,
// with what its operations read; the rules of consistency are OpenGL's.
[[nodiscard]] Result<std::string> print_rc10(const CombinerState& state, const HardwareProfile& profile,
                                             const TextureShaderState& texture_shader = {});

}  // namespace ninebit
