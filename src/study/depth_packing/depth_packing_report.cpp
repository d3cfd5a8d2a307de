#include "src/study/depth_packing/depth_packing_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ninebit {

namespace {

// The rows of one storage and set.
std::vector<const StudyRow*> rows_of(std::span<const StudyRow> rows, std::string_view storage, std::string_view set) {
  std::vector<const StudyRow*> found;
  for (const StudyRow& row : rows) {
    if (row.table == "rows" && row.text("storage") == storage && row.text("depths") == set) found.push_back(&row);
  }
  return found;
}

std::string order_sentence(const StudyRow& row) {
  const std::uint64_t inversions = row.count("inversions");
  return inversions == 0 ? "" : fmt::format(", {} inversion{}", inversions, inversions == 1 ? "" : "s");
}

// The error of each packing for each set of depths, the smallest mean error first.
std::vector<std::string> errors_in_words(const DepthPackingOptions& options, std::span<const StudyRow> rows) {
  std::vector<std::string> sentences;
  for (const DepthSet set : options.sets) {
    for (const ChannelStorage storage : options.storages) {
      auto found = rows_of(rows, name_of(storage), name_of(set));
      if (found.empty()) continue;
      std::stable_sort(found.begin(), found.end(), [](const StudyRow* a, const StudyRow* b) {
        return a->number("mean_error") < b->number("mean_error");
      });
      std::vector<std::string> parts;
      for (const StudyRow* row : found) {
        const bool exact = row->count("exact") == row->count("count");
        const bool exact_below_one = row->number("max_error") == 0.0;
        parts.push_back(row->text("packing") +
                        (exact ? " is exact"
                         : exact_below_one
                             ? fmt::format(" is exact below depth 1{}", order_sentence(*row))
                             : fmt::format(" has an error of up to {:.3g} below depth 1 (mean {:.3g}{})",
                                           row->number("max_error"), row->number("mean_error"), order_sentence(*row))));
      }
      sentences.push_back(fmt::format(
          "{}, components {}: {}.",
          set == DepthSet::floats ? fmt::format("Floats, {} of them", found[0]->count("count"))
                                  : fmt::format("All {} depths of {} bits", found[0]->count("count"), name_of(set)),
          storage == ChannelStorage::round ? "rounded to bytes" : "truncated to bytes", fmt::join(parts, "; ")));
    }
  }
  return sentences;
}

// The values read back for depths 0 and 1, which are the same in every set of depths.
std::vector<std::string> ends_in_words(std::span<const StudyRow> rows) {
  std::set<std::string> seen;
  std::vector<std::string> changed;
  for (const StudyRow& row : rows) {
    if (row.table != "rows") continue;
    for (const auto& [end, field] : {std::pair{0, "zero_reads_as"}, std::pair{1, "one_reads_as"}}) {
      if (row.number(field) == end) continue;
      const std::string words = fmt::format("{} reads as {} through {} ({})", end, row.number(field),
                                            row.text("packing"), row.text("storage"));
      if (seen.insert(words).second) changed.push_back(words);
    }
  }
  if (changed.empty()) return {"Depths 0 and 1 are unchanged."};
  return {fmt::format("Changed ends of the range: {}.", fmt::join(changed, "; "))};
}

std::vector<std::string> digits_in_words(const std::vector<DigitGrid>& grids, std::span<const StudyRow> rows) {
  std::vector<std::string> sentences;
  for (const DigitGrid& grid : grids) {
    std::vector<double> shifts;
    for (const StudyRow& row : rows) {
      if (row.table == kSecondDigitTable && row.text("packing") == grid.packing->name &&
          row.text("storage") == name_of(grid.storage)) {
        shifts.push_back(row.number("shift"));
      }
    }
    if (shifts.empty() || !grid.keeps_depth()) continue;
    const auto [low, high] = std::minmax_element(shifts.begin(), shifts.end());
    if (std::max(-*low, *high) < 2.0) continue;
    sentences.push_back(
        fmt::format("Where the highest digit is {}, {} ({}) shifts the depth by {:.4g} to {:.4g} steps of the second.",
                    kChartDigit, grid.packing->name, name_of(grid.storage), *low, *high));
  }
  return sentences;
}

std::string set_in_words(std::string_view set) {
  return set == name_of(DepthSet::floats) ? "floats" : fmt::format("{} bits", set);
}

// The packings of these rows, with the storage if not all storages are among them.
std::string packings_in_words(const DepthPackingOptions& options, const std::vector<const StudyRow*>& rows) {
  std::vector<std::string> names;
  for (const std::string& packing : options.packings) {
    std::set<std::string> storages;
    for (const StudyRow* row : rows) {
      if (row->text("packing") == packing) storages.insert(row->text("storage"));
    }
    if (storages.empty()) continue;
    const bool all = storages.size() == options.storages.size();
    names.push_back(all ? packing : fmt::format("{} ({})", packing, fmt::join(storages, ", ")));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// The opening of the page: which packings are exact, for each set of depths, and which change depth 1.
std::vector<std::string> exactness_in_words(const DepthPackingOptions& options, std::span<const StudyRow> rows) {
  std::vector<std::string> sentences;
  std::vector<const StudyRow*> changed;
  for (const DepthSet set : options.sets) {
    std::vector<const StudyRow*> exact, below_one;
    bool measured = false;
    for (const StudyRow& row : rows) {
      if (row.table != "rows" || row.text("depths") != name_of(set)) continue;
      measured = true;
      if (row.count("exact") == row.count("count")) {
        exact.push_back(&row);
      } else if (row.number("max_error") == 0.0) {
        below_one.push_back(&row);
      }
      if (row.number("one_reads_as") != 1.0) changed.push_back(&row);
    }
    const std::string of = set_in_words(name_of(set));
    if (!exact.empty()) {
      sentences.push_back(fmt::format("Exact for all depths ({}): {}.", of, packings_in_words(options, exact)));
    }
    if (!below_one.empty()) {
      sentences.push_back(fmt::format("Exact for all depths below 1, but not for depth 1 ({}): {}.", of,
                                      packings_in_words(options, below_one)));
    }
    if (measured && exact.empty() && below_one.empty())
      sentences.push_back(fmt::format("No packing is exact ({}).", of));
  }
  if (!changed.empty()) {
    sentences.push_back(fmt::format("Depth 1 is not restored by {}.", packings_in_words(options, changed)));
  }
  return sentences;
}

// A row for each packing and storage, with the largest error in each set of depths.
ReportTable largest_errors(const DepthPackingOptions& options, std::span<const StudyRow> rows) {
  ReportTable table{.title = "Largest error below depth 1",
                    .columns = {"packing", "storage"},
                    .rows = {},
                    .caption = "The errors leave depth 1 out: its value is in the last column."};
  for (const DepthSet set : options.sets) table.columns.push_back(set_in_words(name_of(set)));
  table.columns.insert(table.columns.end(), {"0 reads as", "1 reads as"});
  for (const StudyRow& row : rows) {
    if (row.table != "rows" || row.text("depths") != name_of(options.sets.front())) continue;
    std::vector<StudyValue>& values = table.rows.emplace_back();
    values = {row["packing"], row["storage"]};
    for (const DepthSet set : options.sets) {
      const auto of_set = rows_of(rows, row.text("storage"), name_of(set));
      const auto found = std::find_if(of_set.begin(), of_set.end(),
                                      [&](const StudyRow* other) { return (*other)["packing"] == row["packing"]; });
      values.push_back(found == of_set.end() ? StudyValue() : (**found)["max_error"]);
    }
    values.insert(values.end(), {row["zero_reads_as"], row["one_reads_as"]});
  }
  return table;
}

// The fields that leave depth 1 out.
bool is_below_one(std::string_view field) {
  return field.ends_with("_error") || field == "mean_bias" || field.starts_with("worst_");
}

ReportTable error_table(std::span<const StudyRow> rows) {
  ReportTable table{.title = "Round trips", .columns = {}, .rows = {}};
  for (const StudyRow& row : rows) {
    if (row.table != "rows") continue;
    if (table.columns.empty()) {
      table.columns = {"packing", "three.js"};
      for (std::size_t i = 1; i < row.fields.size(); ++i) {
        const std::string& name = row.fields[i].first;
        table.columns.push_back(is_below_one(name) ? name + " below 1" : name);
      }
    }
    std::vector<StudyValue> values{row.text("packing"), std::string(find_depth_packing(row.text("packing"))->releases)};
    for (std::size_t i = 1; i < row.fields.size(); ++i) values.push_back(row.fields[i].second);
    table.rows.push_back(std::move(values));
  }
  table.caption =
      "Depths go from 0 to 1. An error is the value read back minus the depth. Over depths below 1, max_error is the "
      "largest absolute error, mean_error the mean absolute error and mean_bias the mean signed error. "
      "inversions: depths that are read back smaller than the previous depth.";
  return table;
}

}  // namespace

StudyReport depth_packing_report(const DepthPackingOptions& options, std::span<const StudyRow> rows) {
  StudyReport report{.title = "Depth packing", .answers = {}};
  const std::vector<DigitGrid> grids = digit_grids(options);
  for (const auto& sentences : {errors_in_words(options, rows), ends_in_words(rows), digits_in_words(grids, rows)}) {
    report.answers.insert(report.answers.end(), sentences.begin(), sentences.end());
  }
  report.headlines = exactness_in_words(options, rows);
  const std::vector<std::string> shifts = digits_in_words(grids, rows);
  report.headlines.insert(report.headlines.end(), shifts.begin(), shifts.end());
  report.summary.push_back(largest_errors(options, rows));
  report.tables.push_back(error_table(rows));
  report.plots = depth_packing_plots(options, grids);
  report.heat_maps = depth_packing_maps(grids);
  return report;
}

namespace {

double error_of(const DepthPacking& packing, ChannelStorage storage, float depth) {
  return static_cast<double>(read_depth(packing, store_depth(packing, depth, storage))) - static_cast<double>(depth);
}

DigitGrid grid_of(const DepthPacking& packing, ChannelStorage storage) {
  DigitGrid grid{.packing = &packing, .storage = storage, .shift = {}};
  grid.shift.reserve(65536);
  for (int i = 0; i < 65536; ++i) {
    grid.shift.push_back(static_cast<float>(store_two_digits(packing, storage, i / 256, i % 256).shift));
    grid.largest = std::max(grid.largest, std::fabs(grid.shift.back()));
  }
  return grid;
}

// The largest absolute error in each of 512 parts of the range.
Plot error_plot(const std::vector<DigitGrid>& grids, ChannelStorage storage) {
  constexpr int kStretches = 512, kDepths = 512;
  Plot plot{
      .file = fmt::format("error-by-depth-{}", name_of(storage)),
      .title = fmt::format("Error by depth, components {}", storage == ChannelStorage::round ? "rounded" : "truncated"),
      .x_label = "depth",
      .y_label = "largest absolute error",
      .log_y = true,
      .series = {}};
  for (const DigitGrid& grid : grids) {
    if (grid.storage != storage || !grid.keeps_depth()) continue;
    PlotSeries series{.name = std::string(grid.packing->name), .points = {}};
    for (int s = 0; s < kStretches; ++s) {
      double largest = 0.0;
      for (int i = 0; i < kDepths; ++i) {
        const float depth = static_cast<float>(s * kDepths + i) / (kStretches * kDepths);
        largest = std::max(largest, std::fabs(error_of(*grid.packing, storage, depth)));
      }
      series.points.emplace_back((s + 0.5) / kStretches, largest);
    }
    plot.series.push_back(std::move(series));
  }
  plot.caption =
      "For each 512th of the range, the largest absolute error among 512 depths. Where a line has a gap, these depths "
      "are "
      "exact.";
  return plot;
}

// Adds the series, or its name to `left_out` if all of it would lie on the plot's line of 0.
void put_visible(Plot& plot, PlotSeries series, double least, std::vector<std::string>& left_out) {
  const bool visible = std::any_of(series.points.begin(), series.points.end(),
                                   [least](const auto& point) { return std::fabs(point.second) >= least; });
  if (visible) {
    plot.series.push_back(std::move(series));
  } else {
    left_out.push_back(std::move(series.name));
  }
}

std::string left_out_in_words(std::string_view least, const std::vector<std::string>& left_out) {
  if (left_out.empty()) return {};
  return fmt::format(" Below {} everywhere, and not drawn: {}.", least, fmt::join(left_out, ", "));
}

// In a scene 256 units deep. The error ranges from half a unit too far to half a unit too near.
Plot middle_plot(const std::vector<DigitGrid>& grids) {
  Plot plot{.file = "error-halfway",
            .title = "Error halfway through a range of 256 units, components rounded",
            .x_label = "depth in units of 1/256",
            .y_label = "error in units of 1/256",
            .series = {}};
  std::vector<std::string> left_out;
  for (const DigitGrid& grid : grids) {
    if (grid.storage != ChannelStorage::round || !grid.keeps_depth()) continue;
    PlotSeries series{.name = std::string(grid.packing->name), .points = {}};
    for (int i = 126 * 128; i <= 132 * 128; ++i) {
      const float depth = static_cast<float>(i) / 32768.0F;
      series.points.emplace_back(i / 128.0, 256.0 * error_of(*grid.packing, grid.storage, depth));
    }
    put_visible(plot, std::move(series), 0.01, left_out);
  }
  plot.caption = "Where a surface is deeper than its stored depth, it shades itself; before the jump, light leaks." +
                 left_out_in_words("0.01", left_out);
  return plot;
}

Plot digit_plot(const std::vector<DigitGrid>& grids) {
  Plot plot{.file = "second-digit",
            .title = fmt::format("Shift of the second component where the highest is {}", kChartDigit),
            .x_label = "second digit",
            .y_label = "shift in steps of the second digit",
            .series = {}};
  std::vector<std::string> left_out;
  for (const DigitGrid& grid : grids) {
    if (!grid.keeps_depth()) continue;
    PlotSeries series{.name = grid.name(), .points = {}};
    for (std::size_t digit = 0; digit < 256; ++digit) {
      series.points.emplace_back(digit, grid.shift[kChartDigit * 256 + digit]);
    }
    put_visible(plot, std::move(series), 2.0, left_out);
  }
  plot.caption =
      "The value read back for a depth of two digits in base 256, minus the depth." + left_out_in_words("2", left_out);
  return plot;
}

HeatMap digits_map(const DigitGrid& grid) {
  return {.file = fmt::format("shift-{}", grid.name()),
          .title = fmt::format("Shift by both digits: {}", grid.name()),
          .x_label = "second digit",
          .y_label = "highest digit",
          .x_first = 0.0,
          .x_last = 255.0,
          .y_first = 0.0,
          .y_last = 255.0,
          .width = 256,
          .height = 256,
          .values = grid.shift,
          .low = -grid.largest,
          .high = grid.largest,
          .caption = "In steps of the second digit, 1/65536 of the range."};
}

}  // namespace

std::vector<DigitGrid> digit_grids(const DepthPackingOptions& options) {
  std::vector<DigitGrid> grids;
  for (const std::string& name : options.packings) {
    for (const ChannelStorage storage : options.storages) grids.push_back(grid_of(*find_depth_packing(name), storage));
  }
  return grids;
}

std::vector<Plot> depth_packing_plots(const DepthPackingOptions& options, const std::vector<DigitGrid>& grids) {
  std::vector<Plot> plots;
  for (const ChannelStorage storage : options.storages) plots.push_back(error_plot(grids, storage));
  plots.push_back(middle_plot(grids));
  plots.push_back(digit_plot(grids));
  std::erase_if(plots, [](const Plot& plot) { return plot.series.empty(); });
  return plots;
}

std::vector<HeatMap> depth_packing_maps(const std::vector<DigitGrid>& grids) {
  std::vector<HeatMap> maps;
  for (const DigitGrid& grid : grids) {
    if (grid.largest >= 1.0F && grid.keeps_depth()) maps.push_back(digits_map(grid));
  }
  return maps;
}

}  // namespace ninebit
