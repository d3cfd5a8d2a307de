// Guesses the kind of a file, so that the error for a file of the wrong kind names the kind instead of listing every
// fault.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::tools {

// The kinds that ninebit reads, as kind_of_file() returns them.
inline constexpr std::string_view kGlKind = "GL calls", kRc10Kind = "an !!RC1.0 program", kWordsKind = "register words",
                                  kJsonProgramKind = "a combiner program as JSON",
                                  kJsonWordsKind = "register words as JSON", kProfileKind = "a hardware profile",
                                  kPartKind = "a part of a study", kTableKind = "a table of comma-separated values",
                                  kJsonKind = "JSON of another kind";

// The kind of a file, with its article: "a PNG picture", "a shell script"; empty if it is unknown. The first thousand
// bytes are enough; more is searched only for words in a text. The result is a guess, for error messages only.
[[nodiscard]] std::string kind_of_file(std::string_view bytes);

// The text without leading white space and comments, which every program form except JSON may have.
[[nodiscard]] std::string_view without_heading(std::string_view text);

// Whether the text starts with "NAME =", with a name such as RC_IN_RGB[0].
[[nodiscard]] bool is_assignment(std::string_view text);

// The value of the key "ninebit" in the text of a JSON object, such as "program"; empty without the key.
[[nodiscard]] std::string_view json_kind(std::string_view text);

}  // namespace ninebit::tools
