#include "src/study/report/report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "src/system/quoting.h"

namespace ninebit {

std::string escaped(std::string_view text) {
  return escaped_markup(text, true);
}

std::string readable(const StudyValue& value) {
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{:.6g}", *real);
  std::string text = text_of(value);
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  if (text.size() - first <= 4) return text;
  for (std::size_t end = text.size(); end > first + 3; end -= 3) text.insert(end - 3, "\u202f");
  return text;
}

bool can_be_shown(const Plot& plot, const std::pair<double, double>& point) {
  constexpr double kGreatest = 1e150;  // keeps the lengths of axes finite
  if (!(std::fabs(point.first) < kGreatest) || !(std::fabs(point.second) < kGreatest)) return false;
  const bool log_x = plot.log_x && !is_even(plot);
  return (!log_x || point.first > 1.0 / kGreatest) && (!plot.log_y || point.second > 1.0 / kGreatest);
}

std::vector<double> even_positions(const Plot& plot) {
  std::vector<double> positions;
  for (const PlotSeries& series : plot.series) {
    for (const auto& point : series.points) {
      if (can_be_shown(plot, point)) positions.push_back(point.first);
    }
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

std::string position_label(const Plot& plot, double x) {
  const bool named = x >= 1.0 && x <= static_cast<double>(plot.x_names.size());
  return named ? plot.x_names[static_cast<std::size_t>(x) - 1] : text_of(x);
}

}  // namespace ninebit
