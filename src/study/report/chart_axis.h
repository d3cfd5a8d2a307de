// Axes of plots and heat maps in SVG files.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace ninebit {

// A place on an axis, and what stands there.
struct Tick {
  double value = 0.0;
  std::string label{};
};

// An axis from `low` to `high`. Logarithmic ones have both above 0.
struct ChartAxis {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  std::vector<Tick> ticks{};

  // The share of the way from low to high, 0 to 1.
  [[nodiscard]] double share_of(double value) const;
};

// Round numbers between two ends, about `count` of them; whole ones alone if `whole`.
[[nodiscard]] std::vector<Tick> round_ticks(double low, double high, int count, bool whole);

// The axis of values in any order: its ends are round numbers, and 0 is one of them if `from_zero`. Powers of ten label
// a logarithmic axis, and 2 and 5 times these if they are few. Without a value it goes from 0, or from 1, to the next
// power of ten.
[[nodiscard]] ChartAxis axis_of(std::span<const double> values, bool logarithmic, bool from_zero);

}  // namespace ninebit
