#include "src/tools/common/explanation.h"

#include <fmt/format.h>

#include "ninebit/language/xbox_pixel_shader.h"

namespace ninebit::tools {
namespace {

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

}  // namespace

Json explanation_json(const Explanation& e, const TextProgram& program, const std::string& profile) {
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
  return {{"command", "explain"},
          {"version", NINEBIT_VERSION},
          {"profile", profile},
          {"num_general_combiners", e.num_general_combiners},
          {"rows", std::move(rows)},
          {"dead", std::move(dead)},
          {"constants", e.constants},
          {"notes", e.notes},
          {"legend", e.legend},
          {"other_words", other_words_json(program.other_words)},
          {"texture_shader", explain_stages(program.texture_shader)}};
}

std::string explanation_text(const Explanation& e, const TextProgram& program) {
  const std::string stages = print_stages(program.texture_shader);
  return stages + (stages.empty() ? "" : "\n") + print_explanation(e) + other_words_text(program.other_words);
}

}  // namespace ninebit::tools
