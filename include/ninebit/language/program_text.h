// Programs in any form, which is detected from their content. In the library of the JSON forms.
#pragma once

#include <cstdint>
#include <string_view>

#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The forms of a program's text.
enum class ProgramForm : std::uint8_t {
  gl,          // GL calls: gl_calls.h
  rc10,        // !!RC1.0: rc10.h
  words,       // register words as text: register_words.h
  words_json,  // register words as a JSON object: json.h
  json         // the canonical form: json.h
};

// The form that a text seems to have; GL calls if it is none of the others.
[[nodiscard]] ProgramForm form_of(std::string_view text);

// The chip whose register words a profile reads: NV20 with per-stage constants, else NV10.
[[nodiscard]] ChipClass chip_of(const HardwareProfile& profile);

// Parses a program in this form. `chip` is of register words. Reports what the form's parser reports.
[[nodiscard]] Parsed<CombinerState> parse_program(const SourceText& source, ProgramForm form, ChipClass chip,
                                                  const HardwareProfile& profile);

}  // namespace ninebit
