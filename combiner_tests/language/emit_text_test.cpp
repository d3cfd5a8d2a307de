// The form of the emitted text, and the programs that are refused.
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "combiner_tests/language/emit_cases.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/glsl.h"

namespace ninebit::test {
namespace {

std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

Program compiled(const CombinerState& state, const HardwareProfile& profile = profiles::geforce2) {
  return compile(state, profile).value();
}

TEST(EmitText, HoldsNoFloatAndDividesByConstantsOnly) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  std::vector<EmitCase> cases = random_cases(0x74657874U, cases_here(200));
  for (const EmitCase& c : row_cases()) cases.push_back(c);
  const std::regex real("(^|[^A-Za-z0-9_])[0-9]+\\.|float"), division("/(?!\\s+[0-9]+\\b)");
  for (const EmitCase& c : cases) {
    for (const std::string& text : {emit_glsl(c.program, GlslVersion::glsl_330).value(), emit_c(c.program).value()}) {
      const std::string code = without_comments(text);
      ASSERT_FALSE(std::regex_search(code, real)) << c.name << '\n' << text;
      ASSERT_FALSE(std::regex_search(code, division)) << c.name << '\n' << text;
      for (const char byte : text) ASSERT_TRUE(byte == '\n' || (byte >= ' ' && byte <= '~')) << text;
    }
  }
}

TEST(EmitText, VersionsOfGlslDifferInTheirHeadsAlone) {
  for (const EmitCase& c : random_cases(0x68656164U, 40)) {
    const std::string text = emit_glsl(c.program, GlslVersion::glsl_330).value();
    const std::string body = text.substr(text.find('\n'));
    EXPECT_TRUE(emit_glsl(c.program, GlslVersion::es_300).value().ends_with("precision highp int;" + body)) << text;
    EXPECT_TRUE(emit_glsl(c.program, GlslVersion::glsl_130).value().ends_with("#version 130" + body)) << text;
  }
}

TEST(EmitText, TheArticlesProgramReadsAsItIs) {
  const std::string text = emit_glsl(known_cases()[0].program, GlslVersion::glsl_330).value();
  EXPECT_EQ(text.rfind("#version 330 core\n", 0), 0U);
  EXPECT_TRUE(has(text, "//   spare0.rgb = (A*B + C*D) * 4\n"));
  EXPECT_TRUE(has(text,
                  "  int s0_spare0_r = clamp(clamp(max(primary.r, 0) - max(texture0.r, 0), -64, 64) * 4, "
                  "-255, 255);\n"));
  EXPECT_TRUE(has(text, "//   spare1.rgb = dot(A, B) * 4\n"));
  EXPECT_TRUE(has(text, "  return ivec4(0, 0, 0, s1_spare1_b);\n"));
  EXPECT_FALSE(has(text, "s1_spare1_r")) << "red is not read";
  EXPECT_FALSE(has(text, "alpha portion")) << "the alpha portions write nothing";
}

TEST(EmitText, UniformConstantsAreNoPartOfTheText) {
  const auto text_of = [](const CombinerState& state) {
    return emit_glsl_with_uniform_constants(compiled(state, profiles::nv2a), GlslVersion::glsl_130, "mine").value();
  };
  CombinerState state;
  state.per_stage_constants = true;
  state.num_general_combiners = 2;
  state.general[1].rgb.a.reg = Register::constant1;
  state.general[1].constant1 = {0.0F, 0.5F, 1.0F, 1.0F};
  state.final_combiner.d.reg = Register::constant0;
  const std::string text = text_of(state);
  EXPECT_EQ(text.rfind("#version 130\n", 0), 0U);
  EXPECT_TRUE(has(text, "uniform ivec4 mine_constants[18];\n"));
  EXPECT_TRUE(has(text, "mine_constants[3].r")) << "constant 1 of general combiner 1";
  EXPECT_TRUE(has(text, "mine_constants[16].b")) << "constant 0 of the final combiner";
  EXPECT_FALSE(has(text, "mine_constants[2]"));
  CombinerState other = state;
  other.constant0 = {0.25F, 0.125F, 0.0F, 0.0F};
  other.general[1].constant1 = {1.0F, 1.0F, 0.0F, 0.0F};
  EXPECT_EQ(without_comments(text_of(other)), without_comments(text));
}

TEST(EmitText, LeavesOutWhatIsOverwrittenAndFoldsConstants) {
  CombinerState state;
  state.num_general_combiners = 2;
  state.constant0 = {1.0F, 0.0F, 0.2F, 1.0F};
  state.general[0].rgb.a.reg = Register::texture1;  // lost: stage 1 writes the same register
  state.general[1].rgb.a.reg = Register::constant0;
  state.final_combiner = {};
  state.final_combiner.a = state.final_combiner.b = state.final_combiner.c = CombinerInput{};
  state.final_combiner.d = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  const std::string text = emit_glsl(compiled(state), GlslVersion::es_300).value();
  EXPECT_EQ(text.rfind("#version 300 es\nprecision highp int;\n", 0), 0U);
  EXPECT_TRUE(has(text, "General combiner 0, RGB portion: none of its outputs is read."));
  EXPECT_FALSE(has(text, "texture1.r"));
  EXPECT_TRUE(has(text, "//   spare0.b is 51\n"));
  EXPECT_TRUE(has(text, "return ivec4(255, 0, 51, "));
}

TEST(EmitText, NamesOfHelpersBeginWithTheFunctionsName) {
  for (const EmitCase& c : random_cases(0x6E616D65U, 100)) {
    const std::string text = emit_c(c.program, "shade7").value();
    EXPECT_TRUE(has(text, "void shade7(const int32_t primary[4]"));
    const std::regex function("static int32_t (\\w+)\\(");
    for (std::sregex_iterator at(text.begin(), text.end(), function), end; at != end; ++at) {
      EXPECT_EQ((*at)[1].str().rfind("shade7_", 0), 0U) << text;
    }
    EXPECT_EQ(text, emit_c(c.program, "shade7").value()) << "equal programs give equal text";
  }
}

TEST(EmitText, RefusesUnusableNames) {
  const Program program = compiled(CombinerState{});
  for (const char* name : {"", "7up", "a-b", "a__b", "a_", "_a", "gl_Color", "a b", "f(x)", "caf\xC3\xA9"}) {
    const auto glsl = emit_glsl(program, GlslVersion::glsl_330, name);
    ASSERT_FALSE(glsl.ok()) << name;
    EXPECT_TRUE(has(glsl.error().text(), "is not a valid function name"));
    EXPECT_FALSE(emit_c(program, name).ok()) << name;
  }
  EXPECT_TRUE(emit_c(program, "a_b7").ok());
}

TEST(EmitText, RefusesProfilesThatAreNotInteger) {
  int refused = 0;
  for (const HardwareProfile& p : hardware_profiles()) {
    if (datapath_of(p).arithmetic == Arithmetic::integer) continue;
    ++refused;
    const auto glsl = emit_glsl(compiled(CombinerState{}, p), GlslVersion::glsl_330);
    ASSERT_FALSE(glsl.ok()) << p.name;
    EXPECT_TRUE(has(glsl.error().text(), "only programs of integer profiles"));
    EXPECT_FALSE(emit_c(compiled(CombinerState{}, p)).ok()) << p.name;
  }
  EXPECT_GE(refused, 2);
}

TEST(EmitText, RefusesCodesThatDoNotFit) {
  CombinerState state;
  state.general[0].rgb.out.scale = Scale::by_four;
  Program program = compiled(state);
  program.datapath.one = 20000;
  program.datapath.lowest = -20000;
  EXPECT_TRUE(has(emit_c(program).error().text(), "too large for 32-bit integers"));
  program.datapath.one = 1 << 20;
  EXPECT_TRUE(has(emit_c(program).error().text(), "out of the datapath's range"));
  program = compiled(state);
  program.datapath.half = 2000;
  EXPECT_FALSE(emit_glsl(program, GlslVersion::glsl_330).ok());
  program.datapath.half = 128;
  EXPECT_TRUE(emit_glsl(program, GlslVersion::glsl_330).ok());
}

}  // namespace
}  // namespace ninebit::test
