// What a file seems to be, so that one of another kind gets one line that names it instead of all that is wrong with
// it.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::tools {

// The kinds that ninebit reads itself, as kind_of_file() gives them.
inline constexpr std::string_view kGlKind = "GL calls", kRc10Kind = "an !!RC1.0 program", kWordsKind = "register words",
                                  kJsonProgramKind = "a combiner program as JSON",
                                  kJsonWordsKind = "register words as JSON", kProfileKind = "a hardware profile",
                                  kPartKind = "a part of a study", kTableKind = "a table of comma-separated values",
                                  kJsonKind = "JSON of another kind";

// What a file seems to be, with its article: "a PNG picture", "a shell script". Empty: nothing that is known here. The
// first thousand bytes are enough; more is looked at only for words in a text. It is a guess: who can read the file
// reads it.
[[nodiscard]] std::string kind_of_file(std::string_view bytes);

// The text without white space and comments at its beginning; every form of a program but JSON may start with those.
[[nodiscard]] std::string_view without_heading(std::string_view text);

// "NAME =" with a name such as RC_IN_RGB[0].
[[nodiscard]] bool is_assignment(std::string_view text);

// What the text of a JSON object says that it is: "program" of "ninebit": "program", spaces or not; empty: nothing.
[[nodiscard]] std::string_view json_kind(std::string_view text);

}  // namespace ninebit::tools
