#include "src/study/report/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ninebit {
namespace {

// The double nearest to a decimal number; computing it arithmetically may round differently.
double decimal(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

double power_of_ten(int exponent) {
  return decimal(fmt::format("1e{}", exponent));
}

// The first of 1, 2, 5, 10, 20, … times a power of ten that is not below `least`.
double round_step(double least, int& exponent) {
  exponent = static_cast<int>(std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power_of_ten(exponent) >= least) return factor * power_of_ten(exponent);
  }
  return power_of_ten(++exponent);
}

// The label of a multiple of a step that is 1, 2 or 5 times 10^exponent: with its decimals and separated thousands.
std::string step_label(double value, int exponent) {
  if (value == 0.0) return "0";
  if (std::fabs(value) >= 1e15 || exponent < -6) return fmt::format("{:.6g}", value);
  std::string text = fmt::format("{:.{}f}", value, std::max(0, -exponent));
  const std::size_t first = text[0] == '-' ? 1 : 0;
  std::size_t end = std::min(text.find('.'), text.size());
  if (end - first <= 4) return text;  // no separator in four digits: 1024
  for (; end > first + 3; end -= 3) text.insert(end - 3, " ");
  return text;
}

std::string power_label(int exponent) {
  if (exponent >= -3 && exponent <= 3) return fmt::format("{:.{}f}", power_of_ten(exponent), std::max(0, -exponent));
  static constexpr const char* kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  if (exponent < 0) text += "⁻";
  for (const char digit : std::to_string(std::abs(exponent))) text += kRaised[digit - '0'];
  return text;
}

}  // namespace

double Axis::place(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return (std::log10(value) - std::log10(low)) / (std::log10(high) - std::log10(low));
}

Axis linear_axis(const std::vector<double>& values, int wanted, bool from_zero) {
  Axis axis;
  if (!values.empty()) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    axis.low = *least;
    axis.high = *greatest;
  }
  const double reach = axis.high - axis.low;
  if (from_zero || (axis.low > 0.0 && axis.low <= reach)) axis.low = std::min(axis.low, 0.0);
  if (from_zero || (axis.high < 0.0 && -axis.high <= reach)) axis.high = std::max(axis.high, 0.0);
  // Widens a range of equal or nearly equal values, whose ticks would have equal labels.
  constexpr double kNothing = 1e-290;
  const double size = std::max(std::fabs(axis.low), std::fabs(axis.high));
  if (size < kNothing) {
    axis.low = 0.0;
    axis.high = 1.0;
  } else if (axis.high - axis.low < 1e-9 * size) {
    axis.low -= size / 2.0;
    axis.high += size / 2.0;
  }
  int exponent = 0;
  const double step = round_step((axis.high - axis.low) / wanted, exponent);
  // Extends to the next tick on either side. Ticks are counted in steps, so that rounding does not accumulate.
  const double first = std::floor(axis.low / step + 1e-9), last = std::ceil(axis.high / step - 1e-9);
  for (int i = 0; i <= static_cast<int>(last - first); ++i) {
    const double value = decimal(fmt::format("{:.14g}", (first + i) * step));  // 0.3, not 0.30000000000000004
    axis.ticks.push_back({value, step_label(value, exponent)});
  }
  axis.low = std::min(axis.low, axis.ticks.front().value);
  axis.high = std::max(axis.high, axis.ticks.back().value);
  return axis;
}

Axis logarithmic_axis(const std::vector<double>& values, int wanted) {
  Axis axis{1.0, 10.0, true, {}};
  if (!values.empty()) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    axis.low = *least;
    axis.high = *greatest;
  }
  const int first = static_cast<int>(std::floor(std::log10(axis.low) + 1e-9));
  const int last = std::max(first + 1, static_cast<int>(std::ceil(std::log10(axis.high) - 1e-9)));
  axis.low = std::min(axis.low, power_of_ten(first));
  axis.high = std::max(axis.high, power_of_ten(last));
  const int every = std::max(1, (last - first + wanted - 1) / wanted);
  const bool few = last - first <= 2;
  for (int exponent = first; exponent <= last; ++exponent) {
    const bool labelled = (exponent - first) % every == 0;
    axis.ticks.push_back({power_of_ten(exponent), labelled ? power_label(exponent) : ""});
    if (exponent == last || every > 1) continue;
    for (int factor = 2; factor < 10; ++factor) {
      const double value = decimal(fmt::format("{}e{}", factor, exponent));
      const bool told = few && (factor == 2 || factor == 5);
      axis.ticks.push_back({value, told ? step_label(value, exponent) : ""});
    }
  }
  return axis;
}

}  // namespace ninebit
