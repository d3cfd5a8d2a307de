// `ninebit explain`: what a program computes, as equations.
#include "ninebit/language/explain.h"

#include <fmt/format.h>

#include <memory>

#include "ninebit/language/xbox_pixel_shader.h"
#include "src/tools/common/program_file.h"

namespace ninebit::tools {
namespace {

struct ExplainFlags {
  CommonFlags common;
  ProgramFlags program;
};

std::string_view portion_name(PortionName portion) {
  return portion == PortionName::rgb ? "rgb" : "alpha";
}

// The words beside the combiners', and what they say.
Json other_words_json(const std::vector<RegisterWord>& other_words) {
  Json rows = Json::array();
  for (const RegisterWord& word : other_words) {
    rows.push_back(
        {{"name", word.name}, {"value", fmt::format("{:#010x}", word.value)}, {"says", explain_other_word(word)}});
  }
  return rows;
}

std::string other_words_text(const std::vector<RegisterWord>& other_words) {
  if (other_words.empty()) return "";
  std::string text = "\nwords that combiners do not read\n";
  for (const RegisterWord& word : other_words) {
    text += fmt::format("  {} = {:#010x}\n", word.name, word.value);
    for (const std::string& phrase : explain_other_word(word)) text += fmt::format("    {}\n", phrase);
  }
  return text;
}

Json json_of(const Explanation& e, const std::vector<RegisterWord>& other_words, const CommonFlags& flags) {
  Json rows = Json::array();
  for (const Equation& equation : e.equations) {
    rows.push_back({{"stage", equation.stage ? Json(*equation.stage) : Json("final")},
                    {"portion", portion_name(equation.portion)},
                    {"output", equation.output},
                    {"target", equation.target},
                    {"expression", equation.expression},
                    {"used", equation.used},
                    {"clamps", equation.clamps}});
  }
  Json dead = Json::array();
  for (const DeadPortion& portion : e.dead) {
    dead.push_back({{"stage", portion.stage}, {"portion", portion_name(portion.portion)}, {"reason", portion.reason}});
  }
  return {{"command", "explain"},     {"version", NINEBIT_VERSION},
          {"profile", flags.profile}, {"num_general_combiners", e.num_general_combiners},
          {"rows", std::move(rows)},  {"dead", std::move(dead)},
          {"constants", e.constants}, {"notes", e.notes},
          {"legend", e.legend},       {"other_words", other_words_json(other_words)}};
}

int run(const ExplainFlags& flags) {
  const HardwareProfile& profile = profile_of(flags.common);
  int exit_code = kDone;
  const auto program = load_text_program(flags.program, profile, flags.common.quiet, exit_code);
  if (!program) return exit_code;
  const Explanation explanation = explain(normalize(program->state, profile), profile);
  if (flags.common.json) return answer(json_of(explanation, program->other_words, flags.common));
  return answer(print_explanation(explanation) + other_words_text(program->other_words));
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("explain", "Print what a program computes, as equations, stage by stage");
  verb->footer(
      "Examples:\n"
      "  ninebit explain compare.gl\n"
      "  ninebit explain program.json --profile nv2a --json");
  auto flags = std::make_shared<ExplainFlags>();
  add_common_flags(*verb, flags->common);
  add_program_flags(*verb, flags->program);
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
