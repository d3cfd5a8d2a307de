// `ninebit study index-steps`: how many pairs of different indices a comparison takes for equal.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "ninebit/study/index_steps.h"
#include "src/tools/number_list.h"
#include "src/tools/program_file.h"
#include "src/tools/scene_flags.h"
#include "src/tools/study.h"

namespace ninebit::tools {
namespace {

struct IndexStepsFlags {
  StudyFlags study;
  std::string steps = "1-16";
  std::string formats, variants;
  std::string program;
};

std::vector<std::string> all_formats() {
  std::vector<std::string> names;
  for (const StudyFormat format : kStudyFormats) names.emplace_back(name_of(format));
  return names;
}

std::vector<std::string> all_variants() {
  std::vector<std::string> names;
  for (const IndexVariant& variant : index_variants()) names.emplace_back(variant.name);
  return names;
}

// "N" or "FIRST-LAST".
std::optional<std::pair<int, int>> steps_of(const std::string& text) {
  const auto n = numbers<int>(text, '-');
  if (!n || n->empty() || n->size() > 2 || n->front() < 1 || n->back() > 255 || n->front() > n->back()) {
    return std::nullopt;
  }
  return std::pair{n->front(), n->back()};
}

// What is counted for one profile and format: a program, and whether its digits are compared one by one.
struct Question {
  std::string variant;
  Program program;
  bool separate = false;
};

// Every question that the flags ask of a profile and a format; empty with `exit_code` set where one cannot be asked.
std::optional<std::vector<Question>> questions(const IndexStepsFlags& flags, const HardwareProfile& profile,
                                               StudyFormat format, int& exit_code) {
  std::vector<Question> out;
  const auto ask = [&](std::string name, const Result<CombinerState>& state, bool separate) {
    const auto program = state ? compile(*state, profile) : Result<Program>(state.error());
    if (!program) return exit_code = report(program.error()), false;
    out.push_back({std::move(name), *program, separate});
    return true;
  };
  if (!flags.program.empty()) {
    const auto state = load_program({.file = flags.program, .from = "", .chip = ""}, profile, exit_code);
    if (!state || !ask("program", *state, false)) return std::nullopt;
    return out;
  }
  const std::vector<std::string> wanted = flags.variants.empty() ? all_variants() : items_of(flags.variants);
  const bool one_digit = format != StudyFormat::rgb && format != StudyFormat::luminance_alpha;
  for (const IndexVariant& variant : index_variants()) {
    if (std::find(wanted.begin(), wanted.end(), variant.name) == wanted.end()) continue;
    if (one_digit && variant.separate) continue;  // the same as together
    const auto state = index_variant_state(profile, format, variant);
    if (!ask(std::string(variant.name), state, variant.separate)) return std::nullopt;
  }
  return out;
}

Json json_of(const IndexStepRow& row) {
  return {{"profile", row.profile},         {"format", name_of(row.format)},
          {"variant", row.variant},         {"step", row.step},
          {"codes", row.count.codes},       {"pairs", row.count.pairs},
          {"false_matches", row.count.false_matches}};
}

// One line for each profile, format and variant: the smallest safe step, what it leaves, what the step below loses.
std::string words(const std::vector<IndexStepRow>& rows) {
  std::string text;
  for (std::size_t first = 0; first < rows.size();) {
    const IndexStepRow& head = rows[first];
    std::size_t end = first;
    const IndexStepRow* safe = nullptr;
    const IndexStepRow* lossy = nullptr;  // the largest step that loses a pair
    const auto same = [&](const IndexStepRow& r) {
      return r.profile == head.profile && r.format == head.format && r.variant == head.variant;
    };
    const std::optional<int> smallest = smallest_safe_step(rows, head.profile, head.format, head.variant);
    for (; end < rows.size() && same(rows[end]); ++end) {
      if (smallest && rows[end].step == *smallest) safe = &rows[end];
      if (rows[end].count.false_matches > 0) lossy = &rows[end];
    }
    text += fmt::format("{:<25} {:<8} {:<19}", head.profile, name_of(head.format), head.variant);
    text += safe != nullptr ? fmt::format("step {:>2} is safe: {} codes", safe->step, safe->count.codes)
                            : std::string("no step asked for is safe");
    if (lossy != nullptr) {
      const double share = static_cast<double>(lossy->count.false_matches) / static_cast<double>(lossy->count.pairs);
      text += fmt::format("; step {} loses {} of {} pairs ({:.3g} %)", lossy->step, lossy->count.false_matches,
                          lossy->count.pairs, 100.0 * share);
    }
    text += '\n';
    first = end;
  }
  return text;
}

int index_steps(const IndexStepsFlags& flags) {
  const ThreadLimit limit(flags.study.common.threads);
  const auto [first, last] = *steps_of(flags.steps);
  std::vector<std::string> formats = flags.formats.empty() ? all_formats() : items_of(flags.formats);
  const std::vector<HardwareProfile> profiles = profiles_of(flags.study);
  std::vector<IndexStepRow> rows;
  ProgressLine line(flags.study.common.quiet);
  const double all = static_cast<double>(profiles.size() * kStudyFormats.size());
  double done = 0.0;
  for (const HardwareProfile& profile : profiles) {
    for (const StudyFormat format : kStudyFormats) {
      done += 1.0;
      if (std::find(formats.begin(), formats.end(), name_of(format)) == formats.end()) continue;
      int exit_code = kDone;
      const auto asked = questions(flags, profile, format, exit_code);
      if (!asked) return exit_code;
      for (const Question& question : *asked) {
        for (int step = first; step <= last; ++step) {
          if (!line.step(fmt::format("{}, {}", profile.name, name_of(format)), (done - 1.0) / all)) {
            return report({.message = "interrupted", .fault = Fault::cancelled});
          }
          const auto count = count_false_matches(question.program, profile, format, step, question.separate,
                                                 [] { return !ProgressLine::stopped(); });
          if (!count) {
            Diagnostic fault = count.error();
            if (fault.file.empty()) fault.file = flags.program;
            return report(fault);
          }
          rows.push_back({std::string(profile.name), format, question.variant, step, *count});
        }
      }
    }
  }
  if (!flags.study.common.json) return answer(words(rows));
  Json out{{"command", "study index-steps"}, {"version", NINEBIT_VERSION}};
  out["profile"] = flags.study.profile->count() > 0 ? flags.study.common.profile : "all";
  for (const IndexStepRow& row : rows) out["rows"].push_back(json_of(row));
  return answer(out.dump(2) + "\n");
}

}  // namespace

void add_study_index_steps(CLI::App& study, int& exit_code) {
  CLI::App* verb = study.add_subcommand("index-steps", "False matches of index comparisons, by step");
  verb->footer(
      "Examples:\n"
      "  ninebit study index-steps\n"
      "  ninebit study index-steps --profile geforce2 --formats channel,rgb --steps 1-4 --json\n"
      "  ninebit study index-steps --program docs/programs/index_compare.gl --formats rgb");
  auto flags = std::make_shared<IndexStepsFlags>();
  add_study_flags(*verb, flags->study);
  const auto check_steps = [](const std::string& text) -> std::string {
    return steps_of(text) ? "" : fmt::format("'{}' is no step; expected N or FIRST-LAST, from 1 to 255", text);
  };
  verb->add_option("--steps", flags->steps, "Steps between indices")
      ->type_name("N|FIRST-LAST")
      ->capture_default_str()
      ->check(CLI::Validator(check_steps, ""));
  verb->add_option("--formats", flags->formats, "What holds an index (default: all): channel,rgb,la,l,a")
      ->type_name("LIST")
      ->check(list_of(all_formats()));
  CLI::Option* variants =
      verb->add_option("--variants", flags->variants, "Forms of the article's program (default: all)")
          ->type_name("LIST")
          ->check(list_of(all_variants()));
  verb->add_option("--program", flags->program, "A program of your own: primary against texture 0, alpha 0 where equal")
      ->type_name("FILE")
      ->excludes(variants);
  verb->callback([flags, &exit_code] { exit_code = index_steps(*flags); });
}

}  // namespace ninebit::tools
