// Plots as pictures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ninebit/image/image_io.h"
#include "ninebit/study/report.h"

namespace ninebit {

// Whether a point has a place: its coordinates are numbers below 1e150 in size, and above 0 on a logarithmic axis.
[[nodiscard]] bool can_be_shown(const Plot& plot, const std::pair<double, double>& point);

// Where a plot with bars has them: each x that a point has, ascending.
[[nodiscard]] std::vector<double> bar_groups(const Plot& plot);

// What stands under the bars at x: its name or its number.
[[nodiscard]] std::string bar_label(const Plot& plot, double x);

// The plot on white, 1280 x 800: title, axes with round ticks, a legend where there is more than one series. The same
// bytes for the same plot and the same fonts; without any font Cairo's own strokes stand in. Reports what Cairo cannot
// do (no memory).
[[nodiscard]] Result<Image8> picture_of(const Plot& plot);

}  // namespace ninebit
