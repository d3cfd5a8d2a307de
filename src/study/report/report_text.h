// Texts of reports, in pages and SVG files: markup is shown and not run, numbers are for people. And the points that a
// plot shows there.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/study/report.h"

namespace ninebit {

// The text between tags or in a quoted attribute.
[[nodiscard]] std::string escaped(std::string_view text);

// A number with groups of three digits; reals have six significant digits.
[[nodiscard]] std::string readable(const StudyValue& value);

// Whether the x of all points stand at equal distances: bars, and even_x.
[[nodiscard]] inline bool is_even(const Plot& plot) {
  return plot.bars || plot.even_x;
}

// Whether the plot's axes have a place for a point: logarithmic ones have none for 0 and below.
[[nodiscard]] bool can_be_shown(const Plot& plot, const std::pair<double, double>& point);

// Each x of a point that can be shown, ascending: the positions of an even plot.
[[nodiscard]] std::vector<double> even_positions(const Plot& plot);

// The label of a position: its name or number.
[[nodiscard]] std::string position_label(const Plot& plot, double x);

}  // namespace ninebit
