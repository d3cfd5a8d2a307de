// Guesses the kind of a file, so that the error for a file of the wrong kind names the kind instead of listing every
// fault.
#pragma once

#include <string>
#include <string_view>

#include "src/language/json/text_kind.h"

namespace ninebit::tools {

// The kinds that ninebit reads, as kind_of_file() returns them.
inline constexpr std::string_view kGlKind = "GL calls", kSourceKind = "a source file with GL calls",
                                  kRc10Kind = "an !!RC1.0 program", kShaderKind = "a ps.1.x pixel shader",
                                  kWordsKind = "register words", kJsonProgramKind = "a combiner program as JSON",
                                  kJsonWordsKind = "register words as JSON", kProfileKind = "a hardware profile",
                                  kEffectKind = "an effect", kPartKind = "a part of a study",
                                  kTableKind = "a table of comma-separated values", kJsonKind = "JSON of another kind",
                                  kXboxKind = "an Xbox pixel shader definition", kLogKind = "a log of register writes",
                                  kBinaryKind = "a binary file";

// The kind of a file, with its article: "a PNG picture", "a shell script"; empty if it is unknown. The first thousand
// bytes are enough; more is searched only for words in a text. The result is a guess, for error messages only.
[[nodiscard]] std::string kind_of_file(std::string_view bytes);

}  // namespace ninebit::tools
