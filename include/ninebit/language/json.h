// The canonical form of a program as JSON, versioned; docs/program.schema.json describes it. Register words as JSON,
// too. These functions are in the library ninebit::json: ninebit::combiner needs no JSON library.
#pragma once

#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Reads {"ninebit": "program", "version": 1, …}. Keys that are missing have GL's defaults; unknown and repeated keys,
// unknown names and versions, values of a wrong type or range and states that GL refuses are faults that name their
// place. Where the text is no JSON at all, that is the only fault.
[[nodiscard]] Parsed<CombinerState> parse_json_program(const SourceText& source, const HardwareProfile& profile);

// The state in full, two spaces an indent; equal states give equal text, and parsing gives the same state again. Stages
// at the end that are past num_general_combiners and have GL's defaults are left out. Constants are printed as GL would
// hold them: clamped to [0, 1], NaN as 0.
[[nodiscard]] std::string print_json_program(const CombinerState& state);

// Register words as one object, {"RC_IN_RGB[0]": "0x04200000", …}, values also as whole numbers; "ninebit":
// "register_words", "version": 1 and "chip" are optional and must be right where they stand. Otherwise as
// parse_register_words.
[[nodiscard]] Parsed<CombinerState> parse_json_register_words(const SourceText& source, ChipClass chip,
                                                              const HardwareProfile& profile);

// encode_register_words as such an object.
[[nodiscard]] Result<std::string> print_json_register_words(const CombinerState& state, ChipClass chip,
                                                            const HardwareProfile& profile);

}  // namespace ninebit
