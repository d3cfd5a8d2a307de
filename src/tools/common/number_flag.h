// Range checks of flags that take one number or a list of numbers.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>

#include "src/system/number_list.h"

namespace ninebit::tools {

// The largest coordinate or distance of a scene; see scene_io.h.
inline constexpr double kMostDistance = 1e12;
// About ten years; a longer time is a mistake.
inline constexpr double kMostSeconds = 3e8;

// Whether the text is `count` numbers between separators, all finite and in range. A number that the type cannot hold
// is out of range.
template <class T>
[[nodiscard]] bool are_numbers_in(std::string_view text, char separator, std::size_t count, double least,
                                  double greatest) {
  const auto n = numbers<T>(text, separator);
  return n && n->size() == count && std::all_of(n->begin(), n->end(), [&](T value) {
           return static_cast<double>(value) >= least && static_cast<double>(value) <= greatest;  // false for NaN
         });
}

// One real number in range; CLI11's own check accepts NaN.
[[nodiscard]] CLI::Validator real_in_range(double least, double greatest);

}  // namespace ninebit::tools
