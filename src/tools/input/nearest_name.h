// "Did you mean …?": the name that somebody who wrote another one may have meant.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ninebit::tools {

// The name that is fewest changes away from `wrong`, a change being a letter inserted, left out, replaced or swapped
// with the next one; the first of several. Empty where even that needs more changes than a third of the longer word has
// letters, or more than three. Lower and upper case count as the same.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view wrong, std::span<const std::string> names);

// "; did you mean 'NAME'?", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view wrong, std::span<const std::string> names);

}  // namespace ninebit::tools
