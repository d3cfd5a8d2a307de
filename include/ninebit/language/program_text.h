// Programs in any form, which is detected from their content. In the library of the JSON forms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// The forms that code names: indices into forms().
enum class ProgramForm : std::uint8_t {
  gl,          // GL calls: gl_calls.h
  rc10,        // !!RC1.0: rc10.h
  ps,          // a pixel shader of Direct3D 8 in assembly: pixel_shader.h
  tokens,      // an assembled pixel shader of Direct3D 8: pixel_shader.h
  xbox,        // the Xbox's pixel shader definition, as text or as its bytes: xbox_pixel_shader.h
  json,        // the canonical form: json.h
  words,       // register words as text: register_words.h
  words_json,  // register words as a JSON object: json.h
  source,      // a source file with GL calls in it: source_code.h
  log          // a log of register writes, of which one set-up is the program: register_log.h
};

// The chip whose register words a profile reads: NV20 with per-stage constants, else NV10.
[[nodiscard]] ChipClass chip_of(const HardwareProfile& profile);

// Choices that the text alone does not decide.
struct ReadOptions {
  std::optional<ChipClass> chip{};  // of register words; empty: that of the profile, of a log that of its objects
  std::size_t setup = 0;            // the combiner set-up of a log, from 1; 0: the only one
  SourceSelection source{};         // of a source; its definitions also of a pixel shader
};

// A program: both halves of a pixel, and the words that are read into neither.
struct TextProgram {
  CombinerState state{};                    // the combiners, not yet validated
  std::vector<RegisterWord> other_words{};  // of kOtherWordNames, in the order of the text
  TextureShaderState texture_shader{};      // the stages before them; enabled: the text has some
};

// The program of a log's set-up, as program_of() in register_log.h gives it, with its stages.
[[nodiscard]] Parsed<TextProgram> text_program_of(const RegisterLog& log, std::size_t setup, std::string_view file,
                                                  const HardwareProfile& profile);

// The faults of both halves: the diagnostics of the texture-shader stages, which have no place but that in their
// message, and then those of the combiners.
[[nodiscard]] std::vector<StateDiagnostic> validate(const TextProgram& program, const HardwareProfile& profile);

// A form of a program's text.
struct Form {
  std::string_view name{};   // as --from and --to name it: "rc10"
  std::string_view title{};  // in a list of choices: "!!RC1.0 (nvparse)"
  std::string_view kind{};   // in a sentence, with its article: "an !!RC1.0 program"
  // Whether a text seems to have the form; `content` is the text behind blanks and comments. Null: no text does.
  bool (*detect)(std::string_view text, std::string_view content) = nullptr;
  // Reads a program. Null: the form is only written.
  Parsed<TextProgram> (*parse)(const SourceText& source, const HardwareProfile& profile,
                               const ReadOptions& options) = nullptr;
  // Writes a valid program, or reports what the form cannot express. Null: the form is only read.
  Result<std::string> (*print)(const TextProgram& program, ChipClass chip, const HardwareProfile& profile) = nullptr;
  bool takes_definitions = false;  // reading uses ReadOptions::source.definitions
  bool has_words = false;          // the text is register words: reading uses ReadOptions::chip, writing the chip
  bool keeps_other_words = false;  // writing keeps TextProgram::other_words; of register words, those of NV20
  bool writes_values = false;      // a constant that is not set is written as 0
};

// All forms, in the order in which a text is tried. A new form is a row here.
[[nodiscard]] std::span<const Form> forms();
[[nodiscard]] const Form& form_row(ProgramForm form);
// The number of a row of forms().
[[nodiscard]] ProgramForm form_id(const Form& row);
// The form of this name, or nullptr.
[[nodiscard]] const Form* find_form(std::string_view name);
// The names of the forms that are read, and of those that are written.
[[nodiscard]] std::vector<std::string> read_form_names();
[[nodiscard]] std::vector<std::string> written_form_names();

// The first form that detects the text; empty: none. A bracketed prefix before each line, such as "[NVRC] ", is
// ignored, here and by parse_program().
[[nodiscard]] std::optional<ProgramForm> detected_form(std::string_view text);
// The same, and GL calls if none does.
[[nodiscard]] ProgramForm form_of(std::string_view text);

// Parses a program in this form. Reports what the form's parser reports.
[[nodiscard]] Parsed<TextProgram> parse_program(const SourceText& source, ProgramForm form,
                                                const HardwareProfile& profile, const ReadOptions& options = {});

}  // namespace ninebit
