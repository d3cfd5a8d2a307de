// Suggestions for misspelled names: "did you mean …?".
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/numerics/visibility.h"

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {

// How many letters must be inserted, removed, replaced or swapped with the next one to make `wrong` of `name`; case is
// ignored. A number above `most` where it is more than that.
[[nodiscard]] std::size_t name_changes(std::string_view wrong, std::string_view name, std::size_t most);

// The name with the fewest changes from `wrong`; the first of several. Empty if the name needs more than three changes,
// or more than a third of the length of the longer word. `names` is a range of strings.
template <class Names>
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view wrong, const Names& names) {
  constexpr std::size_t kMost = 3, kLongest = 64;  // longer texts are not misspelled names
  if (wrong.size() > kLongest) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t fewest = kMost + 1;
  for (const std::string_view name : names) {
    const std::size_t longer = std::max(wrong.size(), name.size());
    if (longer - std::min(wrong.size(), name.size()) > kMost) continue;
    const std::size_t count = name_changes(wrong, name, fewest - 1);
    if (count >= fewest || 3 * count > longer) continue;
    fewest = count;
    nearest = name;
    if (fewest == 0) break;
  }
  return nearest;
}

// "; did you mean 'NAME'?", or empty.
template <class Names>
[[nodiscard]] std::string did_you_mean(std::string_view wrong, const Names& names) {
  const auto name = nearest_name(wrong, names);
  return name ? "; did you mean '" + *name + "'?" : "";
}

}  // namespace ninebit
