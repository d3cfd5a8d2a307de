// An axis of a plot: its range and its round ticks.
#pragma once

#include <string>
#include <vector>

namespace ninebit {

struct Tick {
  double value = 0.0;
  std::string label{};  // empty: an unlabelled grid line between labelled ones
};

struct Axis {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  std::vector<Tick> ticks{};  // within low … high, ascending

  // The position of a value: 0 at low, 1 at high.
  [[nodiscard]] double place(double value) const;
};

// An axis that contains all `values`, with about `wanted` ticks, whose step is 1, 2 or 5 times a power of ten.
// `from_zero`: the axis includes 0 whatever the values; without it, only if 0 is near. Without values: 0 to 1.
[[nodiscard]] Axis linear_axis(const std::vector<double>& values, int wanted, bool from_zero);

// A logarithmic axis with ticks at powers of ten and, if these are few, at 2 and 5 times powers of ten. Values must be
// positive. Without values: 1 to 10.
[[nodiscard]] Axis logarithmic_axis(const std::vector<double>& values, int wanted);

}  // namespace ninebit
