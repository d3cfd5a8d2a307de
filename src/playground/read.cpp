// Answers "read": a program's faults, and its equations.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/source_code.h"
#include "src/playground/texts.h"
#include "src/system/inside_folder.h"

namespace ninebit::playground {
namespace {

// The length of the word at a place, in UTF-16 units; at least 1.
int marked_length(std::string_view text, int line, int column) {
  const std::string_view whole = line_of(text, line);
  const auto at = static_cast<std::size_t>(std::max(column - 1, 0));
  std::size_t end = std::min(at, whole.size());
  const auto is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  while (end < whole.size() && is_part(whole[end])) ++end;
  return end > at ? static_cast<int>(end - at) : 1;
}

Json marked(const TextFault& fault, const SourceText& source) {
  const std::string_view text = source.text;
  // A fault in an included file has no place here.
  if (fault.file != source.file) return Json{{"message", fault.text()}, {"gl_error", Json()}};
  // A fault about the whole program stands at its first line.
  const int line = std::max(fault.line, 1), column = std::max(fault.column, 1);
  Json row{{"line", line}, {"column", utf16_column(text, line, column)}};
  row["length"] = fault.line > 0 ? marked_length(text, line, column) : std::max(utf16_length(line_of(text, 1)), 1);
  row["message"] = fault.message;
  const bool refused = fault.gl_error != GlError::no_error;
  row["gl_error"] = refused ? Json(name_of(fault.gl_error)) : Json();
  return row;
}

Json marked_all(const std::vector<TextFault>& faults, const SourceText& source) {
  Json rows = Json::array();
  for (const TextFault& fault : faults) rows.push_back(marked(fault, source));
  return rows;
}

// How many programs a fault says that there are to pick from by a number; 0: it does not.
int counted_programs(const std::vector<TextFault>& faults) {
  for (const TextFault& fault : faults) {
    int count = 0;
    constexpr std::string_view kBefore = "draws with ";
    const std::size_t at = fault.message.find(kBefore);
    if (at == std::string::npos || fault.message.find("pick one with #1") == std::string::npos) continue;
    std::from_chars(fault.message.data() + at + kBefore.size(), fault.message.data() + fault.message.size(), count);
    return count;
  }
  return 0;
}

// The names that conditions of a shader depend on and nothing defines, from its faults.
Json undefined_names(const std::vector<TextFault>& faults) {
  Json names = Json::array();
  constexpr std::string_view kBefore = "give it as in --define '";
  for (const TextFault& fault : faults) {
    const std::size_t at = fault.message.find(kBefore);
    if (at == std::string::npos) continue;
    const std::string rest = fault.message.substr(at + kBefore.size());
    names.push_back(rest.substr(0, rest.find('=')));
  }
  return names;
}

// What there is to choose: a source's functions, the programs of the chosen one, and values that are not known.
void add_choices(const SourceText& source, const HardwareProfile& profile, const FileTexts& files,
                 const SourceSelection& choice, const std::vector<TextFault>& faults, Json& out) {
  const ProgramForm form = form_to_read(source.text, choice);
  if (form == ProgramForm::ps) out["needs"] = undefined_names(faults);
  if (form == ProgramForm::log) {
    const auto log = parse_register_log(source, {.fallback = chip_of(profile)});
    out["programs"] = log ? log->setups.size() : 0;
  }
  if (form != ProgramForm::source) return;
  Json functions = Json::array();
  for (const SourceFunction& one :
       find_source_functions(source, choice.definitions, profile, include_from(files, source.file))) {
    functions.push_back({{"name", one.name}, {"line", one.line}, {"helper", one.is_helper}, {"needs", one.needs}});
  }
  out["functions"] = std::move(functions);
  SourceSelection any = choice;
  any.program = 0;
  const int programs = choice.program == 0 ? counted_programs(faults)
                                           : counted_programs(valid_program(source, profile, files, any).faults());
  out["programs"] = std::max(programs, 1);
}

Json constants_of(const CombinerState& state) {
  Json constants{{"const0", state.constant0}, {"const1", state.constant1}};
  if (!state.per_stage_constants) return constants;
  Json stages = Json::array();
  for (int i = 0; i < state.num_general_combiners; ++i) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    stages.push_back({{"const0", stage.constant0}, {"const1", stage.constant1}});
  }
  constants["stages"] = std::move(stages);
  return constants;
}

}  // namespace

NumberedName numbered_name(std::string_view name, const FileTexts& texts) {
  const std::string_view file = posix::without_setup(name);
  std::size_t number = 0;
  if (file.size() == name.size() || texts.contains(name)) return {name};
  std::from_chars(name.data() + file.size() + 1, name.data() + name.size(), number);
  return {file, number};
}

ProgramForm form_to_read(std::string_view text, const SourceSelection& choice) {
  const ProgramForm form = form_of(text);
  const bool asks_for_source = !choice.functions.empty() || !choice.definitions.empty();
  return form == ProgramForm::gl && asks_for_source ? ProgramForm::source : form;
}

SourceInclude include_from(const FileTexts& others, std::string_view beside) {
  const std::string folder(beside.substr(0, beside.rfind('/') + 1));
  return [&others, folder](std::string_view name) -> std::optional<std::string> {
    std::string path(name);
    std::replace(path.begin(), path.end(), '\\', '/');
    path = std::filesystem::path(path).lexically_normal().generic_string();
    if (path.starts_with("..") || path.starts_with('/')) return std::nullopt;
    const auto found = others.find(folder + path);
    return found == others.end() ? std::nullopt : std::optional(found->second);
  };
}

Parsed<TextProgram> valid_program(const SourceText& source, const HardwareProfile& profile, const FileTexts& others,
                                  SourceSelection choice) {
  const ProgramForm form = form_to_read(source.text, choice);
  const auto fault = [&](std::string message) {
    return std::vector{TextFault{.file = std::string(source.file), .message = std::move(message)}};
  };
  if (choice.program != 0 && form != ProgramForm::source && form != ProgramForm::log) {
    return fault("#" + std::to_string(choice.program) +
                 " picks a set-up of a log, or a program of a function of a source; this is neither");
  }
  const std::string kind(form_row(form).kind);
  if (!choice.functions.empty() && form != ProgramForm::source) {
    return fault("the function " + json::in_quotes(choice.functions[0]) + " is chosen, and this is " + kind +
                 "; expected a source file, or no function");
  }
  if (!choice.definitions.empty() && !form_row(form).takes_definitions) {
    return fault("a value is given for " + json::in_quotes(choice.definitions[0].name) + ", and this is " + kind +
                 "; expected a source file or a pixel shader, or no value");
  }
  choice.include = include_from(others, source.file);
  auto parsed = parse_program(source, form, profile, {.setup = choice.program, .source = std::move(choice)});
  if (!parsed) return parsed;
  std::vector<TextFault> faults;
  for (const StateDiagnostic& found : validate(*parsed, profile)) {
    faults.push_back(fault(found.message)[0]);
    faults.back().gl_error = found.gl_error;
  }
  if (faults.empty()) return parsed;
  return {std::move(faults), std::move(parsed.notes)};
}

Reply read_text(Request& request) {
  request.allow({"text", "profile", "name", "files", "choice"});
  const std::string text = request.word("text"), name = request.word_or("name", "");
  const ChosenProfile chosen = request.profile("profile");
  const FileTexts files = request.texts("files");
  const SourceSelection choice = request.choice();
  if (request.failed()) return request.refused();
  const HardwareProfile& profile = chosen.profile();
  const SourceText source{text, name};
  const auto parsed = valid_program(source, profile, files, choice);
  Json out{{"form", form_row(form_to_read(text, choice)).name},
           {"valid", static_cast<bool>(parsed)},
           {"faults", marked_all(parsed.faults(), source)},
           {"notes", marked_all(parsed.notes, source)}};
  add_choices(source, profile, files, choice, parsed.faults(), out);
  if (!parsed) return out;
  const CombinerState& state = parsed->state;
  const Program program = normalize(state, profile);
  const std::string stages = print_stages(parsed->texture_shader);
  out["explanation"] = stages + (stages.empty() ? "" : "\n") + print_explanation(explain(program, profile));
  Json textures = Json::array();
  for (int unit = 0; unit < 4; ++unit) {
    if (detail::program_reads(program, texture_register(unit))) textures.push_back(unit);
  }
  out["textures"] = std::move(textures);
  out["general_combiners"] = state.num_general_combiners;
  out["constants"] = constants_of(state);
  return out;
}

}  // namespace ninebit::playground
