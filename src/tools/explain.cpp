// `ninebit explain`: what a program computes, as equations.
#include "ninebit/language/explain.h"

#include <memory>

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

Json json_of(const Explanation& e, const CommonFlags& flags) {
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
          {"legend", e.legend}};
}

int run(const ExplainFlags& flags) {
  const HardwareProfile& profile = profile_of(flags.common);
  int exit_code = kDone;
  const auto state = load_program(flags.program, profile, exit_code);
  if (!state) return exit_code;
  const Explanation explanation = explain(normalize(*state, profile), profile);
  return flags.common.json ? answer(json_of(explanation, flags.common)) : answer(print_explanation(explanation));
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
