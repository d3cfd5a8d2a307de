// `ninebit study datapath`: how far each operation is from exact arithmetic.
#include <fmt/format.h>

#include <memory>

#include "ninebit/study/datapath_error.h"
#include "src/tools/scene_flags.h"
#include "src/tools/study.h"

namespace ninebit::tools {
namespace {

Json json_of(const OperationError& e) {
  return {{"profile", e.profile},       {"operation", e.operation},   {"form", e.form},
          {"cases", e.cases},           {"exact", e.exact},           {"distinct", e.distinct},
          {"max_error", e.max_error},   {"mean_error", e.mean_error}, {"mean_bias", e.mean_bias},
          {"worst", e.worst},           {"worst_code", e.worst_code}, {"worst_exact", e.worst_exact}};
}

Json json_of(const OperationDifference& d) {
  return {{"first", d.first}, {"second", d.second}, {"operation", d.operation},
          {"form", d.form},   {"cases", d.cases},   {"differ", d.differ}};
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string words(const DatapathErrors& errors) {
  std::string text;
  std::string profile;
  for (const OperationError& e : errors.errors) {
    if (e.profile != profile) {
      text += fmt::format("{}{}\n  {:<15} {:<20} {:>20} {:>8} {:>9} {:>10} {:>10} {:>11}  {}\n", profile.empty() ? "" : "\n",
                          e.profile, "operation", "form", "inputs", "codes", "exact %", "max error", "mean", "bias",
                          "worst");
      profile = e.profile;
    }
    text += fmt::format("  {:<15} {:<20} {:>20} {:>8} {:>9.3f} {:>10.6f} {:>10.6f} {:>11.2e}  {} -> {}, exact {:.6f}\n",
                        e.operation, e.form, e.cases, e.distinct, percent(e.exact, e.cases), e.max_error, e.mean_error,
                        e.mean_bias, e.worst, e.worst_code, e.worst_exact);
  }
  if (!errors.differences.empty()) text += "\ninputs on which two profiles give different codes\n";
  for (const OperationDifference& d : errors.differences) {
    if (d.differ == 0) continue;
    text += fmt::format("  {} and {}: {} {}: {} of {} ({:.3g} %)\n", d.first, d.second, d.operation, d.form, d.differ,
                        d.cases, percent(d.differ, d.cases));
  }
  return text;
}

int datapath(const StudyFlags& flags) {
  const ThreadLimit limit(flags.common.threads);
  const std::vector<HardwareProfile> profiles = profiles_of(flags);
  ProgressLine line(flags.common.quiet);
  const auto errors =
      measure_datapath(profiles, [&](double done) { return line.step("operations of the datapath", done); });
  if (!errors) return report(errors.error());
  if (!flags.common.json) return answer(words(*errors));
  Json out{{"command", "study datapath"}, {"version", NINEBIT_VERSION}};
  out["profile"] = flags.profile->count() > 0 ? flags.common.profile : "all";
  out["rows"] = Json::array();
  out["differences"] = Json::array();
  for (const OperationError& e : errors->errors) out["rows"].push_back(json_of(e));
  for (const OperationDifference& d : errors->differences) out["differences"].push_back(json_of(d));
  return answer(out.dump(2) + "\n");
}

}  // namespace

void add_study_datapath(CLI::App& study, int& exit_code) {
  CLI::App* verb = study.add_subcommand("datapath", "Errors of every operation of the datapath, over all inputs");
  verb->footer("Example: ninebit study datapath --profile geforce2");
  auto flags = std::make_shared<StudyFlags>();
  add_study_flags(*verb, *flags);
  verb->callback([flags, &exit_code] { exit_code = datapath(*flags); });
}

}  // namespace ninebit::tools
