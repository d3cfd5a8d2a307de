#include "src/study/report/chart_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "src/study/report/report_text.h"

namespace ninebit {
namespace {

constexpr std::array kRound{1.0, 2.0, 5.0, 10.0};
constexpr double kNearly = 1e-9;  // what rounding may have added

double power_below(double value) {
  return std::pow(10.0, std::floor(std::log10(value) + kNearly));
}

// The least 1, 2 or 5 times a power of ten that is not below the value.
double rounded_up(double value) {
  const double power = power_below(value);
  for (const double factor : kRound) {
    if (factor * power >= value * (1.0 - kNearly)) return factor * power;
  }
  return 10.0 * power;
}

// The greatest of these that is not above it.
double rounded_down(double value) {
  const double power = power_below(value);
  double best = power;
  for (const double factor : kRound) {
    if (factor * power <= value * (1.0 + kNearly)) best = factor * power;
  }
  return best;
}

std::string label_of(double value) {
  constexpr double kExact = 1e15;
  if (value == std::floor(value) && std::fabs(value) < kExact) return readable(static_cast<std::int64_t>(value));
  return readable(value);
}

// "0.01", "500" or "2·10⁶".
std::string log_label(double factor, int exponent) {
  constexpr int kPlain = 3;
  if (std::abs(exponent) <= kPlain) return label_of(factor * std::pow(10.0, exponent));
  constexpr std::array<std::string_view, 10> kRaised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = factor == 1.0 ? "10" : fmt::format("{:g}·10", factor);
  for (const char c : std::to_string(exponent)) out += c == '-' ? "⁻" : kRaised[static_cast<std::size_t>(c - '0')];
  return out;
}

ChartAxis log_axis(double least, double most) {
  constexpr double kFewDecades = 2.0;
  ChartAxis axis{.low = rounded_down(least), .high = rounded_up(most), .logarithmic = true};
  if (axis.high <= axis.low * (1.0 + kNearly)) axis.high = 10.0 * axis.low;
  const double decades = std::log10(axis.high / axis.low);
  const int first = static_cast<int>(std::floor(std::log10(axis.low) + kNearly));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high) - kNearly));
  constexpr int kMostTicks = 12;
  const int every = std::max(1, (last - first) / kMostTicks + 1);
  for (int exponent = first; exponent <= last; exponent += every) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, exponent);
      const bool inside = value >= axis.low * (1.0 - kNearly) && value <= axis.high * (1.0 + kNearly);
      if (!inside || (factor != 1.0 && decades > kFewDecades)) continue;
      axis.ticks.push_back({value, log_label(factor, exponent)});
    }
  }
  return axis;
}

}  // namespace

double ChartAxis::share_of(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

std::vector<Tick> round_ticks(double low, double high, int count, bool whole) {
  std::vector<Tick> ticks;
  if (!(high > low)) return {{low, label_of(low)}};
  double step = rounded_up((high - low) / count);
  if (whole) step = std::max(step, 1.0);
  const auto first = static_cast<std::int64_t>(std::ceil(low / step - kNearly));
  const auto last = static_cast<std::int64_t>(std::floor(high / step + kNearly));
  for (std::int64_t i = first; i <= last; ++i) {
    const double value = static_cast<double>(i) * step;
    ticks.push_back({value, label_of(value)});
  }
  return ticks;
}

ChartAxis axis_of(std::span<const double> values, bool logarithmic, bool from_zero) {
  constexpr int kTicks = 7;
  if (values.empty())
    return logarithmic ? log_axis(1.0, 10.0) : ChartAxis{.ticks = round_ticks(0.0, 1.0, kTicks, false)};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (logarithmic) return log_axis(*least, *most);
  double low = *least, high = *most;
  if (from_zero || low == high) {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }
  if (low == high) high = 1.0;
  const bool whole = std::all_of(values.begin(), values.end(), [](double v) { return v == std::floor(v); });
  const double step = std::max(rounded_up((high - low) / kTicks), whole ? 1.0 : 0.0);
  ChartAxis axis{.low = std::floor(low / step + kNearly) * step, .high = std::ceil(high / step - kNearly) * step};
  axis.ticks = round_ticks(axis.low, axis.high, kTicks, whole);
  return axis;
}

}  // namespace ninebit
