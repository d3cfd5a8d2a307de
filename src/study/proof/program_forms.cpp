#include "src/study/proof/program_forms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace ninebit::proof {
namespace {

struct OperatorText {
  std::string_view before, after;
  int cost;
};

constexpr std::array<OperatorText, 8> kMappings{{{"", "", 0},
                                                 {"-", "", 1},
                                                 {"unsigned(", ")", 1},
                                                 {"unsigned_invert(", ")", 1},
                                                 {"expand(", ")", 2},
                                                 {"-expand(", ")", 2},
                                                 {"half_bias(", ")", 2},
                                                 {"-half_bias(", ")", 2}}};

constexpr std::array<OperatorText, 6> kScales{{{"", "", 0},
                                               {" scale_by_two();", "", 1},
                                               {" scale_by_four();", "", 1},
                                               {" scale_by_one_half();", "", 1},
                                               {" bias_by_negative_one_half();", "", 1},
                                               {" bias_by_negative_one_half_scale_by_two();", "", 2}}};

constexpr int kFactorCost = 2;

std::string mapped(const OperatorText& mapping, std::string_view what) {
  return fmt::format("{}{}{}", mapping.before, what, mapping.after);
}

std::vector<ProgramForm> stages_of_one(std::string_view x) {
  std::vector<ProgramForm> stages;
  for (const OperatorText& mapping : kMappings) {
    for (const OperatorText& scale : kScales) {
      stages.push_back({fmt::format("{{ rgb {{ spare0 = {};{} }} }}\n", mapped(mapping, x), scale.before),
                        mapping.cost + scale.cost});
    }
  }
  return stages;
}

std::vector<ProgramForm> stages_of_product(std::string_view x, std::string_view y) {
  std::vector<ProgramForm> stages;
  for (const OperatorText& first : kMappings) {
    for (const OperatorText& second : kMappings) {
      for (const OperatorText& scale : kScales) {
        stages.push_back(
            {fmt::format("{{ rgb {{ spare0 = {} * {};{} }} }}\n", mapped(first, x), mapped(second, y), scale.before),
             first.cost + second.cost + scale.cost + kFactorCost});
      }
    }
  }
  return stages;
}

// Whole programs of these stages one after another.
void add_programs(std::vector<ProgramForm>& programs, const std::vector<ProgramForm>& first,
                  const std::vector<ProgramForm>& second) {
  for (const ProgramForm& a : first) {
    for (const ProgramForm& b : second) {
      programs.push_back(
          {fmt::format("!!RC1.0\n{}{}out.rgb = spare0;\nout.a = zero;\n", a.text, b.text), a.cost + b.cost});
    }
  }
}

void sort_by_cost(std::vector<ProgramForm>& programs) {
  std::stable_sort(programs.begin(), programs.end(),
                   [](const ProgramForm& a, const ProgramForm& b) { return a.cost < b.cost; });
}

}  // namespace

std::vector<ProgramForm> programs_without_stages() {
  const auto shows = [](std::string_view what) { return fmt::format("!!RC1.0\nout.rgb = {};\nout.a = zero;\n", what); };
  return {{shows("tex0"), 0},
          {shows("col1.a"), 0, -1, true},
          {shows("spare0.a"), 0, 0, true},
          {shows("tex0.a"), 0, 0, true},
          {shows("tex1.a"), 0, 1, true},
          {shows("fog.a"), 0, -1, true, true},
          {shows("tex0 * tex1"), 1},
          {"!!RC1.0\nfinal_product = tex0 * tex1;\nout.rgb = final_product;\nout.a = zero;\n", 2}};
}

std::vector<ProgramForm> programs_of_one_stage() {
  std::vector<ProgramForm> programs;
  const std::vector<ProgramForm> nothing{{"", 0}};
  add_programs(programs, stages_of_one("tex0"), nothing);
  add_programs(programs, stages_of_product("tex0", "tex1"), nothing);
  sort_by_cost(programs);
  return programs;
}

std::vector<ProgramForm> programs_of_two_stages() {
  std::vector<ProgramForm> programs;
  add_programs(programs, stages_of_one("tex0"), stages_of_one("spare0"));
  add_programs(programs, stages_of_product("tex0", "tex1"), stages_of_one("spare0"));
  add_programs(programs, stages_of_one("tex0"), stages_of_product("spare0", "col0"));
  sort_by_cost(programs);
  return programs;
}

}  // namespace ninebit::proof
