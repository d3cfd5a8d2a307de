// Draws plots as pictures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ninebit/image/image_io.h"
#include "ninebit/study/report.h"

namespace ninebit {

// True if the plot can show the point: the absolute values of its coordinates are below 1e150, and a coordinate on a
// logarithmic axis is above 0.
[[nodiscard]] bool can_be_shown(const Plot& plot, const std::pair<double, double>& point);

// The positions of a plot's bars: each x of a point, ascending.
[[nodiscard]] std::vector<double> bar_groups(const Plot& plot);

// The label under the bars at x: their name or number.
[[nodiscard]] std::string bar_label(const Plot& plot, double x);

// The plot on white, 1280 x 800: title, axes with round ticks, a legend if there is more than one series. The same plot
// and the same fonts give the same bytes; without any font, Cairo uses its own strokes. Reports Cairo's errors, such as
// lack of memory.
[[nodiscard]] Result<Image8> picture_of(const Plot& plot);

}  // namespace ninebit
