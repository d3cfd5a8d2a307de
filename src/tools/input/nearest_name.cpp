#include "src/tools/input/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace ninebit::tools {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// The edit distance of two words, one row of the table per letter of `a`; a swap reads the row before the last.
std::size_t changes(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::move(last);
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view wrong, std::span<const std::string> names) {
  constexpr std::size_t kMost = 3, kLongest = 64;  // longer texts are not misspelled names
  if (wrong.size() > kLongest) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t fewest = kMost + 1;
  for (const std::string& name : names) {
    const std::size_t count = changes(wrong, name);
    if (count >= fewest || 3 * count > std::max(wrong.size(), name.size())) continue;
    fewest = count;
    nearest = name;
  }
  return nearest;
}

std::string did_you_mean(std::string_view wrong, std::span<const std::string> names) {
  const auto name = nearest_name(wrong, names);
  return name ? "; did you mean '" + *name + "'?" : "";
}

}  // namespace ninebit::tools
