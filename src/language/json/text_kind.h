// The kind of a text by its beginning.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The text without leading white space.
[[nodiscard]] std::string_view without_space(std::string_view text);

// The text without leading white space and comments, which every program form except JSON may have.
[[nodiscard]] std::string_view without_heading(std::string_view text);

// Whether the text seems to be JSON: its first bracket has JSON's values behind it, and nothing follows an array of
// plain values. A prefix such as "[0x27A0]" or "[12]" and a structure such as "{a = 1}" are not JSON.
[[nodiscard]] bool is_json(std::string_view text);

// Whether the text starts with "NAME = NUMBER", with a name such as RC_IN_RGB[0].
[[nodiscard]] bool is_assignment(std::string_view text);

// The text with blanks in place of a bracketed prefix before each of its lines, such as "[0x27A0] xps.1.1", so that all
// places stay the same. Empty: a line has no prefix, or the text is JSON.
[[nodiscard]] std::optional<std::string> without_line_prefixes(std::string_view text);

// The value of the key "ninebit" in the text of a JSON object, such as "program"; empty without the key.
[[nodiscard]] std::string_view json_kind(std::string_view text);

}  // namespace ninebit
