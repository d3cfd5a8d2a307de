// Tables whose rows are found by one of their members.
#pragma once

#include <algorithm>
#include <iterator>

namespace ninebit {

// The first row with this value; nullptr: there is none.
template <class Table, class Row, class Member, class Value>
[[nodiscard]] constexpr auto* find_row(Table&& table, Member Row::*member, const Value& value) {
  const auto found =
      std::find_if(std::begin(table), std::end(table), [&](const auto& row) { return row.*member == value; });
  return found == std::end(table) ? nullptr : &*found;
}

}  // namespace ninebit
