// Guesses the kind of a file, so that the error for a file of the wrong kind names the kind instead of listing every
// fault.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "src/language/json/text_kind.h"

namespace ninebit::tools {

// Kinds as kind_of_file() returns them; those of programs are Form::kind.
inline constexpr std::string_view kProfileKind = "a hardware profile", kEffectKind = "an effect",
                                  kPartKind = "a part of a study", kTableKind = "a table of comma-separated values",
                                  kJsonKind = "JSON of another kind", kBinaryKind = "a binary file";

// The kind of a file, with its article: "a PNG picture", "a shell script"; empty if it is unknown. The first thousand
// bytes are enough; more is searched only for words in a text. The result is a guess, for error messages only.
[[nodiscard]] std::string kind_of_file(std::string_view bytes);

// The kind of file that a verb expects.
enum class FileRole { program, scene, picture, table, profile, effect, part };

// If a kind is of another role: one sentence that names it, and the verb that reads it or what was expected: "this is a
// glTF scene; `ninebit render` draws it". Empty for a kind of this role, and for one that is unknown.
[[nodiscard]] std::string wrong_kind(std::string_view kind, FileRole role);

// The fault of a file that could not be read in a role: replaced by wrong_kind() if the file's content explains it.
// Looks only at regular files.
[[nodiscard]] Diagnostic explained_by_kind(Diagnostic fault, const std::string& file, FileRole role);

}  // namespace ninebit::tools
