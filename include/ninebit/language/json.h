// The canonical JSON form of a program, with a version (docs/program.schema.json describes it), and register words as
// JSON. These functions are in the library ninebit::json, so that ninebit::combiner needs no JSON library.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// Reads {"ninebit": "program", "version": 1, …}. Missing keys have GL's defaults. Unknown and repeated keys, unknown
// names and versions, values of a wrong type or range and states that GL refuses are faults with their place. If the
// text is not JSON, that is the only fault. If there is a state, `other_words` receives those of the key "other_words",
// and `texture_shader` the stages of that key, which are read and checked in any case.
[[nodiscard]] Parsed<CombinerState> parse_json_program(const SourceText& source, const HardwareProfile& profile,
                                                       std::vector<RegisterWord>* other_words = nullptr,
                                                       TextureShaderState* texture_shader = nullptr);

// The full state, indented by two spaces; equal states give equal text, and parsing returns the same state. Trailing
// stages past num_general_combiners that have GL's defaults are omitted. Constants are printed as GL would store them:
// clamped to [0, 1], NaN as 0. `other_words` are printed if there are any; their names are of kOtherWordNames.
// `texture_shader` is printed if it is enabled, without what has its default; its numbers must be finite.
[[nodiscard]] std::string print_json_program(const CombinerState& state, std::span<const RegisterWord> other_words = {},
                                             const TextureShaderState& texture_shader = {});

// Register words as one object, {"RC_IN_RGB[0]": "0x04200000", …}, where values may also be whole numbers. The keys
// "ninebit": "register_words", "version": 1 and "chip" are optional and are checked if present. Otherwise like
// parse_register_words.
[[nodiscard]] Parsed<CombinerState> parse_json_register_words(const SourceText& source, ChipClass chip,
                                                              const HardwareProfile& profile,
                                                              std::vector<RegisterWord>* other_words = nullptr);

// The result of encode_register_words as such an object, and then `other_words`, if the chip is NV20.
[[nodiscard]] Result<std::string> print_json_register_words(const CombinerState& state, ChipClass chip,
                                                            const HardwareProfile& profile,
                                                            std::span<const RegisterWord> other_words = {});

}  // namespace ninebit
