// `ninebit validate`: every GL error that a program raises.
#include "ninebit/combiner/validate.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string_view>
#include <tuple>

#include "ninebit/numerics/hardware_profile.h"
#include "src/tools/common/program_file.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

struct ValidateFlags {
  CommonFlags common;
  ProgramFlags program;
};

struct Finding {
  StateDiagnostic what;
  int line = 0, column = 0;  // 0: not about one place in the text
};

// Faults without a GL error are about the text: misspelled names, wrong numbers of arguments, faulty programs.
bool is_refusal(const TextFault& fault) {
  return fault.gl_error != GlError::no_error;
}

Finding finding_of(const TextFault& fault) {
  Finding finding{{}, fault.line, fault.column};
  finding.what.gl_error = fault.gl_error;
  finding.what.message = fault.message;
  return finding;
}

Json or_null(const auto& value, bool known) {
  return known ? Json(value) : Json(nullptr);
}

Json row_of(const Finding& finding) {
  constexpr std::string_view kVariables = "ABCDEFG";
  const StateDiagnostic& d = finding.what;
  const bool rgb = d.portion == PortionName::rgb;
  const auto variable = d.variable ? static_cast<std::size_t>(*d.variable) : std::size_t{0};
  return {{"gl_error", or_null(name_of(d.gl_error), d.gl_error != GlError::no_error)},
          {"stage", or_null(d.stage.value_or(0), d.stage.has_value())},
          {"portion", or_null(rgb ? "rgb" : "alpha", d.portion.has_value())},
          {"variable", or_null(std::string(kVariables.substr(variable, 1)), d.variable.has_value())},
          {"line", or_null(finding.line, finding.line > 0)},
          {"column", or_null(finding.column, finding.line > 0)},
          {"message", d.message}};
}

Json functions_json(const std::vector<SourceFunction>& functions) {
  Json all = Json::array();
  for (const SourceFunction& f : functions) {
    all.push_back({{"name", f.name},
                   {"line", f.line},
                   {"helper", f.is_helper},
                   {"calls_read", f.calls_read},
                   {"calls_not_read", f.calls_not_read},
                   {"calls_refused", f.calls_refused},
                   {"needs", f.needs}});
  }
  return all;
}

std::string functions_text(const std::vector<SourceFunction>& functions) {
  const auto name_of = [](const SourceFunction& f) {
    return printable(f.name.empty() ? "(outside of functions)" : f.name);
  };
  std::size_t width = 24;
  for (const SourceFunction& f : functions) width = std::max(width, name_of(f).size());
  std::string text = fmt::format("{:<{}}  line  calls read  not read  refused  needs\n", "function", width);
  for (const SourceFunction& f : functions) {
    std::vector<std::string> needs = f.needs;
    if (f.is_helper) needs.insert(needs.begin(), "(is called with arguments)");
    text += fmt::format("{:<{}}  {:>4}  {:>10}  {:>8}  {:>7}  {}\n", name_of(f), width, f.line, f.calls_read,
                        f.calls_not_read, f.calls_refused, printable(fmt::format("{}", fmt::join(needs, " "))));
  }
  return text;
}

// The faults of all functions in the order of the text, each once: a function that is called by another one is
// executed twice.
std::vector<TextFault> faults_of(const std::vector<SourceFunction>& functions) {
  std::set<std::string> seen;
  std::vector<TextFault> faults;
  for (const SourceFunction& f : functions) {
    for (const TextFault& fault : f.faults) {
      if (seen.insert(fault.text()).second) faults.push_back(fault);
    }
  }
  std::stable_sort(faults.begin(), faults.end(), [](const TextFault& a, const TextFault& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  return faults;
}

// A source whose functions were not chosen from: what there is.
int list_functions(const ValidateFlags& flags, const ProgramFile& file, const HardwareProfile& profile) {
  const auto functions = find_source_functions({file.text, file.name}, selection_of(flags.program).definitions, profile,
                                               include_beside(file.name, flags.program.allow_outside));
  if (functions.empty() && !file.parsed) return report(file.parsed.faults(), file.text);
  const std::vector<TextFault> faults = faults_of(functions);
  const bool refused_only = std::all_of(faults.begin(), faults.end(), is_refusal);
  Json rows = Json::array();
  std::string text = functions_text(functions);
  for (const TextFault& fault : faults) {
    rows.push_back(row_of(finding_of(fault)));
    if (refused_only) text += printable(fault.text()) + "\n";
  }
  const Json out{{"command", "validate"},
                 {"version", NINEBIT_VERSION},
                 {"profile", flags.common.profile},
                 {"functions", functions_json(functions)},
                 {"rows", std::move(rows)}};
  const int code = flags.common.json ? answer(out) : answer(text);
  if (code != kDone || faults.empty()) return code;
  return refused_only ? kDifference : report(faults, file.text);
}

int run(const ValidateFlags& flags) {
  const HardwareProfile& profile = profile_of(flags.common);
  const auto file = read_program_file(flags.program, profile);
  if (!file) return report(file.error());
  if (misuses_source_flags(flags.program, file->name, file->form)) return kWrongUsage;
  if (file->form == ProgramForm::source && flags.program.functions.empty())
    return list_functions(flags, *file, profile);
  if (!flags.common.quiet) say_notes(file->parsed.notes);
  std::vector<Finding> findings;
  for (const TextFault& fault : file->parsed.faults()) {
    if (is_refusal(fault)) findings.push_back(finding_of(fault));
  }
  // A text that cannot be parsed has no state to validate.
  if (findings.size() < file->parsed.faults().size()) return report(file->parsed.faults(), file->text);
  if (file->parsed) {
    for (const StateDiagnostic& d : validate(*file->parsed, profile)) findings.push_back({d});
  }

  int code = kDone;
  if (flags.common.json) {
    Json rows = Json::array();
    for (const Finding& finding : findings) rows.push_back(row_of(finding));
    const Json out{{"command", "validate"},
                   {"version", NINEBIT_VERSION},
                   {"profile", flags.common.profile},
                   {"rows", std::move(rows)}};
    code = answer(out);
  } else {
    std::string text;
    const std::string name = printable(file->name);
    for (const Finding& f : findings) {
      const std::string place = f.line > 0 ? fmt::format("{}:{}:{}", name, f.line, f.column) : name;
      text += fmt::format("{}: {}: {}\n", place, name_of(f.what.gl_error), printable(f.what.message));
    }
    if (findings.empty()) {
      text = fmt::format("{}: valid for {}\n", name, printable(profile.name));
    }
    code = answer(text);
  }
  if (code != kDone) return code;
  return findings.empty() ? kDone : kDifference;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("validate", "List the OpenGL errors that a program raises");
  verb->footer(
      "Exit codes: 0 the program is valid, 1 it raises an error, 3 it cannot be read as a program.\n"
      "Without --function, the functions of a source file are listed, and their faults below; values that are not\n"
      "known are not faults: give them by --define.\n"
      "Examples:\n"
      "  ninebit validate compare.gl\n"
      "  ninebit validate program.json --profile nv2a --json");
  auto flags = std::make_shared<ValidateFlags>();
  add_answer_flags(*verb, flags->common);
  add_profile_flag(*verb, flags->common);
  add_program_flags(*verb, flags->program);
  add_include_flag(*verb, flags->program.allow_outside);
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
