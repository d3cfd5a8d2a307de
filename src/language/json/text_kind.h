// What the beginning of a text says about its kind.
#pragma once

#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The text without leading white space and comments, which every program form except JSON may have.
[[nodiscard]] std::string_view without_heading(std::string_view text);

// Whether the text starts with "NAME = NUMBER", with a name such as RC_IN_RGB[0].
[[nodiscard]] bool is_assignment(std::string_view text);

// The value of the key "ninebit" in the text of a JSON object, such as "program"; empty without the key.
[[nodiscard]] std::string_view json_kind(std::string_view text);

}  // namespace ninebit
