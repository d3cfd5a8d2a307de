// Register words as NV10 (GeForce 256, GeForce 2) and NV20 class chips (GeForce3, NV2A) hold a program. The layouts and
// their sources stand in docs/languages.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Whose register layout: GeForce 256 and GeForce 2, or GeForce3 and NV2A.
enum class ChipClass : std::uint8_t { nv10, nv20 };

// "nv10" or "nv20".
[[nodiscard]] std::string_view name_of(ChipClass chip);

// One word by its name ("RC_IN_RGB[0]"; docs/languages.md lists the aliases), and where a text has it.
struct RegisterWord {
  std::string name{};       // such as "RC_IN_RGB[0]"
  std::uint32_t value = 0;  // all 32 bits
  TextPlace place{};        // 1:1 where there is no text
};

// Decodes `NAME = 0x…` lines in any order (comments from # or //; names in either case). A word with bits outside its
// valid mask, a reserved register code, an unknown or repeated name, a setting that the profile does not have and a
// state that OpenGL would refuse are faults. Words that are missing keep the value that encodes GL's default state. The
// same as a JSON object is parse_json_register_words of json.h.
[[nodiscard]] Parsed<CombinerState> parse_register_words(const SourceText& source, ChipClass chip,
                                                         const HardwareProfile& profile);

// The same of words that are already apart; `file` is for messages.
[[nodiscard]] Parsed<CombinerState> decode_register_words(std::span<const RegisterWord> given, std::string_view file,
                                                          ChipClass chip, const HardwareProfile& profile);

// The words of a state under their canonical names, or a Diagnostic that says what the chip cannot hold. Constants are
// rounded to bytes, as compile() rounds them. Stages past num_general_combiners are given where their portions differ
// from GL's defaults and the chip has them; the chip's words have no place for stage constants while
// per_stage_constants is off. Decoding gives a state that compiles to the same program.
[[nodiscard]] Result<std::vector<RegisterWord>> encode_register_words(const CombinerState& state, ChipClass chip,
                                                                      const HardwareProfile& profile);

// encode_register_words as `NAME = 0x…` lines.
[[nodiscard]] Result<std::string> print_register_words(const CombinerState& state, ChipClass chip,
                                                       const HardwareProfile& profile);

}  // namespace ninebit
