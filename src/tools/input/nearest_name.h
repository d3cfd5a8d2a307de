// Suggestions for misspelled names: "did you mean …?".
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ninebit::tools {

// The name with the fewest changes from `wrong`; the first of several. A change is a letter inserted, removed, replaced
// or swapped with the next one; case is ignored. Empty if the name needs more than three changes, or more than a third
// of the length of the longer word.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view wrong, std::span<const std::string> names);

// "; did you mean 'NAME'?", or empty.
[[nodiscard]] std::string did_you_mean(std::string_view wrong, std::span<const std::string> names);

}  // namespace ninebit::tools
