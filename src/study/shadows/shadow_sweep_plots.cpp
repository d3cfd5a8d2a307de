// The plots of a sweep, and the map of polygon offsets.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "src/study/shadows/shadow_sweep_report.h"

namespace ninebit {
namespace {

constexpr std::size_t kMaxSeries = 8;  // more are hard to distinguish

// Columns with a numeric axis. It is logarithmic for map_size, whose values are powers of two above 0.
constexpr std::array<std::string_view, 5> kNumeric{"map_size", "index_step", "bias", "polygon_offset_factor",
                                                   "polygon_offset_units"};

std::string file_name(std::string_view what, std::string column) {
  std::replace(column.begin(), column.end(), '_', '-');
  return fmt::format("{}-by-{}", what, column);
}

PlotSeries series_of(std::string name, const std::vector<const StudyRow*>& rows, const std::string& column,
                     const std::string& value) {
  PlotSeries series{.name = std::move(name), .points = {}};
  for (const StudyRow* row : rows) series.points.emplace_back(row->number(column), row->number(value));
  std::stable_sort(series.points.begin(), series.points.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return series;
}

Plot plot_of(const std::string& column, std::string_view what, std::string title) {
  return {.file = file_name(what, column),
          .title = std::move(title),
          .x_label = column,
          .y_label = "pixels",
          .log_x = column == "map_size",
          .series = {}};
}

Plot wrong_plot(const SweepView& view, const std::string& column) {
  struct Curve {
    std::uint64_t fewest;
    const StudyRow* row;  // one of the curve's rows
  };
  const std::array<std::string, 1> columns{column};
  std::vector<Curve> curves;
  std::set<std::string> seen;
  for (const StudyRow* row : view.rows) {
    if (!seen.insert(view.label(*row, columns)).second) continue;
    Curve curve{row->count("wrong"), row};
    for (const StudyRow* other : view.beside(*row, columns))
      curve.fewest = std::min(curve.fewest, other->count("wrong"));
    curves.push_back(curve);
  }
  const std::size_t all = curves.size();
  std::stable_sort(curves.begin(), curves.end(), [](const Curve& a, const Curve& b) { return a.fewest < b.fewest; });
  curves.resize(std::min(all, kMaxSeries));
  Plot plot = plot_of(column, "wrong", fmt::format("Wrong pixels by {}", column));
  for (const Curve& curve : curves) {
    const std::string name = view.label(*curve.row, columns);
    plot.series.push_back(series_of(name.empty() ? "wrong" : name, view.beside(*curve.row, columns), column, "wrong"));
  }
  if (all > kMaxSeries)
    plot.caption = fmt::format("The {} curves with the fewest wrong pixels, of {}.", kMaxSeries, all);
  return plot;
}

Plot cause_plot(const SweepView& view, const std::string& column) {
  const std::array<std::string, 1> columns{column};
  Plot plot = plot_of(column, "causes", fmt::format("Causes by {}", column));
  plot.caption = view.label(*view.best, columns);
  const auto rows = view.beside(*view.best, columns);
  for (const std::string& cause : view.causes) plot.series.push_back(series_of(cause, rows, column, cause));
  return plot;
}

std::vector<double> values_in(const std::vector<const StudyRow*>& rows, const std::string& column) {
  std::set<double> values;
  for (const StudyRow* row : rows) values.insert(row->number(column));
  return {values.begin(), values.end()};
}

}  // namespace

std::vector<Plot> sweep_plots(const SweepView& view) {
  std::vector<Plot> plots;
  for (const std::string& column : view.columns) {
    if (std::find(kNumeric.begin(), kNumeric.end(), column) == kNumeric.end()) continue;
    plots.push_back(wrong_plot(view, column));
    plots.push_back(cause_plot(view, column));
  }
  return plots;
}

std::vector<HeatMap> offset_maps(const SweepView& view) {
  const auto rows = view.beside(*view.best, kOffsetColumns);
  const auto factors = values_in(rows, kOffsetColumns[0]), units = values_in(rows, kOffsetColumns[1]);
  if (factors.size() < 2 || units.size() < 2 || rows.size() != factors.size() * units.size()) return {};
  std::vector<float> wrong(rows.size());
  for (const StudyRow* row : rows) {
    const auto at = [&](const std::vector<double>& values, std::size_t column) {
      return static_cast<std::size_t>(
          std::lower_bound(values.begin(), values.end(), row->number(kOffsetColumns[column])) - values.begin());
    };
    wrong[at(factors, 0) * units.size() + at(units, 1)] = static_cast<float>(row->count("wrong"));
  }
  const float most = *std::max_element(wrong.begin(), wrong.end());
  return {{.file = "wrong-by-offset",
           .title = "Wrong pixels by polygon offset",
           .x_label = fmt::format("units, one per column: {}", fmt::join(units, ", ")),
           .y_label = fmt::format("factor, one per row: {}", fmt::join(factors, ", ")),
           .x_first = 1.0,
           .x_last = static_cast<double>(units.size()),
           .y_first = 1.0,
           .y_last = static_cast<double>(factors.size()),
           .width = static_cast<int>(units.size()),
           .height = static_cast<int>(factors.size()),
           .values = std::move(wrong),
           .low = 0.0F,
           .high = std::max(most, 1.0F),
           .caption = view.label(*view.best, kOffsetColumns)}};
}

}  // namespace ninebit
