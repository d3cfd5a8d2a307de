// Suggestions for misspelled names: "did you mean …?".
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/system/characters.h"

namespace ninebit {

// How many letters must be inserted, removed, replaced or swapped with the next one to make `a` of `b`; case is
// ignored. A number above `most` where it is more than that.
[[nodiscard]] inline std::size_t name_changes(std::string_view a, std::string_view b, std::size_t most) {
  using detail::lower;
  // One row of the table per letter of `a`, of which only those places count that are at most `most` off the diagonal;
  // a swap reads the row before the last. No row falls below the smaller of the two before it.
  const std::size_t more = most + 1;
  std::vector<std::size_t> before(b.size() + 1, more), last(b.size() + 1, more), row(b.size() + 1, more);
  for (std::size_t j = 0; j <= std::min(b.size(), most); ++j) last[j] = j;
  std::size_t least_before = 0;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    const std::size_t begin = i > most ? i - most : 0, end = std::min(b.size(), i + most);
    std::fill(row.begin(), row.end(), more);
    std::size_t least = more;
    for (std::size_t j = begin; j <= end; ++j) {
      if (j == 0) {
        row[0] = i;
      } else {
        const bool same = lower(a[i - 1]) == lower(b[j - 1]);
        row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1), more});
        const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
        if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
      }
      least = std::min(least, row[j]);
    }
    if (std::min(least, least_before) > most) return more;
    least_before = least;
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

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
