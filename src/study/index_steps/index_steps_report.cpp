#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "src/study/index_steps/index_steps_study.h"

namespace ninebit {
namespace {

// The rows of one profile, format and variant, by step.
struct Ladder {
  std::string profile, variant;
  StudyFormat format = StudyFormat::channel;
  std::vector<IndexStepRow> steps;

  // The smallest safe step, and the largest step with a false match.
  [[nodiscard]] const IndexStepRow* safe() const {
    const auto step = smallest_safe_step(steps, profile, format, variant);
    const auto found = std::find_if(steps.begin(), steps.end(), [&](const auto& row) { return row.step == step; });
    return found == steps.end() ? nullptr : &*found;
  }
  [[nodiscard]] const IndexStepRow* lossy() const {
    const auto found =
        std::find_if(steps.rbegin(), steps.rend(), [](const auto& row) { return row.count.false_matches > 0; });
    return found == steps.rend() ? nullptr : &*found;
  }
};

double share(const FalseMatches& count) {
  return count.pairs == 0 ? 0.0 : static_cast<double>(count.false_matches) / static_cast<double>(count.pairs);
}

// A number with thousands separators: 2,097,152.
std::string grouped(std::uint64_t n) {
  std::string text = std::to_string(n);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::vector<Ladder> ladders_of(std::span<const StudyRow> rows) {
  std::vector<Ladder> ladders;
  for (const StudyRow& study_row : rows) {
    IndexStepRow row = index_step_row(study_row);
    const bool same = !ladders.empty() && ladders.back().profile == row.profile &&
                      ladders.back().variant == row.variant && ladders.back().format == row.format;
    if (!same) ladders.push_back({row.profile, row.variant, row.format, {}});
    ladders.back().steps.push_back(std::move(row));
  }
  return ladders;
}

// Statements with the formats that they apply to, in order of first appearance.
class Sayings {
 public:
  void add(const std::string& saying, StudyFormat format) {
    auto found = std::find_if(list_.begin(), list_.end(), [&](const auto& one) { return one.first == saying; });
    if (found == list_.end()) found = list_.insert(list_.end(), {saying, {}});
    found->second.push_back(name_of(format));
  }
  // "128 codes in channel, l, a and 2,097,152 codes in rgb"
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [saying, formats] : list_) {
      if (!text.empty()) text += " and ";
      text += fmt::format("{} in {}", saying, fmt::join(formats, ", "));
    }
    return text;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string_view>>> list_;
};

// The smallest safe steps of one profile and variant, with the codes that remain in each format.
std::string safe_steps(std::span<const Ladder* const> ladders) {
  std::map<int, Sayings> by_step;
  Sayings unsafe;
  for (const Ladder* ladder : ladders) {
    const IndexStepRow* const safe = ladder->safe();
    if (safe != nullptr) by_step[safe->step].add(grouped(safe->count.codes) + " codes", ladder->format);
    if (safe == nullptr) unsafe.add("no studied step is safe", ladder->format);
  }
  std::string text = unsafe.text();
  for (const auto& [step, codes] : by_step) {
    text += fmt::format("{}step {} is the smallest safe one ({})", text.empty() ? "" : ", ", step, codes.text());
  }
  return text;
}

// The share of false matches at the largest step that has any.
std::string losses(std::span<const Ladder* const> ladders) {
  std::map<int, Sayings> by_step;
  for (const Ladder* ladder : ladders) {
    const IndexStepRow* const lossy = ladder->lossy();
    if (lossy == nullptr) continue;
    by_step[lossy->step].add(fmt::format("{:.3g} %", 100.0 * share(lossy->count)), ladder->format);
  }
  std::string text;
  for (const auto& [step, shares] : by_step) {
    text +=
        fmt::format("{}at step {}, different pairs compare equal: {}", text.empty() ? "" : "; ", step, shares.text());
  }
  return text.empty() ? "no studied step has false matches" : text;
}

// One answer for each profile and variant; profiles with the same answer for a variant share it.
std::vector<std::string> answers_of(const std::vector<Ladder>& ladders) {
  std::vector<std::pair<const Ladder*, std::vector<const Ladder*>>> groups;  // by profile and variant: the first, all
  for (const Ladder& ladder : ladders) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) {
      return g.first->profile == ladder.profile && g.first->variant == ladder.variant;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {&ladder, {}});
    group->second.push_back(&ladder);
  }
  std::vector<std::pair<std::string, std::string>> answers;  // profiles, and their common answer
  for (const auto& [head, of] : groups) {
    std::string said = fmt::format("{}: {}; {}.", head->variant, safe_steps(of), losses(of));
    const auto same = std::find_if(answers.begin(), answers.end(), [&](const auto& a) { return a.second == said; });
    if (same != answers.end()) same->first += ", " + head->profile;
    if (same == answers.end()) answers.emplace_back(head->profile, std::move(said));
  }
  std::vector<std::string> text;
  text.reserve(answers.size());
  for (const auto& [profiles, said] : answers) text.push_back(fmt::format("{} with {}", profiles, said));
  return text;
}

ReportTable table_of_safe_steps(const std::vector<Ladder>& ladders) {
  ReportTable table{.title = "Smallest safe steps",
                    .columns = {"profile", "format", "variant", "smallest safe step", "codes at that step",
                                "largest step with false matches", "false matches there", "share of the pairs"},
                    .rows = {},
                    .caption = "A step is safe if neither it nor any larger studied step has a false match."};
  for (const Ladder& ladder : ladders) {
    std::vector<StudyValue> row{ladder.profile, std::string(name_of(ladder.format)), ladder.variant};
    row.resize(table.columns.size());
    if (const IndexStepRow* const safe = ladder.safe()) {
      row[3] = std::int64_t{safe->step};
      row[4] = safe->count.codes;
    }
    if (const IndexStepRow* const lossy = ladder.lossy()) {
      row[5] = std::int64_t{lossy->step};
      row[6] = lossy->count.false_matches;
      row[7] = share(lossy->count);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable table_by_step(const IndexStepsOptions& options, const std::vector<Ladder>& ladders) {
  ReportTable table{.title = "False matches by step",
                    .columns = {"profile", "format", "variant"},
                    .rows = {},
                    .caption = "Ordered pairs of different indices that compare equal; one column per step."};
  for (int step = options.first_step; step <= options.last_step; ++step) table.columns.push_back(std::to_string(step));
  for (const Ladder& ladder : ladders) {
    std::vector<StudyValue> row{ladder.profile, std::string(name_of(ladder.format)), ladder.variant};
    for (const IndexStepRow& step : ladder.steps) row.emplace_back(step.count.false_matches);
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Adds a plot with one line of the share of false matches for each ladder that `wanted` accepts, unless there are none.
template <class Wanted, class Name>
std::optional<Plot> plot_of(const std::vector<Ladder>& ladders, Plot plot, const Wanted& wanted, const Name& name) {
  plot.x_label = "step";
  plot.y_label = "false matches per pair";
  plot.log_y = true;
  bool lost = false;
  for (const Ladder& ladder : ladders) {
    if (!wanted(ladder)) continue;
    PlotSeries& series = plot.series.emplace_back(PlotSeries{name(ladder), {}});
    for (const IndexStepRow& row : ladder.steps) {
      series.points.emplace_back(row.step, share(row.count));
      lost = lost || row.count.false_matches > 0;
    }
  }
  if (!lost) return std::nullopt;
  return plot;
}

void add_plots(const IndexStepsOptions& options, const std::vector<Ladder>& ladders, StudyReport& report) {
  if (ladders.empty()) return;
  const std::string first_variant = ladders.front().variant, first_profile = ladders.front().profile;
  for (const StudyFormat format : options.formats) {
    const std::string of(name_of(format));
    auto profiles = plot_of(
        ladders,
        {.file = "profiles-" + of,
         .title = fmt::format("False matches in {}, {}, by profile", of, first_variant),
         .x_label = "",
         .y_label = "",
         .series = {},
         .caption = "Where a line ends, no pair is lost any more."},
        [&](const Ladder& l) { return l.format == format && l.variant == first_variant; },
        [](const Ladder& l) { return l.profile; });
    auto variants = plot_of(
        ladders,
        {.file = "variants-" + of,
         .title = fmt::format("False matches in {}, {}, by variant of the program", of, first_profile),
         .x_label = "",
         .y_label = "",
         .series = {},
         .caption = "Where a line ends, no pair is lost any more."},
        [&](const Ladder& l) { return l.format == format && l.profile == first_profile; },
        [](const Ladder& l) { return l.variant; });
    if (profiles) report.plots.push_back(std::move(*profiles));
    if (variants && variants->series.size() > 1) report.plots.push_back(std::move(*variants));
  }
}

}  // namespace

StudyReport index_steps_report(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units,
                               std::span<const StudyRow> rows) {
  const std::vector<Ladder> ladders = ladders_of(rows);
  StudyReport report{.title = "Index steps", .answers = answers_of(ladders)};
  report.tables = {table_of_safe_steps(ladders), table_by_step(options, ladders)};
  add_plots(options, ladders, report);
  add_channel_pictures(options, units, report);
  return report;
}

}  // namespace ninebit
