#include "combiner_tests/tools/program_support.h"

#include <sstream>

#include "ninebit/language/json.h"

namespace tools_test {

using namespace ninebit;  // NOLINT(google-build-using-namespace): states are spelled in its words

const char* const kArticleCalls = R"(// stage 0: four times the difference of two indices
glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_RGB);
glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_C_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_D_NV, GL_ZERO, GL_EXPAND_NORMAL_NV, GL_RGB);
glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_SCALE_BY_FOUR_NV, GL_NONE,
                   GL_FALSE, GL_FALSE, GL_FALSE);
glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE,
                   GL_FALSE, GL_FALSE);
// stage 1: four times its square
glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_RGB);
glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_B_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_RGB);
glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_SPARE1_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_SCALE_BY_FOUR_NV, GL_NONE,
                   GL_TRUE, GL_FALSE, GL_FALSE);
glCombinerOutputNV(GL_COMBINER1_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE,
                   GL_FALSE, GL_FALSE);
glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_SPARE1_NV, GL_UNSIGNED_IDENTITY_NV, GL_BLUE);
glEnable(GL_REGISTER_COMBINERS_NV);
)";

CombinerState article_state() {
  constexpr auto kIdentity = InputMapping::unsigned_identity;
  constexpr PortionOutput kNothing{.sum = Register::discard};
  CombinerState state;
  state.num_general_combiners = 2;
  Portion& difference = state.general[0].rgb;
  difference.b = {Register::zero, InputMapping::unsigned_invert, ComponentUsage::rgb};
  difference.c = {Register::texture0, kIdentity, ComponentUsage::rgb};
  difference.d = {Register::zero, InputMapping::expand_normal, ComponentUsage::rgb};
  difference.out.scale = Scale::by_four;
  Portion& square = state.general[1].rgb;
  square.a = square.b = {Register::spare0, InputMapping::signed_identity, ComponentUsage::rgb};
  square.out = {.ab = Register::spare1, .sum = Register::discard, .scale = Scale::by_four, .ab_dot_product = true};
  state.general[0].alpha.out = state.general[1].alpha.out = kNothing;
  FinalCombiner& f = state.final_combiner;
  f.a = f.b = f.c = f.d = CombinerInput{};
  f.g = {Register::spare1, kIdentity, ComponentUsage::blue};
  return state;
}

std::string write_program(const TempFolder& folder, const std::string& name, const CombinerState& state) {
  return write_bytes(folder / name, print_json_program(state));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace tools_test
