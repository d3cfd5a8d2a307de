// Checks of the words in measured tables.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "src/effect/effect_words.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {

using effect_detail::value_of;
using effect_detail::Words;

// The fault of the word in a column; empty: none.
template <class T, std::size_t N>
[[nodiscard]] std::string wrong_word(const MeasuredRow& row, std::string_view column, const Words<T, N>& words) {
  if (value_of(words, row.text(column))) return "";
  return fmt::format("{} must be one of {}, not '{}'", column, effect_detail::list_of(words), shown(row.text(column)));
}

}  // namespace ninebit::tools
