// The grammar of flags that take a list: values separated by commas; values that contain commas themselves, by
// semicolons; a range of whole numbers as FIRST-LAST.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::tools {

// The items of a list.
[[nodiscard]] std::vector<std::string> items_of(std::string_view list, char separator = ',');

// The whole numbers of a list such as 1,2,4-6, in their order; empty if an item is neither a number nor a range, or
// there are more than 4,096.
[[nodiscard]] std::optional<std::vector<int>> whole_numbers_in(std::string_view list);

// A validator that requires each item to be one of `known`, at most once.
[[nodiscard]] CLI::Validator list_of(std::vector<std::string> known);

// A validator that checks the list as a whole. `parse` returns something false if the list is not valid; `expected`
// completes "invalid list 'x'; expected a list of …".
template <class Parse>
[[nodiscard]] CLI::Validator list_by(Parse parse, std::string expected) {
  const auto check = [parse, expected = std::move(expected)](const std::string& text) -> std::string {
    return parse(text) ? "" : "invalid list '" + text + "'; expected a list of " + expected;
  };
  return CLI::Validator(check, "");
}

}  // namespace ninebit::tools
