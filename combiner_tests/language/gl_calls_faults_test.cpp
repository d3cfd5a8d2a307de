// The faults of texts of GL calls, with their places.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

void expect(const std::vector<test::TextAndFaults>& cases) {
  test::expect_faults(cases, [](const std::string& text) { return parse_gl_calls({text, "f"}, profiles::geforce2); });
}

const std::vector<test::TextAndFaults> kWords{
    {"glClear(0);", "f:1:1: 'glClear' is not a call of the register combiners\n"},
    {"int x;", "f:1:6: expected '[', found ';'\n"},
    // Lines that end by \r alone.
    {"// a\rglClear(0);", "f:1:6: 'glClear' is not a call of the register combiners\n"},
    {"\n  hello", "f:2:3: expected a GL call, found 'hello'\n"},
    {"#include <GL/gl.h>\n#define X\n",
     "f:1:1: preprocessor lines are not supported; expected a GL call\n"
     "f:2:1: preprocessor lines are not supported; expected a GL call\n"},
    {"/* a\n*/ /* b", "f:2:4: unterminated comment; expected */\n"},
    {"glEnable(GL_REGISTER_COMBINERS_NV", "f:1:34: expected ',', but the text ends\n"},
    {"glEnable(GL_REGISTER_COMBINERS_NV /*", "f:1:35: unterminated comment; expected */\n"},
    {"glEnable(GL_REGISTER_COMBINERS_NV)\nglEnable(GL_FOO);",
     "f:2:1: expected ';', found 'glEnable'\n"
     "f:2:10: 'GL_FOO' is neither an enumerant of the register combiners nor a declared array; did you mean "
     "'GL_FOG'?\n"},
    {"glEnable(GL_A\nglEnable(GL_B);",
     "f:1:10: 'GL_A' is neither an enumerant of the register combiners nor a declared array\n"
     "f:2:1: expected ',', found 'glEnable'\n"
     "f:2:10: 'GL_B' is neither an enumerant of the register combiners nor a declared array\n"},
    {"glCombinerInptuNV(GL_SPARE0);",
     "f:1:1: 'glCombinerInptuNV' is not a call of the register combiners; did you mean 'glCombinerInputNV'?\n"},
    {"glFinalCombinerInputNV(GL_VARAIBLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY, GL_RGB);",
     "f:1:24: 'GL_VARAIBLE_A_NV' is neither an enumerant of the register combiners nor a declared array; did you mean "
     "'GL_VARIABLE_A_NV'?\n"},
    {"glEnable(GL_A, GL_B);",
     "f:1:10: 'GL_A' is neither an enumerant of the register combiners nor a declared array\n"
     "f:1:16: 'GL_B' is neither an enumerant of the register combiners nor a declared array\n"},
    {"glEnable 5;", "f:1:10: expected '(', found '5'\n"},
    {"glEnable(\"GL_FOG\");", "f:1:10: expected an enumerant or a number, found '\"GL_FOG\"'\n"},
    {"glEnable();", "f:1:1: glEnable takes 1 argument, not 0\n"},
    {"glCombinerInputNV(1, 2, 3, 4, 5);", "f:1:1: glCombinerInputNV takes 6 arguments, not 5\n"},
    {"glEnable(0x1FFFFFFFF);", "f:1:10: '0x1FFFFFFFF' is not a C number, or is out of range\n"},
    {"glEnable(08);", "f:1:10: '08' is not a C number, or is out of range\n"},
    {"glEnable(1.5.5);", "f:1:10: '1.5.5' is not a C number, or is out of range\n"},
    {"glEnable(1x);", "f:1:10: '1x' is not a C number, or is out of range\n"},
    {"glEnable(2.0);", "f:1:10: '2.0' cannot be passed here; expected an enumerant\n"},
    {"glEnable(-1);", "f:1:10: '-1' cannot be passed here; expected an enumerant\n"},
    {"glEnable({1});", "f:1:10: '{1}' cannot be passed here; expected one value\n"},
    {"glEnable(GL_TEXTURE32);",
     "f:1:10: 'GL_TEXTURE32' is neither an enumerant of the register combiners nor a declared array\n"},
    {"glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2.5f);",
     "f:1:53: '2.5f' cannot be passed here; expected an integer\n"},
    {"glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 4294967295);",
     "f:1:53: '4294967295' cannot be passed here; expected an integer\n"},
    {"glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, 0);",
     "f:1:48: '0' cannot be passed here; expected an array, such as (GLfloat[]){0, 0, 0, 1}\n"},
    {"glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, {1, 2, 3});",
     "f:1:48: '{1, 2, 3}' cannot be passed here; expected 4 values, not 3\n"},
    {"GLint c[4] = {1}; glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c);",
     "f:1:66: 'c' cannot be passed here; expected an array of floats\n"},
    {"glCombinerParameterivNV(GL_CONSTANT_COLOR0_NV, (GLfloat[]){1, 1, 1, 1});",
     "f:1:48: '(GLfloat[]){1, 1, 1, 1}' cannot be passed here; expected an array of integers\n"},
    {"GLint c[] = {1, 2.5};", "f:1:17: '2.5' is not an integer\n"},
    {"GLfloat c[2] = {1, 2, 3};", "f:1:23: too many values; the array has 2 elements\n"},
    {"GLfloat c[0] = {1};", "f:1:11: an array has 1 to 1024 elements, not '0'\n"},
    {"GLfloat c[] = {1};\nGLfloat c[] = {2};", "f:2:9: 'c' is already declared\n"},
    {"GLfloat c[] = {{{{{{", "f:1:16: expected an enumerant or a number, found '{'\n"},
    {"glEnable(c);", "f:1:10: 'c' is neither an enumerant of the register combiners nor a declared array\n"},
    {"glEnable(&c[0]);", "f:1:11: expected an array declared above, found 'c'\n"},
    {"((((((((((((((((;;", "f:1:1: expected a GL call, found '('\n"},
    {"\xFF\xFE\x80 glEnable(GL_REGISTER_COMBINERS_NV);\n@",
     "f:1:1: expected a GL call, found '\\xff\\xfe\\x80'\n"
     "f:2:1: expected a GL call, found '@'\n"},
    {"颜色();", "f:1:1: expected a GL call, found '颜色'\n"},
    {std::string("glEnable(\0GL_REGISTER_COMBINERS_NV);", 35),
     "f:1:10: expected an enumerant or a number, found '\\x00'\n"},
    // A character that changes the direction of a line is escaped.
    {"\u202E();", "f:1:1: expected a GL call, found '\\xe2\\x80\\xae'\n"},
};

TEST(GlCallsFaults, NameTheirPlace) {
  expect(kWords);
}

const std::vector<test::TextAndFaults> kRefused{
    {"glEnable(GL_FOG);",
     "f:1:1: GL_INVALID_ENUM: expected GL_REGISTER_COMBINERS_NV or GL_PER_STAGE_CONSTANTS_NV, not 'GL_FOG'\n"},
    {"glDisable(GL_PER_STAGE_CONSTANTS_NV);",
     "f:1:1: GL_INVALID_ENUM: profile geforce2 has no per-stage constants (NV_register_combiners2)\n"},
    {"glCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_CONSTANT_COLOR0_NV, {1, 1, 1, 1});",
     "f:1:1: GL_INVALID_ENUM: profile geforce2 has no per-stage constants (NV_register_combiners2)\n"},
    {"glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 0);",
     "f:1:1: GL_INVALID_VALUE: profile geforce2 has 2 general combiners\n"},
    {"glCombinerParameterfvNV(GL_NUM_GENERAL_COMBINERS_NV, {3});",
     "f:1:1: GL_INVALID_VALUE: profile geforce2 has 2 general combiners\n"},
    {"glCombinerParameteriNV(GL_CONSTANT_COLOR0_NV, 1);",
     "f:1:1: GL_INVALID_ENUM: expected GL_NUM_GENERAL_COMBINERS_NV or GL_COLOR_SUM_CLAMP_NV, not "
     "'GL_CONSTANT_COLOR0_NV'\n"},
    {"glCombinerParameterivNV(GL_FOG, {1, 1, 1, 1});",
     "f:1:1: GL_INVALID_ENUM: expected a constant colour or a parameter of the combiners, not 'GL_FOG'\n"},
    {"glCombinerInputNV(GL_COMBINER0_NV, GL_BLUE, GL_FOG, GL_ONE, 5, GL_RGB);",
     "f:1:36: GL_INVALID_ENUM: 'GL_BLUE' is not a valid portion; expected GL_RGB or GL_ALPHA\n"
     "f:1:45: GL_INVALID_ENUM: 'GL_FOG' is not a valid variable\n"
     "f:1:53: GL_INVALID_ENUM: 'GL_ONE' is not a valid input register\n"
     "f:1:61: GL_INVALID_ENUM: '5' is not a valid input mapping\n"},
    {"\n glCombinerInputNV(GL_COMBINER2_NV, GL_RGB, GL_VARIABLE_E_NV, GL_FOG, GL_EXPAND_NORMAL_NV, GL_ALPHA);",
     "f:2:2: GL_INVALID_ENUM: general combiner 2, RGB portion, variable E: profile geforce2 has 2 general combiners\n"
     "f:2:2: GL_INVALID_ENUM: general combiner 2, RGB portion, variable E: a general combiner has the variables A to "
     "D\n"
     "f:2:2: GL_INVALID_OPERATION: general combiner 2, RGB portion, variable E: fog's alpha can be read by the final "
     "combiner alone\n"},
    {"glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_SPARE0_NV, GL_SPARE0_NV, GL_TEXTURE2, GL_SCALE_BY_FOUR_NV, "
     "GL_BIAS_BY_NEGATIVE_ONE_HALF_NV, GL_TRUE, 0, 0);",
     "f:1:1: GL_INVALID_ENUM: general combiner 0, alpha portion: texture2 is beyond the 2 texture units of profile "
     "geforce2\n"
     "f:1:1: GL_INVALID_OPERATION: general combiner 0, alpha portion: two outputs go to spare0; each needs its own "
     "register\n"
     "f:1:1: GL_INVALID_VALUE: general combiner 0, alpha portion: an alpha portion has no dot product\n"
     "f:1:1: GL_INVALID_OPERATION: general combiner 0, alpha portion: a bias of minus one half goes with no scale or "
     "with scale_by_two, not with scale_by_four\n"},
    {"glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_SPARE0_PLUS_SECONDARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);",
     "f:1:1: GL_INVALID_OPERATION: final combiner, variable A: spare0_plus_secondary_color can be read by the "
     "variables B, C and D alone\n"},
};

TEST(GlCallsFaults, GiveGlsErrorAndItsReason) {
  expect(kRefused);
}

TEST(GlCallsFaults, HaveAnEnd) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "glEnable(GL_FOG);\n";
  const auto result = parse_gl_calls({text, ""}, profiles::geforce2);
  ASSERT_EQ(result.faults().size(), kMaxTextFaults);
  EXPECT_EQ(result.faults().back().line, 100);
}

TEST(GlCallsFaults, AreOneForMegabytesOfNonsense) {
  if (ninebit::test::kSanitized || ninebit::test::kCoverage) GTEST_SKIP() << "shows how long a text takes";
  for (const char c : {'(', '{', '[', '+', '\0', '\xFF', '0', '.', 'x', '/', ','}) {
    const std::string text(c == '(' ? kMaxSourceBytes : kMaxSourceBytes / 64, c);
    const auto result = parse_gl_calls({text, ""}, profiles::geforce2);
    if (c == '/') {
      EXPECT_TRUE(result) << "a comment";
      continue;
    }
    EXPECT_EQ(result.faults().size(), 1U) << c;
    const auto within = parse_gl_calls({"glCombinerParameterfvNV(" + text.substr(100), ""}, profiles::geforce2);
    EXPECT_GE(within.faults().size(), 1U) << c;
    EXPECT_LE(within.faults().size(), 2U) << c;
  }
  expect({{std::string(kMaxSourceBytes + 1, ' '), "f:1:1: the text has 16777217 bytes; the limit is 16777216\n"}});
}

}  // namespace
}  // namespace ninebit
