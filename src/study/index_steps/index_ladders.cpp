#include "src/study/index_steps/index_ladders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "src/study/index_steps/index_steps_study.h"

namespace ninebit {
namespace {

// A plot with one line of the share of false matches for each ladder that `wanted` accepts, unless there are none.
template <class Wanted, class Name>
std::optional<Plot> plot_of(const std::vector<IndexLadder>& ladders, const Wanted& wanted, const Name& name) {
  Plot plot{.file = "",
            .title = "",
            .x_label = "step",
            .y_label = "false matches per pair",
            .log_y = true,
            .series = {},
            .caption = "Where a line ends, no pair is lost any more."};
  bool lost = false;
  for (const IndexLadder& ladder : ladders) {
    if (!wanted(ladder)) continue;
    PlotSeries& series = plot.series.emplace_back(PlotSeries{name(ladder), {}});
    for (const IndexStepRow& row : ladder.steps) {
      series.points.emplace_back(row.step, false_share(row.count));
      lost = lost || row.count.false_matches > 0;
    }
  }
  if (!lost) return std::nullopt;
  return plot;
}

// A plot of several formats whose false matches are the same: channel, l and a.
struct SharedPlot {
  Plot plot;
  std::vector<std::string_view> formats;
  std::string of;  // the title's end
};

bool same_lines(const Plot& a, const Plot& b) {
  return std::equal(a.series.begin(), a.series.end(), b.series.begin(), b.series.end(),
                    [](const PlotSeries& s, const PlotSeries& t) { return s.name == t.name && s.points == t.points; });
}

}  // namespace

const IndexStepRow* IndexLadder::safe() const {
  const auto step = smallest_safe_step(steps, profile, format, variant);
  const auto found = std::find_if(steps.begin(), steps.end(), [&](const auto& row) { return row.step == step; });
  return found == steps.end() ? nullptr : &*found;
}

const IndexStepRow* IndexLadder::lossy() const {
  const auto found =
      std::find_if(steps.rbegin(), steps.rend(), [](const auto& row) { return row.count.false_matches > 0; });
  return found == steps.rend() ? nullptr : &*found;
}

std::vector<IndexLadder> index_ladders(std::span<const StudyRow> rows) {
  std::vector<IndexLadder> ladders;
  for (const StudyRow& study_row : rows) {
    IndexStepRow row = index_step_row(study_row);
    const bool same = !ladders.empty() && ladders.back().profile == row.profile &&
                      ladders.back().variant == row.variant && ladders.back().format == row.format;
    if (!same) ladders.push_back({row.profile, row.variant, row.format, {}});
    ladders.back().steps.push_back(std::move(row));
  }
  return ladders;
}

double false_share(const FalseMatches& count) {
  return count.pairs == 0 ? 0.0 : static_cast<double>(count.false_matches) / static_cast<double>(count.pairs);
}

void add_ladder_plots(const IndexStepsOptions& options, const std::vector<IndexLadder>& ladders, StudyReport& report) {
  if (ladders.empty()) return;
  const std::string first_variant = ladders.front().variant, first_profile = ladders.front().profile;
  std::vector<SharedPlot> plots;
  const auto add = [&](const char* file, StudyFormat format, Plot plot, std::string of) {
    auto same = std::find_if(plots.begin(), plots.end(),
                             [&](const SharedPlot& s) { return s.of == of && same_lines(s.plot, plot); });
    if (same == plots.end()) {
      plot.file = fmt::format("{}-{}", file, name_of(format));
      same = plots.insert(plots.end(), {.plot = std::move(plot), .formats = {}, .of = std::move(of)});
    }
    same->formats.push_back(name_of(format));
  };
  for (const StudyFormat format : options.formats) {
    auto profiles = plot_of(
        ladders, [&](const IndexLadder& l) { return l.format == format && l.variant == first_variant; },
        [](const IndexLadder& l) { return l.profile; });
    auto variants = plot_of(
        ladders, [&](const IndexLadder& l) { return l.format == format && l.profile == first_profile; },
        [](const IndexLadder& l) { return l.variant; });
    const bool several = profiles && profiles->series.size() > 1,
               has_variants = variants && variants->series.size() > 1;
    if (profiles && !several && !has_variants) {
      add("profiles", format, std::move(*profiles), fmt::format("{}, {}", first_variant, first_profile));
    } else if (several) {
      add("profiles", format, std::move(*profiles), fmt::format("{}, by profile", first_variant));
    }
    if (has_variants) {
      add("variants", format, std::move(*variants), fmt::format("{}, by variant of the program", first_profile));
    }
  }
  for (SharedPlot& shared : plots) {
    shared.plot.title = fmt::format("False matches in {}: {}", fmt::join(shared.formats, ", "), shared.of);
    report.plots.push_back(std::move(shared.plot));
  }
}

}  // namespace ninebit
