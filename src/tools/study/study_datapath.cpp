// `ninebit study datapath`: the error of each operation, and of whole programs, against exact arithmetic.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "ninebit/study/datapath_error.h"
#include "ninebit/study/exhaustive_sum.h"
#include "ninebit/study/program_error.h"
#include "src/study/part/joined_study.h"
#include "src/tools/common/program_file.h"
#include "src/tools/input/eval_table.h"
#include "src/tools/input/register_settings.h"
#include "src/tools/study/study.h"

namespace ninebit::tools {
namespace {

struct DatapathFlags {
  StudyFlags study;
  bool exhaustive_sum = false;
  std::string forms = "x1";
  std::string program, inputs, over;
  std::vector<std::string> defines;  // as ProgramFlags::defines
  std::vector<std::string> set;      // registers with one value
};

// The name of a form as --forms takes it. The form's own name, such as "-1/2, x2", has a comma and cannot be an item.
std::string form_flag(const OutputForm& form) {
  return std::string(form.bias == Bias::none ? "" : "biased-") + (form.scale == Scale::none      ? "x1"
                                                                  : form.scale == Scale::by_two  ? "x2"
                                                                  : form.scale == Scale::by_four ? "x4"
                                                                                                 : "x1/2");
}

std::vector<std::string> all_forms() {
  std::vector<std::string> names;
  names.reserve(kOutputForms.size());
  for (const OutputForm& form : kOutputForms) names.push_back(form_flag(form));
  return names;
}

Result<Program> read_program(const DatapathFlags& flags, const HardwareProfile& profile, StudyQuestion& question) {
  const auto file = read_program_file({.file = flags.program, .defines = flags.defines}, profile);
  if (!file) return file.error();
  question.options.emplace_back("--program", flags.program);
  for (const std::string& one : flags.defines) question.options.emplace_back("--define", one);
  if (Status added = add_content(question, flags.program); !added) return added.error();
  if (!file->parsed) {
    const std::size_t more = file->parsed.faults().size() - 1;
    const std::string first = file->parsed.faults().front().text();
    if (more == 0) return Diagnostic{.message = first};
    return Diagnostic{.message = fmt::format("{}; {} more, run `ninebit validate` to list them", first, more)};
  }
  auto program = compile(file->parsed->state, profile);
  if (program) return program;
  Diagnostic fault = program.error();
  if (fault.file.empty()) fault.file = file->name;
  return fault;
}

std::vector<RegisterComponent> components_of(const std::vector<EvalColumn>& columns) {
  std::vector<RegisterComponent> out;
  out.reserve(columns.size());
  for (const EvalColumn& column : columns) out.push_back({column.reg, column.component});
  return out;
}

// The components of --set with their codes.
Result<std::vector<std::pair<RegisterComponent, s9>>> read_fixed(const DatapathFlags& flags,
                                                                 const HardwareProfile& profile) {
  const auto settings = parse_register_settings(flags.set, profile);
  if (!settings) return settings.error();
  std::vector<std::pair<RegisterComponent, s9>> fixed;
  for (const EvalColumn& column : settings->set) {
    const RegisterComponent to{column.reg, column.component};
    const auto is_it = [&](const auto& constant) { return constant.first == column; };
    const auto constant = std::find_if(settings->constants.rbegin(), settings->constants.rend(), is_it);
    const auto component = static_cast<std::size_t>(column.component);
    const s9 code =
        constant != settings->constants.rend() ? constant->second : settings->registers[column.reg][component];
    fixed.emplace_back(to, code);
  }
  return fixed;
}

// The table of `ninebit eval`: a header of register components, and a row of codes for each fragment.
Result<ProgramInputs> read_inputs(const DatapathFlags& flags, const HardwareProfile& profile, StudyQuestion& question) {
  if (!flags.over.empty()) {
    question.options.emplace_back("--over", flags.over);
    auto columns = read_header({.text = flags.over, .number = 1}, "--over", profile);
    if (!columns) return columns.error();
    return ProgramInputs{.components = components_of(*columns)};
  }
  auto table = EvalTable::open(flags.inputs, profile);
  if (!table) return table.error();
  auto& [lines, columns] = *table;
  constexpr std::size_t kMostCodes = std::size_t{1} << 28;
  const EvalRows rows(columns, profile);
  const auto batch = std::make_unique<EvalBatch>();
  std::vector<s9> codes;
  while (true) {
    auto line = lines.next();
    if (!line) return line.error();
    if (!*line) break;
    rows.begin(*batch);
    if (Status added = rows.add(**line, lines.name(), *batch); !added) return added.error();
    for (const EvalColumn& column : columns) codes.push_back(batch->registers(column.reg, column.component)[0]);
    if (codes.size() > kMostCodes) {
      return csv_fault(lines.name(), (*line)->number, 1, fmt::format("the table has more than {} codes", kMostCodes));
    }
  }
  if (codes.empty()) return csv_fault(lines.name(), 2, 1, "the table has no rows");
  question.options.emplace_back("--inputs", flags.inputs);
  if (Status added = add_content(question, flags.inputs); !added) return added.error();
  return ProgramInputs{.components = components_of(columns), .codes = std::move(codes)};
}

// The profiles of --program and --exhaustive-sum: those that are given, else the default.
std::vector<HardwareProfile> program_profiles(const StudyFlags& flags) {
  return flags.profile->count() > 0 ? profiles_of(flags) : std::vector{profile_of(flags.common)};
}

// One study for each profile, joined if there are several. The question gets the options once.
Result<std::unique_ptr<Study>> make_program_study(const DatapathFlags& flags, StudyQuestion question) {
  std::vector<ProfileStudy> studies;
  StudyQuestion asked;
  for (const HardwareProfile& profile : program_profiles(flags.study)) {
    asked = question;
    auto program = read_program(flags, profile, asked);
    if (!program) return program.error();
    auto inputs = read_inputs(flags, profile, asked);
    if (!inputs) return inputs.error();
    for (const std::string& one : flags.set) asked.options.emplace_back("--set", one);
    auto fixed = read_fixed(flags, profile);
    if (!fixed) return fixed.error();
    inputs->fixed = std::move(*fixed);
    auto study = program_error_study(asked, profile, *program, std::move(*inputs));
    if (!study) return study.error();
    studies.push_back({std::string(profile.name), std::move(*study)});
  }
  if (studies.size() == 1) return std::move(studies[0].study);
  return joined_study(std::move(asked), std::move(studies));
}

Result<std::unique_ptr<Study>> make_datapath(const DatapathFlags& flags) {
  auto asked = question_of(flags.study, "datapath");
  if (!asked) return asked.error();
  StudyQuestion question = *std::move(asked);
  const bool has_default = !flags.program.empty() || flags.exhaustive_sum;
  if (has_default && flags.study.profile->count() == 0) question.profile = flags.study.common.profile;
  if (!flags.program.empty()) return make_program_study(flags, std::move(question));
  if (flags.exhaustive_sum) {
    const std::vector<std::string> wanted = items_of(flags.forms);
    std::vector<OutputForm> forms;  // each once
    std::vector<std::string> names;
    for (const OutputForm& form : kOutputForms) {
      if (std::find(wanted.begin(), wanted.end(), form_flag(form)) == wanted.end()) continue;
      forms.push_back(form);
      names.push_back(form_flag(form));
    }
    question.options.emplace_back("--exhaustive-sum", "");
    question.options.emplace_back("--forms", fmt::format("{}", fmt::join(names, ",")));
    return exhaustive_sum_study(std::move(question), profile_of(flags.study.common), forms);
  }
  return datapath_study(std::move(question), profiles_of(flags.study));
}

// Reads the components of --set and --over for these profiles; an unknown one is wrong usage.
void check_over(const DatapathFlags& flags) {
  for (const HardwareProfile& profile : program_profiles(flags.study)) {
    const auto fixed = read_fixed(flags, profile);
    if (!fixed) throw CLI::ValidationError(fixed.error().message);
    if (flags.over.empty()) continue;
    const auto columns = read_header({.text = flags.over, .number = 1}, "--over", profile);
    if (!columns) throw CLI::ValidationError("--over " + flags.over + ": " + columns.error().message);
    for (const RegisterComponent& one : components_of(*columns)) {
      const auto is_it = [&](const auto& other) { return other.first == one; };
      if (std::none_of(fixed->begin(), fixed->end(), is_it)) continue;
      throw CLI::ValidationError(fmt::format("--set and --over both name {}; expected one of them", one.name()));
    }
  }
}

// A profile that computes in real numbers has no nine-bit errors to measure.
void check_profiles(const DatapathFlags& flags) {
  if (flags.exhaustive_sum && flags.study.profiles.size() > 1) {
    throw CLI::ValidationError("--exhaustive-sum measures one profile; expected one name after --profile");
  }
  if (flags.study.profile->count() == 0) return;
  for (const HardwareProfile& profile : profiles_of(flags.study)) {
    if (profile.arithmetic == Arithmetic::integer) continue;
    throw CLI::ValidationError(
        fmt::format("--profile {}: it computes in real numbers and has no datapath to measure; "
                    "expected a profile with integer arithmetic",
                    profile.name));
  }
}

// Refuses standard input: the files are read again when the parts are merged.
std::string check_file(const std::string& text) {
  if (!text.empty() && text != "-") return {};
  return fmt::format("'{}' is not a file name; a study reads its files more than once", text);
}

}  // namespace

void add_study_datapath(CLI::App& verbs, StudyRequest& request) {
  CLI::App* verb = verbs.add_subcommand("datapath", "Measure the error of every datapath operation, over all inputs");
  verb->footer(
      "The error is the difference from exact arithmetic. --program measures a whole program and each of its stages;\n"
      "--exhaustive-sum measures AB + CD case by case.\n"
      "Examples:\n"
      "  ninebit study datapath --profile geforce2\n"
      "  ninebit study datapath --program docs/programs/index_compare.gl --over primary.r,tex0.r\n"
      "  ninebit study datapath --program docs/programs/index_compare.gl --over tex0.r --set primary=102,0,0,0 -o out\n"
      "  ninebit study datapath --program compare.gl --over primary.r,tex0.r --profile geforce2,nv2a -o out\n"
      "  ninebit study datapath --program compare.gl --inputs codes.csv --json\n"
      "  ninebit study datapath --exhaustive-sum --forms x1,x4");
  auto flags = std::make_shared<DatapathFlags>();
  add_study_flags(*verb, flags->study);
  flags->study.profile->description(
      "Hardware profile to emulate: a name from `ninebit profiles`, or a .json file; several names, separated by "
      "commas, "
      "share a report (default: all with integer arithmetic; of --program and --exhaustive-sum geforce2)");
  CLI::Option* program = verb->add_option("--program", flags->program, "Measure this program and each of its stages")
                             ->type_name("FILE")
                             ->check(CLI::Validator(check_file, ""));
  add_define_flag(*verb, flags->defines);
  verb->get_option("--define")->needs(program);
  CLI::Option* inputs = verb->add_option("--inputs", flags->inputs,
                                         "Inputs of the program: a table of register codes, as for `ninebit eval`")
                            ->type_name("FILE.csv")
                            ->check(CLI::Validator(check_file, ""))
                            ->needs(program);
  CLI::Option* over =
      verb->add_option("--over", flags->over,
                       "Inputs of the program: all values of these components, such as tex0.r,primary.r")
          ->type_name("LIST")
          ->needs(program)
          ->excludes(inputs);
  verb->add_option("--set", flags->set,
                   "Give other components of the inputs one value, as in `ninebit trace`; repeatable")
      ->type_name("REGISTER=R,G,B,A")
      ->allow_extra_args(false)
      ->needs(program);
  CLI::Option* sum = verb->add_flag("--exhaustive-sum", flags->exhaustive_sum, "Measure all 511^4 cases of AB + CD")
                         ->excludes(program);
  verb->add_option("--forms", flags->forms, "Scales and biases of the sum: x1,x2,x4,x1/2,biased-x1,biased-x2")
      ->type_name("LIST")
      ->capture_default_str()
      ->check(list_of(all_forms()))
      ->needs(sum);
  verb->callback([flags, program, inputs, over, &request] {
    if (program->count() > 0 && inputs->count() + over->count() == 0) {
      throw CLI::ValidationError("--program requires --inputs FILE.csv or --over LIST");
    }
    check_profiles(*flags);
    check_over(*flags);
    request = {.make = [flags] { return make_datapath(*flags); }, .flags = &flags->study};
  });
}

}  // namespace ninebit::tools
