#include "src/study/depth_packing/depth_packing_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ninebit {

namespace {

const StorageRule& rule_of(ChannelStorage storage) {
  return storage_rules()[static_cast<std::size_t>(storage)];
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
                             : fmt::format(" has an error of up to {:.3g} below depth 1 (mean {:.3g}{})",
                                           row->number("max_error"), row->number("mean_error"), order_sentence(*row))));
      }
      sentences.push_back(fmt::format(
          "{}, {}: {}.",
          set == DepthSet::floats ? fmt::format("Floats, {} of them", found[0]->count("count"))
                                  : fmt::format("All {} depths of {} bits", found[0]->count("count"), name_of(set)),
          rule_of(storage).help, fmt::join(parts, "; ")));
    }
  }
  return sentences;
}

// The values read back for depths 0 and 1, which are the same in every set of depths.
std::vector<std::string> ends_in_words(std::span<const StudyRow> rows) {
  std::vector<std::pair<std::string, std::string>> changed;  // what happens, and with which storages
  std::set<std::string> seen;
  for (const StudyRow& row : rows) {
    if (row.table != "rows") continue;
    for (const auto& [end, field] : {std::pair{0, "zero_reads_as"}, std::pair{1, "one_reads_as"}}) {
      if (row.number(field) == end) continue;
      const std::string words = fmt::format("{} reads as {} through {}", end, text_of(row[field]), row.text("packing"));
      if (!seen.insert(words + row.text("storage")).second) continue;
      const auto found = std::find_if(changed.begin(), changed.end(), [&](const auto& c) { return c.first == words; });
      if (found == changed.end()) {
        changed.emplace_back(words, row.text("storage"));
      } else {
        found->second += ", " + row.text("storage");
      }
    }
  }
  if (changed.empty()) return {"Depths 0 and 1 are unchanged."};
  std::vector<std::string> parts;
  parts.reserve(changed.size());
  for (const auto& [words, storages] : changed) parts.push_back(fmt::format("{} ({})", words, storages));
  return {fmt::format("Changed ends of the range: {}.", fmt::join(parts, "; "))};
}

std::string range_in_words(double low, double high) {
  const std::string first = fmt::format("{:.4g}", low), last = fmt::format("{:.4g}", high);
  return first == last ? first : fmt::format("{} to {}", first, last);
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
        fmt::format("Where the highest digit is {}, {} ({}) shifts the depth by {} steps of the second.", kChartDigit,
                    grid.packing->name, name_of(grid.storage), range_in_words(*low, *high)));
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

const StudyRow* row_of(std::span<const StudyRow> rows, std::string_view packing, ChannelStorage storage, DepthSet set) {
  for (const StudyRow* row : rows_of(rows, name_of(storage), name_of(set))) {
    if (row->text("packing") == packing) return row;
  }
  return nullptr;
}

// The set of depths that describes a scene: floats are dense near 0.
DepthSet set_of_a_scene(const DepthPackingOptions& options) {
  return *std::max_element(options.sets.begin(), options.sets.end(), [](DepthSet a, DepthSet b) {
    const auto rank = [](DepthSet set) { return set == DepthSet::bits24 ? 2 : set == DepthSet::bits16 ? 1 : 0; };
    return rank(a) < rank(b);
  });
}

// How much a wrongly typed factor costs.
void add_typing_error(std::vector<std::string>& sentences, std::span<const StudyRow> rows, DepthSet set) {
  const StudyRow* const right = row_of(rows, "rgba8-base255", ChannelStorage::round, set);
  const StudyRow* const wrong = row_of(rows, "rgba8-base255-typo", ChannelStorage::round, set);
  if (right == nullptr || wrong == nullptr) return;
  const double ratio = wrong->number("mean_error") / right->number("mean_error");
  const bool small = std::max(ratio, wrong->number("max_error") / right->number("max_error")) < 2.0;
  sentences.push_back(fmt::format(
      "160581375 typed for 16581375 (rgba8-base255-typo) does {} ({}, round): mean error {:.3g} instead of {:.3g}, "
      "{:+.0f} %; largest error {:.3g} instead of {:.3g}; inversions {} instead of {}.",
      small ? "little harm" : "harm", set_in_words(name_of(set)), wrong->number("mean_error"),
      right->number("mean_error"), 100.0 * (ratio - 1.0), wrong->number("max_error"), right->number("max_error"),
      wrong->count("inversions"), right->count("inversions")));
}

// Whether a form that adds half a step may be stored in a texture that rounds.
void add_form_of_2007(std::vector<std::string>& sentences, std::span<const StudyRow> rows, DepthSet set) {
  constexpr std::string_view kForm = "rgba8-base255-2007";
  const StudyRow* const rounded = row_of(rows, kForm, ChannelStorage::round, set);
  const StudyRow* const truncated = row_of(rows, kForm, ChannelStorage::truncate, set);
  if (rounded == nullptr || truncated == nullptr) return;
  const double high = rounded->number("mean_bias"), low = truncated->number("mean_bias");
  sentences.push_back(
      fmt::format("The components of {} {} be rounded: depths then read {:+.3g} off in the mean; {:+.3g} if they are "
                  "truncated ({}).",
                  kForm, high > low ? "must not" : "may", high, low, set_in_words(name_of(set))));
}

// Which packings keep depth 1 and the order of all depths, for each storage, over all sets measured.
void add_order_keepers(std::vector<std::string>& sentences, const DepthPackingOptions& options,
                       std::span<const StudyRow> rows) {
  for (const ChannelStorage storage : options.storages) {
    std::vector<std::string> names;
    bool measured = true;  // a part of a study lacks rows
    for (const std::string& packing : options.packings) {
      bool keeps = true;
      for (const DepthSet set : options.sets) {
        const StudyRow* const row = row_of(rows, packing, storage, set);
        measured = measured && row != nullptr;
        keeps = keeps && row != nullptr && row->count("inversions") == 0 && row->number("one_reads_as") == 1.0;
      }
      if (keeps) names.push_back(packing);
    }
    if (!measured) continue;
    sentences.push_back(fmt::format("Depth 1 reads as 1 and no depths are inverted in any set, {}: {}.",
                                    rule_of(storage).help,
                                    names.empty() ? "no packing" : fmt::format("{}", fmt::join(names, ", "))));
  }
}

// Questions that are asked of these packings.
std::vector<std::string> questions_in_words(const DepthPackingOptions& options, std::span<const StudyRow> rows) {
  std::vector<std::string> sentences;
  const DepthSet set = set_of_a_scene(options);
  if (rows.empty()) return sentences;
  add_order_keepers(sentences, options, rows);
  add_typing_error(sentences, rows, set);
  add_form_of_2007(sentences, rows, set);
  return sentences;
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
    std::vector<StudyValue>& values = table.rows.emplace_back();
    for (const auto& [name, value] : row.fields) {
      if (table.rows.size() == 1) table.columns.push_back(is_below_one(name) ? name + " below 1" : name);
      values.push_back(value);
    }
  }
  table.caption =
      "Depths go from 0 to 1. An error is the value read back minus the depth. Over depths below 1, max_error is the "
      "largest absolute error, mean_error the mean absolute error and mean_bias the mean signed error. "
      "inversions: depths that are read back smaller than the previous depth.";
  return table;
}

ReportTable packing_table(const DepthPackingOptions& options) {
  ReportTable table{.title = "Packings", .columns = {"packing", "bytes", "formula", "found in"}, .rows = {}};
  for (const std::string& name : options.packings) {
    const DepthPacking& packing = *find_depth_packing(name);
    table.rows.push_back(
        {name, std::int64_t{packing.channels}, std::string(packing.formula), std::string(packing.source)});
  }
  table.caption = "The components of depth d, and the depth of components c as they are read.";
  return table;
}

ReportTable storage_table(const DepthPackingOptions& options) {
  ReportTable table{.title = "Storages", .columns = {"storage", "meaning", "formula", "found in"}, .rows = {}};
  for (const ChannelStorage storage : options.storages) {
    const StorageRule& rule = rule_of(storage);
    table.rows.push_back(
        {std::string(rule.name), std::string(rule.help), std::string(rule.formula), std::string(rule.source)});
  }
  table.caption = "The byte of component v, which is clamped to [0, 1]; and what byte n is read as.";
  return table;
}

}  // namespace

StudyReport depth_packing_report(const DepthPackingOptions& options, std::span<const StudyRow> rows) {
  StudyReport report{.title = "Depth packing", .answers = {}};
  const std::vector<DigitGrid> grids = digit_grids(options);
  const std::vector<std::string> questions = questions_in_words(options, rows), shifts = digits_in_words(grids, rows);
  for (const auto& sentences : {questions, ends_in_words(rows), shifts, errors_in_words(options, rows)}) {
    report.answers.insert(report.answers.end(), sentences.begin(), sentences.end());
  }
  for (const auto& sentences : {questions, exactness_in_words(options, rows), shifts}) {
    report.headlines.insert(report.headlines.end(), sentences.begin(), sentences.end());
  }
  report.summary.push_back(largest_errors(options, rows));
  report.tables = {packing_table(options), storage_table(options), error_table(rows)};
  report.plots = depth_packing_plots(options, grids);
  report.heat_maps = depth_packing_maps(grids);
  return report;
}

namespace {

double error_of(const DepthPacking& packing, ChannelStorage storage, float depth) {
  return static_cast<double>(read_depth(packing, store_depth(packing, depth, storage), storage)) -
         static_cast<double>(depth);
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
  Plot plot{.file = fmt::format("error-by-depth-{}", name_of(storage)),
            .title = fmt::format("Error by depth, {}", rule_of(storage).help),
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
