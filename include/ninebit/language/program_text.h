// Programs in any form, which is detected from their content. In the library of the JSON forms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The forms of a program's text.
enum class ProgramForm : std::uint8_t {
  gl,          // GL calls: gl_calls.h
  source,      // a source file with GL calls in it: source_code.h
  rc10,        // !!RC1.0: rc10.h
  ps,          // a pixel shader of Direct3D 8 in assembly: pixel_shader.h
  words,       // register words as text: register_words.h
  words_json,  // register words as a JSON object: json.h
  json,        // the canonical form: json.h
  xbox,        // the Xbox's pixel shader definition, as text or as its bytes: xbox_pixel_shader.h
  log          // a log of register writes, of which one set-up is the program: register_log.h
};

// The form that a text seems to have; GL calls if it is none of the others.
[[nodiscard]] ProgramForm form_of(std::string_view text);

// The chip whose register words a profile reads: NV20 with per-stage constants, else NV10.
[[nodiscard]] ChipClass chip_of(const HardwareProfile& profile);

// Choices that the text alone does not decide.
struct ReadOptions {
  std::optional<ChipClass> chip{};  // of register words; empty: that of the profile, of a log that of its objects
  std::size_t setup = 0;            // the combiner set-up of a log, from 1; 0: the only one
  SourceSelection source{};         // of a source; its definitions also of a pixel shader
};

// A program, and the words beside it that combiners do not read, such as the Xbox's texture modes.
struct TextProgram {
  CombinerState state{};                    // the program, not yet validated
  std::vector<RegisterWord> other_words{};  // in the order of the text
};

// Parses a program in this form. Reports what the form's parser reports.
[[nodiscard]] Parsed<TextProgram> parse_program(const SourceText& source, ProgramForm form,
                                                const HardwareProfile& profile, const ReadOptions& options = {});

}  // namespace ninebit
