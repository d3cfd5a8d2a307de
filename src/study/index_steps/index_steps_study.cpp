#include "src/study/index_steps/index_steps_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

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

}  // namespace ninebit
