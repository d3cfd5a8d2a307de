// Plots and heat maps as SVG files, for slides and papers: with title, axes, legend or colour bar, and caption.
#pragma once

#include <string>

#include "ninebit/numerics/result.h"
#include "ninebit/study/report.h"

namespace ninebit {

// The plot, on white paper. Points that its axes have no place for are left out, as on the page.
[[nodiscard]] std::string svg_of(const Plot& plot);

// The heat map, on white paper, with its values as a picture. Reports the errors of check_size.
[[nodiscard]] Result<std::string> svg_of(const HeatMap& map);

}  // namespace ninebit
