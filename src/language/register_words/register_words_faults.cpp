#include "src/language/register_words/register_words_faults.h"

#include <algorithm>
#include <tuple>

namespace ninebit {

std::vector<TextFault> TextFaults::take() {
  std::stable_sort(faults_.begin(), faults_.end(), [](const TextFault& left, const TextFault& right) {
    return std::tie(left.line, left.column) < std::tie(right.line, right.column);
  });
  return std::exchange(faults_, {});
}

bool too_long(std::string_view text, TextFaults& faults) {
  if (text.size() <= kMaxSourceBytes) return false;
  faults.add({},
             "the text has " + std::to_string(text.size()) + " bytes; the limit is " + std::to_string(kMaxSourceBytes));
  return true;
}

}  // namespace ninebit
