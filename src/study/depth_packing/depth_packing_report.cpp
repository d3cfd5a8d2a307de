#include "src/study/depth_packing/depth_packing_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ninebit {
namespace {

double error_of(const DepthPacking& packing, ChannelStorage storage, float depth) {
  return static_cast<double>(read_depth(packing, store_depth(packing, depth, storage))) - static_cast<double>(depth);
}

// The errors of a packing and storage at all depths of two digits, in steps of the second digit.
struct Grid {
  const DepthPacking* packing;
  ChannelStorage storage;
  std::vector<float> shift;  // [highest][second]
  float largest = 0.0F;      // largest absolute shift

  // False for a packing whose digits are in the wrong order: it loses the depth, and would dwarf the others in a plot.
  [[nodiscard]] bool keeps_depth() const { return largest < 4096.0F; }
  [[nodiscard]] std::string name() const { return fmt::format("{}-{}", packing->name, name_of(storage)); }
};

Grid grid_of(const DepthPacking& packing, ChannelStorage storage) {
  Grid grid{.packing = &packing, .storage = storage, .shift = {}};
  grid.shift.reserve(65536);
  for (int i = 0; i < 65536; ++i) {
    grid.shift.push_back(static_cast<float>(store_two_digits(packing, storage, i / 256, i % 256).shift));
    grid.largest = std::max(grid.largest, std::fabs(grid.shift.back()));
  }
  return grid;
}

std::vector<Grid> grids_of(const DepthPackingOptions& options) {
  std::vector<Grid> grids;
  for (const std::string& name : options.packings) {
    for (const ChannelStorage storage : options.storages) grids.push_back(grid_of(*find_depth_packing(name), storage));
  }
  return grids;
}

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
                             : fmt::format(" has an error of up to {:.3g} (mean {:.3g}{})", row->number("max_error"),
                                           row->number("mean_error"), order_sentence(*row))));
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

std::vector<std::string> digits_in_words(const std::vector<Grid>& grids, std::span<const StudyRow> rows) {
  std::vector<std::string> sentences;
  for (const Grid& grid : grids) {
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

ReportTable error_table(std::span<const StudyRow> rows) {
  ReportTable table{.title = "Round trips", .columns = {}, .rows = {}};
  for (const StudyRow& row : rows) {
    if (row.table != "rows") continue;
    if (table.columns.empty()) {
      table.columns = {"packing", "three.js"};
      for (std::size_t i = 1; i < row.fields.size(); ++i) table.columns.push_back(row.fields[i].first);
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

// The signed error with the largest absolute value in each of 512 parts of the range.
Plot error_plot(const std::vector<Grid>& grids, ChannelStorage storage) {
  constexpr int kStretches = 512, kDepths = 512;
  Plot plot{
      .file = fmt::format("error-by-depth-{}", name_of(storage)),
      .title = fmt::format("Error by depth, components {}", storage == ChannelStorage::round ? "rounded" : "truncated"),
      .x_label = "depth",
      .y_label = "largest error",
      .series = {}};
  for (const Grid& grid : grids) {
    if (grid.storage != storage || !grid.keeps_depth()) continue;
    PlotSeries series{.name = std::string(grid.packing->name), .points = {}};
    for (int s = 0; s < kStretches; ++s) {
      double largest = 0.0;
      for (int i = 0; i < kDepths; ++i) {
        const float depth = static_cast<float>(s * kDepths + i) / (kStretches * kDepths);
        const double error = error_of(*grid.packing, storage, depth);
        if (std::fabs(error) > std::fabs(largest)) largest = error;
      }
      series.points.emplace_back((s + 0.5) / kStretches, largest);
    }
    plot.series.push_back(std::move(series));
  }
  plot.caption = "For each 512th of the range, the error with the largest absolute value among 512 depths.";
  return plot;
}

// In a scene 256 units deep. The error ranges from half a unit too far to half a unit too near.
Plot middle_plot(const std::vector<Grid>& grids) {
  Plot plot{.file = "error-halfway",
            .title = "Error halfway through a range of 256 units, components rounded",
            .x_label = "depth in units of 1/256",
            .y_label = "error in units of 1/256",
            .series = {}};
  for (const Grid& grid : grids) {
    if (grid.storage != ChannelStorage::round || !grid.keeps_depth()) continue;
    PlotSeries series{.name = std::string(grid.packing->name), .points = {}};
    for (int i = 126 * 128; i <= 132 * 128; ++i) {
      const float depth = static_cast<float>(i) / 32768.0F;
      series.points.emplace_back(i / 128.0, 256.0 * error_of(*grid.packing, grid.storage, depth));
    }
    plot.series.push_back(std::move(series));
  }
  plot.caption = "Where a surface is deeper than its stored depth, it shades itself; before the jump, light leaks.";
  return plot;
}

Plot digit_plot(const std::vector<Grid>& grids) {
  Plot plot{.file = "second-digit",
            .title = fmt::format("Shift of the second component where the highest is {}", kChartDigit),
            .x_label = "second digit",
            .y_label = "shift in steps of the second digit",
            .series = {}};
  for (const Grid& grid : grids) {
    if (!grid.keeps_depth()) continue;
    PlotSeries series{.name = grid.name(), .points = {}};
    for (std::size_t digit = 0; digit < 256; ++digit) {
      series.points.emplace_back(digit, grid.shift[kChartDigit * 256 + digit]);
    }
    plot.series.push_back(std::move(series));
  }
  plot.caption = "The value read back for a depth of two digits in base 256, minus the depth.";
  return plot;
}

HeatMap digits_map(const Grid& grid) {
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

StudyReport depth_packing_report(const DepthPackingOptions& options, std::span<const StudyRow> rows) {
  StudyReport report{.title = "Depth packing", .answers = {}};
  const std::vector<Grid> grids = grids_of(options);
  for (const auto& sentences : {errors_in_words(options, rows), ends_in_words(rows), digits_in_words(grids, rows)}) {
    report.answers.insert(report.answers.end(), sentences.begin(), sentences.end());
  }
  report.tables.push_back(error_table(rows));
  std::vector<Plot> plots;
  for (const ChannelStorage storage : options.storages) plots.push_back(error_plot(grids, storage));
  plots.push_back(middle_plot(grids));
  plots.push_back(digit_plot(grids));
  for (Plot& plot : plots) {
    if (!plot.series.empty()) report.plots.push_back(std::move(plot));
  }
  for (const Grid& grid : grids) {
    if (grid.largest >= 1.0F && grid.keeps_depth()) report.heat_maps.push_back(digits_map(grid));
  }
  return report;
}

}  // namespace ninebit
