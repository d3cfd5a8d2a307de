#include "src/language/source/nearest_name.h"

#include <vector>

namespace ninebit {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

// One row of the table per letter of `a`, of which only those places count that are at most `most` off the diagonal; a
// swap reads the row before the last. No row falls below the smaller of the two before it.
std::size_t name_changes(std::string_view a, std::string_view b, std::size_t most) {
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

}  // namespace ninebit
