// Answers "read": a program's faults, and its equations.
#include <algorithm>
#include <cctype>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/explain.h"
#include "src/playground/texts.h"

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

Json marked(const TextFault& fault, std::string_view text) {
  // A fault about the whole program stands at its first line.
  const int line = std::max(fault.line, 1), column = std::max(fault.column, 1);
  Json row{{"line", line}, {"column", utf16_column(text, line, column)}};
  row["length"] = fault.line > 0 ? marked_length(text, line, column) : std::max(utf16_length(line_of(text, 1)), 1);
  row["message"] = fault.message;
  const bool refused = fault.gl_error != GlError::no_error;
  row["gl_error"] = refused ? Json(name_of(fault.gl_error)) : Json();
  return row;
}

Json marked_all(const std::vector<TextFault>& faults, std::string_view text) {
  Json rows = Json::array();
  for (const TextFault& fault : faults) rows.push_back(marked(fault, text));
  return rows;
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

bool reads_register(const Program& program, Register reg) {
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    if (detail::reads(stage.rgb, reg) || detail::reads(stage.alpha, reg)) return true;
  }
  const FinalCombiner& f = program.final_combiner;
  return detail::reads_directly(f, reg) || f.e.reg == reg || f.f.reg == reg;
}

Parsed<TextProgram> valid_program(std::string_view text, std::string_view name, const HardwareProfile& profile) {
  auto parsed = parse_program({text, name}, form_of(text), profile);
  if (!parsed) return parsed;
  std::vector<TextFault> faults;
  for (const StateDiagnostic& found : validate(*parsed, profile)) {
    TextFault fault;
    fault.file = std::string(name);
    fault.message = found.message;
    fault.gl_error = found.gl_error;
    faults.push_back(std::move(fault));
  }
  if (faults.empty()) return parsed;
  return {std::move(faults), std::move(parsed.notes)};
}

Reply read_text(Request& request) {
  request.allow({"text", "profile"});
  const std::string text = request.word("text");
  const ChosenProfile chosen = request.profile("profile");
  if (request.failed()) return request.refused();
  const HardwareProfile& profile = chosen.profile();
  const auto parsed = valid_program(text, "", profile);
  Json out{{"form", form_row(form_of(text)).name},
           {"valid", static_cast<bool>(parsed)},
           {"faults", marked_all(parsed.faults(), text)},
           {"notes", marked_all(parsed.notes, text)}};
  if (!parsed) return out;
  const CombinerState& state = parsed->state;
  const Program program = normalize(state, profile);
  const std::string stages = print_stages(parsed->texture_shader);
  out["explanation"] = stages + (stages.empty() ? "" : "\n") + print_explanation(explain(program, profile));
  Json textures = Json::array();
  for (int unit = 0; unit < 4; ++unit) {
    if (reads_register(program, texture_register(unit))) textures.push_back(unit);
  }
  out["textures"] = std::move(textures);
  out["general_combiners"] = state.num_general_combiners;
  out["constants"] = constants_of(state);
  return out;
}

}  // namespace ninebit::playground
