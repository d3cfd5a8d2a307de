// Texts of GL calls, as people paste them, and the states they leave.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/language/index_comparison.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

CombinerState parsed(std::string_view text, const HardwareProfile& profile = profiles::nv2a) {
  const auto result = parse_gl_calls({text, "calls.c"}, profile);
  for (const TextFault& fault : result.faults()) ADD_FAILURE() << fault.text();
  EXPECT_TRUE(result.ok());
  return result ? *result : CombinerState{};
}

TEST(GlCalls, ReadTheArticle) {
  const std::string text = test::read_bytes(NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl");
  const CombinerState wanted = test::index_comparison();
  EXPECT_TRUE(parsed(text + "// and a comment without a line's end", profiles::geforce2) == wanted);
  EXPECT_TRUE(parsed(print_gl_calls(wanted, profiles::geforce2).value(), profiles::geforce2) == wanted);
}

TEST(GlCalls, AnEmptyTextLeavesTheDefaults) {
  EXPECT_TRUE(parsed("") == CombinerState{});
  EXPECT_TRUE(parsed(" \t\r\n;; /* nothing */ // at all\n;") == CombinerState{});
  EXPECT_TRUE(parsed("\xEF\xBB\xBF// a byte order mark\n") == CombinerState{});
}

TEST(GlCalls, LaterCallsChangeWhatEarlierOnesLeft) {
  const CombinerState state = parsed(R"(
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_FOG, GL_EXPAND_NEGATE_NV, GL_BLUE);
    glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, GL_FALSE);
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 8);
    glEnable(GL_PER_STAGE_CONSTANTS_NV);
    glDisable(GL_PER_STAGE_CONSTANTS_NV); glDisable(GL_REGISTER_COMBINERS_NV);
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);)");
  CombinerState wanted;
  wanted.general[0].alpha.c = {Register::fog, InputMapping::expand_negate, ComponentUsage::blue};
  wanted.color_sum_clamp = false;
  wanted.num_general_combiners = 3;
  EXPECT_TRUE(state == wanted);
}

TEST(GlCalls, NoneZeroAndFalseAreTheSameNumber) {
  CombinerState wanted;
  wanted.general[0].rgb.a = CombinerInput{};
  wanted.general[0].rgb.out = {.sum = Register::spare1, .cd_dot_product = true};
  for (const char* const zero : {"GL_ZERO", "GL_NONE", "GL_FALSE", "0", "0x0", "00", "false", "FALSE", "0u"}) {
    for (const char* const one : {"GL_TRUE", "1", "0x1", "true", "TRUE", "GL_ONE"}) {
      const std::string z = zero;
      const std::string text =
          "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, " + z + ", GL_UNSIGNED_IDENTITY_NV, GL_RGB);" +
          "glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE1_NV, " + z + "," + z +
          "," + z + "," + one + "," + z + ");";
      EXPECT_TRUE(parsed(text) == wanted) << text;
    }
  }
}

TEST(GlCalls, TexturesAndStagesGoByNameNumberAndSum) {
  CombinerState wanted;
  wanted.general[2].rgb.b = test::rgb_of(Register::texture3, InputMapping::signed_negate);
  for (const char* const texture : {"GL_TEXTURE3", "GL_TEXTURE3_ARB", "0x84C3", "0X84c3UL", "33987", "0102303",
                                    "GL_TEXTURE0 + 3", "GL_TEXTURE1_ARB+2", "GL_TEXTURE5-2", "3 + GL_TEXTURE0"}) {
    for (const char* const stage : {"GL_COMBINER2_NV", "0x8552", "GL_COMBINER0_NV + 2", "GL_COMBINER1_NV+1"}) {
      const std::string text = std::string("glCombinerInputNV(") + stage + ", GL_RGB, GL_VARIABLE_B_NV, " + texture +
                               ", GL_SIGNED_NEGATE_NV, 6407);";
      EXPECT_TRUE(parsed(text) == wanted) << text;
    }
  }
}

TEST(GlCalls, FunctionPointersHavePrefixesAndSuffixes) {
  CombinerState wanted;
  wanted.num_general_combiners = 2;
  for (const char* const name : {"glCombinerParameteriNV",
                                 "pglCombinerParameteriNV",
                                 "qglCombinerParameteriNV",
                                 "_glCombinerParameteriNV",
                                 "__glewCombinerParameteriNV",
                                 "m_gl_CombinerParameteriNV",
                                 "glCombinerParameteriNVptr",
                                 "glCombinerParameteriNV_ptr",
                                 "glCombinerParameteriNVPROC",
                                 "glCombinerParameteriNVEXT",
                                 "pglCombinerParameteriNVFunc",
                                 "CombinerParameteriNV",
                                 "glCombinerParameteri",
                                 "CombinerParameteri",
                                 "glCombinerParameteriNVARB",
                                 "gl_x_CombinerParameteriNV",
                                 "aVeryLongPrefix_glCombinerParameteriNV",
                                 "nvCombinerParameteriNV",
                                 "glue->glCombinerParameteriNV",
                                 "gl.glCombinerParameteriNV",
                                 "gl.CombinerParameteriNV",
                                 "vtkgl::CombinerParameteriNV",
                                 "This->gl.glCombinerParameteriNV",
                                 "GL11.glCombinerParameteriNV"}) {
    EXPECT_TRUE(parsed(std::string(name) + "(GL_NUM_GENERAL_COMBINERS_NV, 2);") == wanted) << name;
  }
  for (const char* const name :
       {"glcombinerParameteriNV", "glCombinerParameteriNVGL", "glGetCombinerParameteriNV", "setCombinerParameteri",
        "aPrefixOfTwentyOneCharglCombinerParameteriNV", "glCombinerParameteriiNV"}) {
    EXPECT_FALSE(parse_gl_calls({std::string(name) + "(GL_NUM_GENERAL_COMBINERS_NV, 2);", ""}, profiles::nv2a)) << name;
  }
  wanted.per_stage_constants = true;
  EXPECT_TRUE(parsed("qglCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, 2.0f); pglEnable(0x8535);") == wanted);
}

TEST(GlCalls, EnumerantsNeedTheirBeginning) {
  // Without GL_ and without a qualifier these may be anything.
  for (const char* const name : {"RGB", "ALPHA", "TEXTURE0", "ZERO", "FOG"}) {
    EXPECT_FALSE(parse_gl_calls({std::string("glEnable(") + name + ");", ""}, profiles::nv2a)) << name;
  }
  // Another enumerant that GL has.
  const auto other = parse_gl_calls(
      {"glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);", "f"},
      profiles::nv2a);
  ASSERT_EQ(other.faults().size(), 1U);
  EXPECT_EQ(other.faults()[0].text(), "f:1:42: GL_INVALID_ENUM: 'GL_PRIMARY_COLOR_ARB' is not a valid input register");
}

TEST(GlCalls, ArraysAreBracesLiteralsOrDeclared) {
  CombinerState wanted;
  wanted.constant1 = {0.25F, 1.0F, 0.0F, 0.1F};
  for (const char* const text :
       {"glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, {0.25, 1, 0, .1f});",
        "glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, (GLfloat[]){0.25f, 1.f, 0.0f, 1e-1f,});",
        "glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, (const GLfloat[4]){2.5E-1F, 7, -0.0f, 0.1F});",
        "GLfloat c[] = {.25, 1., 0, 0.1f}; glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, c);",
        ("static const float a[4] = {1}, c[4] = {.25f, 1, -3, 100e-3f};"
         "glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, &c[0]);"),
        "const GLfloat c[6] = {0.25f, +1, 0, .1f}; glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, c);"}) {
    EXPECT_TRUE(parsed(text) == wanted) << text;
  }
}

TEST(GlCalls, IntegersAreConvertedAsGlDoes) {
  const CombinerState state = parsed(R"(
    GLint white[4] = {2147483647, -1, 0x7fffffff};
    glCombinerParameterivNV(GL_CONSTANT_COLOR0_NV, white);
    glCombinerParameterivNV(GL_NUM_GENERAL_COMBINERS_NV, (int[]){5});
    glCombinerParameterfvNV(GL_COLOR_SUM_CLAMP_NV, (GLfloat[1]){0});)");
  EXPECT_EQ(state.constant0[0], 1.0F);
  EXPECT_EQ(state.constant0[1], 0.0F);
  EXPECT_EQ(state.constant0[2], 1.0F);
  EXPECT_EQ(state.constant0[3], static_cast<float>(1.0 / 4294967295.0));
  EXPECT_EQ(state.num_general_combiners, 5);
  EXPECT_FALSE(state.color_sum_clamp);
}

TEST(GlCalls, StagesHaveConstantsOfTheirOwn) {
  CombinerState wanted;
  wanted.general[7].constant0 = {1, 1, 1, 0.5F};
  EXPECT_TRUE(parsed("glCombinerStageParameterfvNV(GL_COMBINER7_NV, GL_CONSTANT_COLOR0_NV, {9, 1, 1e30, .5});") ==
              wanted);
}

TEST(GlCalls, PrintAnExtensionsCallsOnlyWhereTheyAreNeeded) {
  const std::string text = print_gl_calls({}, profiles::geforce2).value();
  EXPECT_FALSE(test::has(text, "Stage"));
  EXPECT_FALSE(test::has(text, "PER_STAGE"));
  EXPECT_FALSE(test::has(text, "GL_COMBINER1_NV")) << "the second stage has its defaults and is not used";
  EXPECT_TRUE(test::has(text,
                        "glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, "
                        "GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);\n"));
  EXPECT_TRUE(parsed(text, profiles::geforce2) == CombinerState{});
}

}  // namespace
}  // namespace ninebit
