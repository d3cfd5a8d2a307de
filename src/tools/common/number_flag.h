// Flags that take one number or a list of numbers: what is in range, and what a message says of the rest.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>

#include "src/tools/common/number_list.h"

namespace ninebit::tools {

// No scene has a coordinate or a distance beyond this; see scene_io.h.
inline constexpr double kMostDistance = 1e12;
// Beyond ten years a time is a mistake.
inline constexpr double kMostSeconds = 3e8;

// Whether the text is so many numbers with separators between them, all of them finite and in range. A number that its
// type cannot hold is not in range.
template <class T>
[[nodiscard]] bool are_numbers_in(std::string_view text, char separator, std::size_t count, double least,
                                  double greatest) {
  const auto n = numbers<T>(text, separator);
  return n && n->size() == count && std::all_of(n->begin(), n->end(), [&](T value) {
           return static_cast<double>(value) >= least && static_cast<double>(value) <= greatest;  // false for NaN
         });
}

// One real number in range; CLI11's own check lets NaN through.
[[nodiscard]] CLI::Validator real_in_range(double least, double greatest);

}  // namespace ninebit::tools
