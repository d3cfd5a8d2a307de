// Numbers in one argument, such as 1024x768 or 1,2.5,-3.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace ninebit {

// The text as numbers between separators; empty if any part is not a number.
template <class T>
std::optional<std::vector<T>> numbers(std::string_view text, char separator) {
  std::vector<T> out;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    T value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{}) return std::nullopt;
    out.push_back(value);
    if (next == end) return out;
    if (*next != separator) return std::nullopt;
    at = next + 1;
  }
}

}  // namespace ninebit
