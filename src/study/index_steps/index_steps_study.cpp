#include "src/study/index_steps/index_steps_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/validate.h"
#include "src/study/index_steps/false_matches.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

class IndexSteps final : public Study {
 public:
  IndexSteps(IndexStepsOptions options, std::vector<IndexStepsUnit> units)
      : options_(std::move(options)), units_(std::move(units)), question_(question_of(options_)) {}

  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override { return units_.size(); }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override {
    return fmt::format("{}, {}, {}", profile_of(unit).name, name_of(units_[unit].format), units_[unit].variant);
  }

  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    const IndexStepsUnit& of = units_[unit];
    const auto counter = FalseMatchCounter::prepare(of.program, profile_of(unit), of.format, go_on);
    if (!counter) return about_file(counter.error());
    const auto steps = static_cast<std::size_t>(options_.last_step - options_.first_step + 1);
    std::vector<Result<FalseMatches>> counts(steps, FalseMatches{});
    parallel_for(steps, [&](std::size_t i) {
      counts[i] = counter->count(values_of_step(options_.first_step + static_cast<int>(i)), of.separate, go_on);
    });
    std::vector<StudyRow> rows;
    for (std::size_t i = 0; i < steps; ++i) {
      if (!counts[i]) return about_file(counts[i].error());
      rows.push_back(study_row({std::string(profile_of(unit).name), of.format, of.variant,
                                options_.first_step + static_cast<int>(i), *counts[i]}));
    }
    return rows;
  }

  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    const IndexStepsUnit& of = units_[unit];
    std::vector<RowRule> rules;
    for (int step = options_.first_step; step <= options_.last_step; ++step) {
      std::uint64_t codes = 1;
      for (int channel = 0; channel < channels_of(of.format); ++channel) codes *= values_of_step(step).size();
      rules.push_back({.fields = {exactly("profile", std::string(profile_of(unit).name)),
                                  exactly("format", std::string(name_of(of.format))), exactly("variant", of.variant),
                                  exactly("step", std::int64_t{step}), exactly("codes", codes),
                                  exactly("pairs", codes * (codes - 1)),
                                  count_up_to("false_matches", static_cast<double>(codes * (codes - 1)))}});
    }
    return rules;
  }

  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow> rows, std::size_t done) const override {
    StudyReport report = index_steps_report(options_, units_, rows);
    if (done < units_.size()) {
      const std::string partial =
          fmt::format("{} of {} combinations of profile, format and variant were counted.", done, units_.size());
      report.answers.insert(report.answers.begin(), partial);
      if (!report.headlines.empty()) report.headlines.insert(report.headlines.begin(), partial);
    }
    return report;
  }

 private:
  [[nodiscard]] const HardwareProfile& profile_of(std::size_t unit) const {
    return options_.profiles[units_[unit].profile];
  }
  // An error in the caller's program, with its file.
  [[nodiscard]] Diagnostic about_file(Diagnostic fault) const {
    if (options_.program && fault.fault == Fault::invalid_input) fault.file = options_.program->file;
    return fault;
  }

  static StudyQuestion question_of(const IndexStepsOptions& options) {
    StudyQuestion question = options.question;
    question.options.emplace_back("--steps", fmt::format("{}-{}", options.first_step, options.last_step));
    std::vector<std::string_view> formats, variants;
    for (const StudyFormat format : options.formats) formats.push_back(name_of(format));
    for (const IndexVariant& variant : options.variants) variants.push_back(variant.name);
    question.options.emplace_back("--formats", fmt::format("{}", fmt::join(formats, ",")));
    if (options.program) {
      question.options.emplace_back("--program", options.program->file);
    } else {
      question.options.emplace_back("--variants", fmt::format("{}", fmt::join(variants, ",")));
    }
    return question;
  }

  IndexStepsOptions options_;
  std::vector<IndexStepsUnit> units_;
  StudyQuestion question_;
};

// The error in a list or a range; empty if there is none.
std::string complaint(const IndexStepsOptions& o) {
  if (o.profiles.empty()) return "no profile given; expected at least one";
  if (o.formats.empty()) return "no format given; expected at least one";
  if (!o.program && o.variants.empty()) return "no program given; expected at least one variant";
  if (o.program && o.program->states.size() != o.profiles.size()) return "expected a program for each profile";
  if (o.first_step < 1 || o.last_step > 255 || o.first_step > o.last_step) {
    return fmt::format("steps {} to {}: out of range; expected 1 to 255, the smaller first", o.first_step, o.last_step);
  }
  return {};
}

}  // namespace

StudyRow study_row(const IndexStepRow& row) {
  StudyRow out;
  out.fields.emplace_back("profile", row.profile);
  out.fields.emplace_back("format", std::string(name_of(row.format)));
  out.fields.emplace_back("variant", row.variant);
  out.fields.emplace_back("step", std::int64_t{row.step});
  out.fields.emplace_back("codes", row.count.codes);
  out.fields.emplace_back("pairs", row.count.pairs);
  out.fields.emplace_back("false_matches", row.count.false_matches);
  return out;
}

IndexStepRow index_step_row(const StudyRow& row) {
  IndexStepRow out{row.text("profile"),
                   StudyFormat::channel,
                   row.text("variant"),
                   static_cast<int>(std::clamp(row.number("step"), 0.0, 255.0)),
                   {row.count("codes"), row.count("pairs"), row.count("false_matches")}};
  const std::string name = row.text("format");
  for (const StudyFormat format : kStudyFormats) {
    if (name_of(format) == name) out.format = format;
  }
  return out;
}

Result<std::unique_ptr<Study>> index_steps_study(IndexStepsOptions options) {
  if (const std::string wrong = complaint(options); !wrong.empty()) return Diagnostic{.message = wrong};
  std::vector<IndexStepsUnit> units;
  for (std::size_t p = 0; p < options.profiles.size(); ++p) {
    const HardwareProfile& profile = options.profiles[p];
    for (const StudyFormat format : options.formats) {
      if (options.program) {
        const CombinerState& state = options.program->states[p];
        if (const auto refused = validate(state, profile); !refused.empty()) {
          std::string message = fmt::format("profile {} refuses the program: {}", profile.name, refused[0].message);
          if (refused.size() > 1) message += fmt::format(" (the first of {} faults)", refused.size());
          return Diagnostic{.message = std::move(message), .file = options.program->file};
        }
        units.push_back({p, format, "program", false, normalize(state, profile)});
        continue;
      }
      for (const IndexVariant& variant : options.variants) {
        if (variant.separate && channels_of(format) == 1) continue;
        const auto state = index_variant_state(profile, format, variant);
        if (!state) return state.error();
        const auto program = compile(*state, profile);
        if (!program) return program.error();
        units.push_back({p, format, std::string(variant.name), variant.separate, *program});
      }
    }
  }
  if (units.empty()) {
    return Diagnostic{.message =
                          "separate comparisons differ from others only if an index has several channels; "
                          "expected the format rgb or la, or another variant"};
  }
  return std::unique_ptr<Study>(std::make_unique<IndexSteps>(std::move(options), std::move(units)));
}

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
