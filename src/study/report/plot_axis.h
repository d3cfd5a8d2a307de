// An axis of a plot: from which value to which, and where its round ticks stand.
#pragma once

#include <string>
#include <vector>

namespace ninebit {

struct Tick {
  double value = 0.0;
  std::string label{};  // empty: a line between two labelled ones
};

struct Axis {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  std::vector<Tick> ticks{};  // within low … high, ascending

  // Where a value stands: 0 at low, 1 at high.
  [[nodiscard]] double place(double value) const;
};

// An axis that holds all `values`, with about `wanted` ticks at 1, 2 or 5 times a power of ten. `from_zero`: 0 belongs
// to it, whatever the values; it does anyway where it is near. No value: 0 to 1.
[[nodiscard]] Axis linear_axis(const std::vector<double>& values, int wanted, bool from_zero);

// The same with ticks at powers of ten, and at 2 and 5 times them where there are few of them. Values must be positive.
// No value: 1 to 10.
[[nodiscard]] Axis logarithmic_axis(const std::vector<double>& values, int wanted);

}  // namespace ninebit
