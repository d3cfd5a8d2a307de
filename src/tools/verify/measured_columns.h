// Short forms for the columns of measured tables.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "src/tools/verify/measured_table.h"

namespace ninebit::tools::columns_of_tables {

using Column = MeasuredColumn;
using Kind = MeasuredColumn::Kind;

inline Column whole(std::string_view name, std::int64_t low, std::int64_t high) {
  return {name, Kind::whole, low, high};
}
inline Column byte(std::string_view name) {
  return whole(name, 0, 255);
}

// Columns of one kind, from their part of the header.
inline void add(std::vector<Column>& to, std::string_view names, Column like) {
  for (const std::string_view name : pieces(names, ',')) {
    like.name = name;
    to.push_back(like);
  }
}
inline std::vector<Column> columns(std::initializer_list<std::pair<std::string_view, Column>> groups) {
  std::vector<Column> all;
  for (const auto& [names, like] : groups) add(all, names, like);
  return all;
}

}  // namespace ninebit::tools::columns_of_tables
