// `ninebit study datapath`: how far each operation is from exact arithmetic, and whole programs.
#include <fmt/format.h>

#include <memory>

#include "ninebit/study/datapath_error.h"
#include "ninebit/study/exhaustive_sum.h"
#include "ninebit/study/program_error.h"
#include "src/tools/eval_table.h"
#include "src/tools/program_file.h"
#include "src/tools/scene_flags.h"
#include "src/tools/sha256.h"
#include "src/tools/study.h"

namespace ninebit::tools {
namespace {

struct DatapathFlags {
  StudyFlags study;
  bool exhaustive_sum = false;
  std::string forms = "x1";
  std::string program, inputs, over;
};

// A form's name without what a list in a command line cannot have: "-1/2,x2" of "-1/2, x2" is no item of one.
std::string form_flag(const OutputForm& form) {
  return std::string(form.bias == Bias::none ? "" : "biased-") + (form.scale == Scale::none      ? "x1"
                                                                  : form.scale == Scale::by_two  ? "x2"
                                                                  : form.scale == Scale::by_four ? "x4"
                                                                                                 : "x1/2");
}

std::vector<std::string> all_forms() {
  std::vector<std::string> names;
  for (const OutputForm& form : kOutputForms) names.push_back(form_flag(form));
  return names;
}

void add_text(Sha256& hash, std::string_view text) {
  hash.add({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

std::string hash_of(std::string_view text) {
  Sha256 hash;
  add_text(hash, text);
  return hash.finish();
}

Result<Program> read_program(const DatapathFlags& flags, const HardwareProfile& profile, StudyQuestion& question) {
  const auto file = read_program_file({.file = flags.program, .from = "", .chip = ""}, profile);
  if (!file) return file.error();
  question.options.emplace_back("--program", flags.program);
  question.options.emplace_back("sha256 of " + file->name, hash_of(file->text));
  if (!file->parsed) {
    std::string faults;
    for (const TextFault& fault : file->parsed.faults) {
      if (!faults.empty()) faults += "\nninebit: error: ";
      faults += fault.text();
    }
    return Diagnostic{.message = faults};
  }
  auto program = compile(*file->parsed.value, profile);
  if (program) return program;
  Diagnostic fault = program.error();
  if (fault.file.empty()) fault.file = file->name;
  return fault;
}

std::vector<RegisterComponent> components_of(const std::vector<EvalColumn>& columns) {
  std::vector<RegisterComponent> out;
  for (const EvalColumn& column : columns) out.push_back({column.reg, column.component});
  return out;
}

// The table of `ninebit eval`: a header of register components, and a row of codes for each fragment.
Result<ProgramInputs> read_inputs(const DatapathFlags& flags, const HardwareProfile& profile, StudyQuestion& question) {
  if (!flags.over.empty()) {
    question.options.emplace_back("--over", flags.over);
    auto columns = read_header({.text = flags.over, .number = 1}, "--over", profile);
    if (!columns) return columns.error();
    return ProgramInputs{.components = components_of(*columns)};
  }
  auto input = InputFile::open(flags.inputs);
  if (!input) return input.error();
  CsvLines lines(std::move(*input));
  Sha256 hash;
  const auto next = [&]() -> Result<std::optional<CsvLine>> {
    auto line = lines.next();
    if (line && *line) {
      add_text(hash, (*line)->text);
      add_text(hash, "\n");
    }
    return line;
  };
  auto header = next();
  if (!header) return header.error();
  if (!*header) return csv_fault(lines.name(), 1, 1, "the table is empty; expected a header such as primary.r,tex0.a");
  auto columns = read_header(**header, lines.name(), profile);
  if (!columns) return columns.error();
  constexpr std::size_t kMostCodes = std::size_t{1} << 28;
  const EvalRows rows(*columns, profile);
  const auto batch = std::make_unique<EvalBatch>();
  std::vector<s9> codes;
  while (true) {
    auto line = next();
    if (!line) return line.error();
    if (!*line) break;
    rows.begin(*batch);
    if (Status added = rows.add(**line, lines.name(), *batch); !added) return added.error();
    for (const EvalColumn& column : *columns) codes.push_back(batch->registers(column.reg, column.component)[0]);
    if (codes.size() > kMostCodes) {
      return csv_fault(lines.name(), (*line)->number, 1, fmt::format("more than {} codes are too many", kMostCodes));
    }
  }
  if (codes.empty()) return csv_fault(lines.name(), 2, 1, "the table has no rows");
  question.options.emplace_back("--inputs", flags.inputs);
  question.options.emplace_back("sha256 of the lines of " + lines.name(), hash.finish());
  return ProgramInputs{.components = components_of(*columns), .codes = std::move(codes)};
}

// The study that the flags ask for.
Result<std::unique_ptr<Study>> make_datapath(const DatapathFlags& flags) {
  StudyQuestion question{.study = "datapath", .profile = flags.study.common.profile};
  const HardwareProfile& profile = profile_of(flags.study.common);
  if (!flags.program.empty()) {
    auto program = read_program(flags, profile, question);
    if (!program) return program.error();
    auto inputs = read_inputs(flags, profile, question);
    if (!inputs) return inputs.error();
    return program_error_study(std::move(question), profile, *program, std::move(*inputs));
  }
  if (flags.exhaustive_sum) {
    std::vector<OutputForm> forms;
    for (const std::string& name : items_of(flags.forms)) {
      for (const OutputForm& form : kOutputForms) {
        if (form_flag(form) == name) forms.push_back(form);
      }
    }
    question.options.emplace_back("--exhaustive-sum", "");
    question.options.emplace_back("--forms", flags.forms);
    return exhaustive_sum_study(std::move(question), profile, forms);
  }
  const std::vector<HardwareProfile> profiles = profiles_of(flags.study);
  if (flags.study.profile->count() == 0) question.profile = "all";
  return datapath_study(std::move(question), profiles);
}

Json json_of(const StudyRow& row) {
  Json out = Json::object();
  for (const auto& [name, value] : row.fields) {
    out[name] = std::visit(
        [](const auto& v) {
          if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) {
            return Json(nullptr);
          } else {
            return Json(v);
          }
        },
        value);
  }
  return out;
}

int run_all(const Study& study, const StudyFlags& flags) {
  const ThreadLimit limit(flags.common.threads);
  std::vector<StudyRow> rows;
  {
    ProgressLine line(flags.common.quiet);
    for (std::size_t unit = 0; unit < study.units(); ++unit) {
      if (!line.step(study.unit_name(unit), static_cast<double>(unit) / static_cast<double>(study.units()))) {
        return report({.message = "interrupted", .fault = Fault::cancelled});
      }
      auto more = study.run(unit, [] { return !ProgressLine::stopped(); });
      if (!more) return report(more.error());
      rows.insert(rows.end(), more->begin(), more->end());
    }
  }
  if (flags.common.json) {
    Json out{{"command", "study datapath"}, {"version", NINEBIT_VERSION}, {"profile", study.question().profile}};
    out["rows"] = Json::array();
    for (const StudyRow& row : rows) out[row.table].push_back(json_of(row));
    return answer(out.dump(2) + "\n");
  }
  const auto told = study.report(rows, study.units());
  if (!told) return report(told.error());
  std::string text;
  for (const std::string& sentence : told->answers) text += sentence + "\n";
  return answer(text);
}

int datapath(const DatapathFlags& flags) {
  const auto study = make_datapath(flags);
  return study ? run_all(**study, flags.study) : report(study.error());
}

}  // namespace

void add_study_datapath(CLI::App& study, int& exit_code) {
  CLI::App* verb = study.add_subcommand("datapath", "Errors of every operation of the datapath, over all inputs");
  verb->footer(
      "With --program the error of a whole program and of each of its stages, with --exhaustive-sum AB + CD case by\n"
      "case; both for one profile, geforce2 where none is given.\n"
      "Examples:\n"
      "  ninebit study datapath --profile geforce2\n"
      "  ninebit study datapath --program docs/programs/index_compare.gl --over primary.r,tex0.r\n"
      "  ninebit study datapath --program compare.gl --inputs codes.csv --json\n"
      "  ninebit study datapath --exhaustive-sum --forms x1,x4");
  auto flags = std::make_shared<DatapathFlags>();
  add_study_flags(*verb, flags->study);
  CLI::Option* program =
      verb->add_option("--program", flags->program, "A program to measure as a whole")->type_name("FILE");
  CLI::Option* inputs =
      verb->add_option("--inputs", flags->inputs, "Its inputs: a table of register codes as `ninebit eval` takes it")
          ->type_name("FILE.csv")
          ->needs(program);
  CLI::Option* over =
      verb->add_option("--over", flags->over, "Its inputs: all values of these components, such as tex0.r,primary.r")
          ->type_name("LIST")
          ->needs(program)
          ->excludes(inputs);
  CLI::Option* sum = verb->add_flag("--exhaustive-sum", flags->exhaustive_sum, "Evaluate all 511^4 cases of AB + CD")
                         ->excludes(program);
  verb->add_option("--forms", flags->forms, "Outputs of the sum: x1,x2,x4,x1/2,biased-x1,biased-x2")
      ->type_name("LIST")
      ->capture_default_str()
      ->check(list_of(all_forms()))
      ->needs(sum);
  verb->callback([flags, program, inputs, over, &exit_code] {
    if (program->count() > 0 && inputs->count() + over->count() == 0) {
      throw CLI::ValidationError("--program needs --inputs FILE.csv or --over LIST");
    }
    exit_code = datapath(*flags);
  });
}

}  // namespace ninebit::tools
