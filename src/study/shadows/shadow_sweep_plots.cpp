// The plots of a sweep, and the map of polygon offsets.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

#include "src/study/shadows/shadow_sweep_report.h"

namespace ninebit {
namespace {

constexpr std::size_t kMaxSeries = 8;  // more are hard to distinguish

// Columns with a numeric axis.
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
  return {
      .file = file_name(what, column), .title = std::move(title), .x_label = column, .y_label = "pixels", .series = {}};
}

// The values span at least so many times the least of them above 0.
bool spans(const std::vector<double>& values, double times) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const double value : values) {
    if (value > 0.0) least = std::min(least, value);
    most = std::max(most, value);
  }
  return most >= times * least;
}

bool has_zero(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return !(value > 0.0); });
}

void add_sentence(Plot& plot, std::string_view sentence) {
  if (!plot.caption.empty()) plot.caption += ' ';
  plot.caption += sentence;
}

// Chooses the axes that show values which span decades. Powers of two are evenly spaced on a logarithmic axis, too;
// with 0 among them, every value gets the same room.
void choose_axes(Plot& plot) {
  constexpr double kDecade = 10.0;
  std::vector<double> xs, ys;
  for (const PlotSeries& series : plot.series) {
    for (const auto& [x, y] : series.points) {
      xs.push_back(x);
      ys.push_back(y);
    }
  }
  plot.even_x = has_zero(xs) && spans(xs, kDecade * kDecade);
  plot.log_x = !has_zero(xs) && (plot.x_label == "map_size" || spans(xs, kDecade * kDecade));
  plot.log_y = spans(ys, kDecade);
  if (plot.log_y && has_zero(ys)) add_sentence(plot, "Points with 0 pixels are left out.");
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
  choose_axes(plot);
  return plot;
}

Plot cause_plot(const SweepView& view, const std::string& column) {
  const std::array<std::string, 1> columns{column};
  Plot plot = plot_of(column, "causes", fmt::format("Causes by {}", column));
  if (const std::string others = view.label(*view.best, columns); !others.empty()) plot.caption = others + '.';
  const auto rows = view.beside(*view.best, columns);
  std::vector<std::string> absent;
  for (const std::string& cause : view.causes) {
    const auto has_none = [&](const StudyRow* row) { return row->count(cause) == 0; };
    if (std::all_of(rows.begin(), rows.end(), has_none)) {
      absent.push_back(cause);
    } else {
      plot.series.push_back(series_of(cause, rows, column, cause));
    }
  }
  if (!absent.empty()) add_sentence(plot, fmt::format("Causes without a pixel: {}.", fmt::join(absent, ", ")));
  choose_axes(plot);
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
  const auto [least, most] = std::minmax_element(wrong.begin(), wrong.end());
  const float low = *least, high = std::max(*most, low + 1.0F);
  return {{.file = "wrong-by-offset",
           .title = "Wrong pixels by polygon offset",
           .x_label = "units",
           .y_label = "factor",
           .x_first = units.front(),
           .x_last = units.back(),
           .y_first = factors.front(),
           .y_last = factors.back(),
           .width = static_cast<int>(units.size()),
           .height = static_cast<int>(factors.size()),
           .values = std::move(wrong),
           .low = low,
           .high = high,
           .caption = view.label(*view.best, kOffsetColumns),
           .x_values = units,
           .y_values = factors}};
}

}  // namespace ninebit
