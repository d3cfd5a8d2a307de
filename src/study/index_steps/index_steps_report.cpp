#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/numerics/fixed9.h"
#include "src/study/digits/digits.h"
#include "src/study/index_steps/false_matches.h"
#include "src/study/index_steps/index_steps_study.h"

namespace ninebit {
namespace {

// A number with thousands separators: 2,097,152.
std::string grouped(std::uint64_t n) {
  std::string text = std::to_string(n);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

// Statements with the formats that they apply to, in order of first appearance.
class StatementsByFormat {
 public:
  void add(const std::string& statement, StudyFormat format) {
    auto found = std::find_if(list_.begin(), list_.end(), [&](const auto& one) { return one.first == statement; });
    if (found == list_.end()) found = list_.insert(list_.end(), {statement, {}});
    found->second.push_back(name_of(format));
  }
  // "128 codes in channel, l, a and 2,097,152 codes in rgb"
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [statement, formats] : list_) {
      if (!text.empty()) text += " and ";
      text += fmt::format("{} in {}", statement, fmt::join(formats, ", "));
    }
    return text;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string_view>>> list_;
};

// The smallest safe steps of one profile and variant, with the codes that remain in each format.
std::string safe_steps(std::span<const IndexLadder* const> ladders) {
  std::map<int, StatementsByFormat> by_step;
  StatementsByFormat unsafe;
  for (const IndexLadder* ladder : ladders) {
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
std::string losses(std::span<const IndexLadder* const> ladders) {
  std::map<int, StatementsByFormat> by_step;
  for (const IndexLadder* ladder : ladders) {
    const IndexStepRow* const lossy = ladder->lossy();
    if (lossy == nullptr) continue;
    by_step[lossy->step].add(fmt::format("{:.3g} %", 100.0 * false_share(lossy->count)), ladder->format);
  }
  std::string text;
  for (const auto& [step, shares] : by_step) {
    text +=
        fmt::format("{}at step {}, different pairs compare equal: {}", text.empty() ? "" : "; ", step, shares.text());
  }
  return text.empty() ? "no studied step has false matches" : text;
}

// One answer for each profile and variant; profiles with the same answer for a variant share it.
std::vector<std::string> answers_of(const std::vector<IndexLadder>& ladders) {
  std::vector<std::pair<const IndexLadder*, std::vector<const IndexLadder*>>>
      groups;  // by profile and variant: the first, all
  for (const IndexLadder& ladder : ladders) {
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

// The smallest safe steps of one profile and variant, in the fewest words: "2", "2 (rgb: 3)", "none".
std::string safe_steps_in_short(std::span<const IndexLadder* const> ladders) {
  const auto step_of = [](const IndexLadder* ladder) {
    const IndexStepRow* const safe = ladder->safe();
    return safe == nullptr ? std::string("none") : std::to_string(safe->step);
  };
  if (ladders.empty()) return {};
  const std::string first = step_of(ladders.front());
  std::vector<std::string> others;
  for (const IndexLadder* ladder : ladders) {
    if (step_of(ladder) != first) others.push_back(fmt::format("{}: {}", name_of(ladder->format), step_of(ladder)));
  }
  return others.empty() ? first : fmt::format("{} ({})", first, fmt::join(others, ", "));
}

// A row for each variant, a column for each profile.
ReportTable safe_step_matrix(const std::vector<IndexLadder>& ladders) {
  ReportTable table{.title = "Smallest safe step by variant and profile",
                    .columns = {"variant"},
                    .rows = {},
                    .caption =
                        "A step is safe if neither it nor any larger studied step has a false match. In "
                        "brackets: formats with another step. The tables below have codes and false matches."};
  std::vector<std::string> variants;
  for (const IndexLadder& ladder : ladders) {
    const auto add = [](std::vector<std::string>& names, const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    add(variants, ladder.variant);
    add(table.columns, ladder.profile);
  }
  for (const std::string& variant : variants) {
    std::vector<StudyValue>& row = table.rows.emplace_back();
    row.emplace_back(variant);
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
      std::vector<const IndexLadder*> cell;
      for (const IndexLadder& ladder : ladders) {
        if (ladder.variant == variant && ladder.profile == table.columns[c]) cell.push_back(&ladder);
      }
      const std::string text = safe_steps_in_short(cell);
      const bool is_whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
      row.push_back(is_whole ? StudyValue(std::int64_t{std::stoi(text)}) : StudyValue(text));
    }
  }
  return table;
}

// The answer for the first variant: the profiles of each smallest safe step.
std::string first_variant_in_words(const ReportTable& matrix) {
  std::vector<std::pair<std::string, std::vector<std::string>>> steps;
  for (std::size_t c = 1; c < matrix.columns.size(); ++c) {
    const std::string step = text_of(matrix.rows.front()[c]);
    auto found = std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s.first == step; });
    if (found == steps.end()) found = steps.insert(steps.end(), {step, {}});
    found->second.push_back(matrix.columns[c]);
  }
  std::vector<std::string> parts;
  for (const auto& [step, profiles] : steps) parts.push_back(fmt::format("{} on {}", step, fmt::join(profiles, ", ")));
  return fmt::format("{}: the smallest safe step is {}.", text_of(matrix.rows.front().front()), fmt::join(parts, "; "));
}

ReportTable table_of_safe_steps(const std::vector<IndexLadder>& ladders) {
  ReportTable table{.title = "Smallest safe steps",
                    .columns = {"profile", "format", "variant", "smallest safe step", "codes at that step",
                                "largest step with false matches", "false matches there", "share of the pairs"},
                    .rows = {},
                    .caption = "A step is safe if neither it nor any larger studied step has a false match."};
  for (const IndexLadder& ladder : ladders) {
    std::vector<StudyValue> row{ladder.profile, std::string(name_of(ladder.format)), ladder.variant};
    row.resize(table.columns.size());
    if (const IndexStepRow* const safe = ladder.safe()) {
      row[3] = std::int64_t{safe->step};
      row[4] = safe->count.codes;
    }
    if (const IndexStepRow* const lossy = ladder.lossy()) {
      row[5] = std::int64_t{lossy->step};
      row[6] = lossy->count.false_matches;
      row[7] = false_share(lossy->count);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable table_by_step(const IndexStepsOptions& options, const std::vector<IndexLadder>& ladders) {
  ReportTable table{.title = "False matches by step",
                    .columns = {"profile", "format", "variant"},
                    .rows = {},
                    .caption = "Ordered pairs of different indices that compare equal; one column per step."};
  for (int step = options.first_step; step <= options.last_step; ++step) table.columns.push_back(std::to_string(step));
  for (const IndexLadder& ladder : ladders) {
    std::vector<StudyValue> row{ladder.profile, std::string(name_of(ladder.format)), ladder.variant};
    for (const IndexStepRow& step : ladder.steps) row.emplace_back(step.count.false_matches);
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

StudyReport index_steps_report(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units,
                               std::span<const StudyRow> rows) {
  const std::vector<IndexLadder> ladders = index_ladders(rows);
  StudyReport report{.title = "Index steps", .answers = answers_of(ladders)};
  if (!ladders.empty()) {
    report.summary = {safe_step_matrix(ladders)};
    report.headlines = {first_variant_in_words(report.summary.front())};
  }
  report.tables = {table_of_safe_steps(ladders), table_by_step(options, ladders)};
  add_ladder_plots(options, ladders, report);
  add_channel_pictures(options, units, report);
  return report;
}

// Pictures of one channel's comparison: every pair of its 256 values, and every difference at every step.

namespace {

constexpr int kByteValues = 256;

// The alpha byte of each pair, at index 256 own + other.
std::vector<std::uint8_t> alphas_of(const Program& program, const HardwareProfile& profile) {
  static_assert(kBatchSize >= kByteValues);
  const BatchProgram run(program, {.color = {false, false, false, true}, .registers = false});
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  std::vector<std::uint8_t> alphas;
  for (int own = 0; own < kByteValues; ++own) {
    for (std::size_t other = 0; other < kByteValues; ++other) {
      const RegisterFile file = comparison_registers(profile, StudyFormat::channel, {static_cast<std::uint8_t>(own)},
                                                     {static_cast<std::uint8_t>(other)});
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) registers->plane[r][c][other] = file.value[r][c];
      }
    }
    run.run(*registers, kByteValues, *out);
    for (std::size_t other = 0; other < kByteValues; ++other) {
      alphas.push_back(to_byte(profile, out->plane[kAlpha][other]));
    }
  }
  return alphas;
}

HeatMap pair_map(const std::string& name, std::string_view file, const std::vector<std::uint8_t>& alphas) {
  HeatMap map{.file = fmt::format("alpha-{}", file),
              .title = fmt::format("Alpha of every pair of channel values: {}", name),
              .x_label = "texture's value",
              .y_label = "own value",
              .x_last = kByteValues - 1,
              .y_last = kByteValues - 1,
              .width = kByteValues,
              .height = kByteValues,
              .values = {alphas.begin(), alphas.end()},
              .low = 0.0F,
              .high = 255.0F,
              .caption = "Grey: different values that compare equal (alpha 0).",
              .none = "0, compares equal"};
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (i / kByteValues != i % kByteValues && alphas[i] == 0) map.values[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return map;
}

// The differences that compare equal among the values of each step.
HeatMap step_map(const IndexStepsOptions& options, const std::string& name, std::string_view file,
                 const std::vector<std::uint8_t>& alphas) {
  const int reach = std::max(32, options.last_step), width = 2 * reach + 1;
  HeatMap map{.file = fmt::format("equal-{}", file),
              .title = fmt::format("Differences that compare equal: {}", name),
              .x_label = "difference of the channel values",
              .y_label = "step",
              .x_first = -static_cast<double>(reach),
              .x_last = static_cast<double>(reach),
              .y_first = static_cast<double>(options.first_step),
              .y_last = static_cast<double>(options.last_step),
              .width = width,
              .height = options.last_step - options.first_step + 1,
              .values = {},
              .low = 0.0F,
              .high = 1.0F,
              .caption =
                  "The share of the step's pairs with that difference that compare equal. It should be 0 except at "
                  "difference 0. Grey: the step has no such pair.",
              .none = "no such pair"};
  for (int step = options.first_step; step <= options.last_step; ++step) {
    std::vector<int> pairs(static_cast<std::size_t>(width)), equal(pairs);
    for (int own = 0; own < kByteValues; own += step) {
      for (int other = 0; other < kByteValues; other += step) {
        if (std::abs(own - other) > reach) continue;
        const auto at = static_cast<std::size_t>(own - other + reach);
        ++pairs[at];
        if (alphas[static_cast<std::size_t>(kByteValues * own + other)] == 0) ++equal[at];
      }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const float share = static_cast<float>(equal[i]) / static_cast<float>(std::max(pairs[i], 1));
      map.values.push_back(pairs[i] > 0 ? share : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return map;
}

// For each difference, the smallest alpha of the pairs with it.
PlotSeries smallest_alphas(const std::string& name, const std::vector<std::uint8_t>& alphas) {
  constexpr int kReach = 32;
  std::array<int, kReach + 1> least{};
  least.fill(255);
  for (int own = 0; own < kByteValues; ++own) {
    for (int other = std::max(0, own - kReach); other <= std::min(kByteValues - 1, own + kReach); ++other) {
      int& of_difference = least[static_cast<std::size_t>(std::abs(own - other))];
      of_difference = std::min(of_difference, int{alphas[static_cast<std::size_t>(kByteValues * own + other)]});
    }
  }
  PlotSeries series{name, {}};
  for (std::size_t difference = 1; difference < least.size(); ++difference) {
    series.points.emplace_back(static_cast<double>(difference), least[difference]);
  }
  return series;
}

}  // namespace

void add_channel_pictures(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units,
                          StudyReport& report) {
  std::vector<HeatMap> pair_maps;
  for (std::size_t p = 0; p < options.profiles.size(); ++p) {
    const HardwareProfile& profile = options.profiles[p];
    Plot plot{.file = fmt::format("alpha-of-difference-{}", profile.name),
              .title = fmt::format("Smallest alpha by size of a channel's difference: {}", profile.name),
              .x_label = "size of the difference",
              .y_label = "smallest alpha",
              .log_y = true,
              .series = {},
              .caption = "Differences below the start of a line have alpha 0: they compare equal."};
    for (const IndexStepsUnit& unit : units) {
      if (unit.profile != p || unit.format != StudyFormat::channel) continue;
      const std::vector<std::uint8_t> alphas = alphas_of(unit.program, profile);
      const std::string name = fmt::format("{}, {}", profile.name, unit.variant);
      const std::string file = fmt::format("{}-{}", profile.name, unit.variant);
      if (plot.series.empty()) pair_maps.push_back(pair_map(name, file, alphas));
      report.heat_maps.push_back(step_map(options, name, file, alphas));
      plot.series.push_back(smallest_alphas(unit.variant, alphas));
    }
    if (!plot.series.empty()) report.plots.push_back(std::move(plot));
  }
  report.heat_maps.insert(report.heat_maps.end(), pair_maps.begin(), pair_maps.end());
}

}  // namespace ninebit
