// One test a rule: the errors that the extensions, or GL's general rules, name. The matrices of inputs and
// of outputs are in gl_legality_test.cpp.
#include <array>
#include <limits>
#include <string>

#include "combiner_tests/language/gl_test_support.h"

namespace ninebit::gl {
namespace {

// Runs a command, and expects its error and that neither the state nor the enable moved.
#define EXPECT_REFUSED(error, command)                                                  \
  do {                                                                                  \
    const CombinerState before = context.state();                                       \
    const bool was_enabled = context.register_combiners_enabled();                      \
    command;                                                                            \
    EXPECT_EQ(glGetError(), error) << #command;                                         \
    EXPECT_TRUE(context.state() == before) << #command << " changed the state";         \
    EXPECT_EQ(context.register_combiners_enabled(), was_enabled) << #command;           \
    EXPECT_EQ(glGetError(), GL_NO_ERROR) << "glGetError did not clear after " #command; \
  } while (false)

constexpr std::array<GLfloat, 4> kFloats{0.25F, 0.5F, 0.75F, 1.0F};
constexpr std::array<GLint, 4> kInts{1, 2, 3, 4};
constexpr GLenum kNoSuchEnum = 0xDEAD;

using GlErrors = GlTest;
using GlErrorsNv2a = GlNv2aTest;

TEST_F(GlErrors, OfAnUnknownParameterName) {
  for (const GLenum pname : {GL_MAX_GENERAL_COMBINERS_NV, GL_REGISTER_COMBINERS_NV, GL_SPARE0_NV, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerParameteriNV(pname, 1));
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerParameterfNV(pname, 1));
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerParameterivNV(pname, kInts.data()));
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerParameterfvNV(pname, kFloats.data()));
  }
}

TEST_F(GlErrors, OfAColorAsAScalar) {
  for (const GLenum pname : {GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerParameteriNV(pname, 1));
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerParameterfNV(pname, 1.0F));
  }
}

TEST_F(GlErrors, OfTheNumberOfGeneralCombiners) {
  for (const GLint number : {0, -1, 3, 8, std::numeric_limits<GLint>::min(), std::numeric_limits<GLint>::max()}) {
    const auto real = static_cast<GLfloat>(number);
    EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, number));
    EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerParameterivNV(GL_NUM_GENERAL_COMBINERS_NV, &number));
    EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, real));
    EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerParameterfvNV(GL_NUM_GENERAL_COMBINERS_NV, &real));
  }
  for (const GLfloat number : {0.49F, 2.5F, std::numeric_limits<GLfloat>::quiet_NaN(),
                               std::numeric_limits<GLfloat>::infinity(), -std::numeric_limits<GLfloat>::infinity()}) {
    EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, number));
  }
}

TEST_F(GlErrors, NotOfTheGreatestNumberOfGeneralCombiners) {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
  EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 2);
  glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, 1.4F);
  EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 1);
  glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, 1.6F);
  EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 2);
}

TEST_F(GlErrors, OfAnInputsEnums) {
  constexpr GLenum stage = GL_COMBINER1_NV, a = GL_VARIABLE_A_NV, in = GL_SPARE0_NV, map = GL_SIGNED_IDENTITY_NV;
  for (const GLenum wrong : {GL_COMBINER2_NV, GL_COMBINER0_NV - 1, GL_COMBINER7_NV + 1, kNoSuchEnum, GLenum{0}}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(wrong, GL_RGB, a, in, map, GL_RGB));
  }
  for (const GLenum wrong : {GL_BLUE, GLenum{0x1908}, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(stage, wrong, a, in, map, GL_RGB));
  }
  for (const GLenum wrong : {GL_VARIABLE_E_NV, GL_VARIABLE_F_NV, GL_VARIABLE_G_NV, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(stage, GL_RGB, wrong, in, map, GL_RGB));
  }
  for (const GLenum wrong : {GL_ONE, GL_E_TIMES_F_NV, GL_SPARE0_PLUS_SECONDARY_COLOR_NV, GL_DISCARD_NV, GL_TEXTURE2_ARB,
                             GLenum{0x84DF}, GLenum{0x84E0}, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(stage, GL_RGB, a, wrong, map, GL_RGB));
  }
  for (const GLenum wrong : {GL_NONE, GL_SCALE_BY_TWO_NV, GL_PER_STAGE_CONSTANTS_NV, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(stage, GL_RGB, a, in, wrong, GL_RGB));
  }
  for (const GLenum wrong : {GL_NONE, GLenum{0x1908}, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(stage, GL_RGB, a, in, map, wrong));
  }
}

TEST_F(GlErrors, PreferInvalidEnum) {
  EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, kNoSuchEnum,
                                                    GL_SIGNED_IDENTITY_NV, GL_RGB));
  EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_TEXTURE3_ARB,
                                                    GL_SIGNED_IDENTITY_NV, GL_BLUE));
  EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_SPARE0_NV, GL_SPARE0_NV, GL_FOG,
                                                     GL_NONE, GL_NONE, GL_TRUE, GL_FALSE, GL_FALSE));
  EXPECT_REFUSED(GL_INVALID_ENUM,
                 glFinalCombinerInputNV(GL_VARIABLE_E_NV, GL_E_TIMES_F_NV, GL_SIGNED_IDENTITY_NV, GL_RGB));
}

TEST_F(GlErrors, OfAnOutputsEnums) {
  const auto output = [](GLenum stage, GLenum portion, GLenum ab, GLenum cd, GLenum sum, GLenum scale, GLenum bias) {
    glCombinerOutputNV(stage, portion, ab, cd, sum, scale, bias, GL_FALSE, GL_FALSE, GL_FALSE);
  };
  constexpr GLenum s = GL_COMBINER0_NV, no = GL_DISCARD_NV;
  EXPECT_REFUSED(GL_INVALID_ENUM, output(GL_COMBINER2_NV, GL_RGB, GL_SPARE1_NV, no, no, GL_NONE, GL_NONE));
  EXPECT_REFUSED(GL_INVALID_ENUM, output(s, GL_BLUE, GL_SPARE1_NV, no, no, GL_NONE, GL_NONE));
  for (const GLenum wrong : {GL_ZERO, GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV, GL_FOG, GL_E_TIMES_F_NV,
                             GL_SPARE0_PLUS_SECONDARY_COLOR_NV, GL_TEXTURE2_ARB, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, output(s, GL_RGB, wrong, no, no, GL_NONE, GL_NONE));
    EXPECT_REFUSED(GL_INVALID_ENUM, output(s, GL_RGB, no, wrong, no, GL_NONE, GL_NONE));
    EXPECT_REFUSED(GL_INVALID_ENUM, output(s, GL_ALPHA, no, no, wrong, GL_NONE, GL_NONE));
  }
  for (const GLenum wrong : {GL_ONE, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, output(s, GL_RGB, GL_SPARE1_NV, no, no, wrong, GL_NONE));
  }
  for (const GLenum wrong : {GL_ONE, GL_SCALE_BY_TWO_NV, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, output(s, GL_RGB, GL_SPARE1_NV, no, no, GL_NONE, wrong));
  }
}

TEST_F(GlErrors, OfAFinalInputsEnums) {
  constexpr GLenum map = GL_UNSIGNED_IDENTITY_NV;
  EXPECT_REFUSED(GL_INVALID_ENUM, glFinalCombinerInputNV(kNoSuchEnum, GL_FOG, map, GL_RGB));
  EXPECT_REFUSED(GL_INVALID_ENUM, glFinalCombinerInputNV(GL_VARIABLE_B_NV, kNoSuchEnum, map, GL_RGB));
  EXPECT_REFUSED(GL_INVALID_ENUM, glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_SPARE0_NV, map, GL_NONE));
}

TEST_F(GlErrors, OfEnables) {
  GLboolean enabled = GL_TRUE;
  for (const GLenum cap : {GL_FOG, GL_COLOR_SUM_CLAMP_NV, kNoSuchEnum, GL_PER_STAGE_CONSTANTS_NV}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glEnable(cap));
    EXPECT_REFUSED(GL_INVALID_ENUM, glDisable(cap));
    EXPECT_REFUSED(GL_INVALID_ENUM, enabled = glIsEnabled(cap));
    EXPECT_EQ(enabled, GL_FALSE);
  }
}

TEST_F(GlErrors, OfPerStageConstantsWithoutTheExtension) {
  std::array<GLfloat, 4> color = kFloats;
  GLint value = 77;
  EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_CONSTANT_COLOR0_NV, kFloats.data()));
  EXPECT_REFUSED(GL_INVALID_ENUM,
                 glGetCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_CONSTANT_COLOR0_NV, color.data()));
  EXPECT_REFUSED(GL_INVALID_ENUM, glGetIntegerv(GL_PER_STAGE_CONSTANTS_NV, &value));
  EXPECT_EQ(color, kFloats);
  EXPECT_EQ(value, 77);
}

TEST_F(GlErrorsNv2a, OfPerStageConstants) {
  std::array<GLfloat, 4> color = kFloats;
  for (const GLenum stage : {GL_COMBINER0_NV - 1, GL_COMBINER7_NV + 1, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerStageParameterfvNV(stage, GL_CONSTANT_COLOR0_NV, kFloats.data()));
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetCombinerStageParameterfvNV(stage, GL_CONSTANT_COLOR0_NV, color.data()));
  }
  for (const GLenum pname : {GL_NUM_GENERAL_COMBINERS_NV, GL_SPARE0_NV, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glCombinerStageParameterfvNV(GL_COMBINER3_NV, pname, kFloats.data()));
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetCombinerStageParameterfvNV(GL_COMBINER3_NV, pname, color.data()));
  }
  EXPECT_EQ(color, kFloats);
}

TEST_F(GlErrors, OfGets) {
  std::array<GLint, 4> ints = kInts;
  std::array<GLfloat, 4> floats = kFloats;
  constexpr GLenum s = GL_COMBINER0_NV, a = GL_VARIABLE_A_NV, in = GL_COMBINER_INPUT_NV, out = GL_COMBINER_AB_OUTPUT_NV;
  struct Case {
    GLenum stage, portion, variable, pname;
  };
  for (const Case& c : {Case{GL_COMBINER2_NV, GL_RGB, a, in}, Case{s, GL_BLUE, a, in},
                        Case{s, GL_RGB, GL_VARIABLE_E_NV, in}, Case{s, GL_RGB, a, out}}) {
    EXPECT_REFUSED(GL_INVALID_ENUM,
                   glGetCombinerInputParameterivNV(c.stage, c.portion, c.variable, c.pname, ints.data()));
    EXPECT_REFUSED(GL_INVALID_ENUM,
                   glGetCombinerInputParameterfvNV(c.stage, c.portion, c.variable, c.pname, floats.data()));
  }
  for (const Case& c : {Case{GL_COMBINER2_NV, GL_RGB, 0, out}, Case{s, GL_BLUE, 0, out}, Case{s, GL_RGB, 0, in}}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetCombinerOutputParameterivNV(c.stage, c.portion, c.pname, ints.data()));
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetCombinerOutputParameterfvNV(c.stage, c.portion, c.pname, floats.data()));
  }
  for (const Case& c : {Case{0, 0, kNoSuchEnum, in}, Case{0, 0, a, out}}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetFinalCombinerInputParameterivNV(c.variable, c.pname, ints.data()));
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetFinalCombinerInputParameterfvNV(c.variable, c.pname, floats.data()));
  }
  for (const GLenum pname : {GL_SPARE0_NV, kNoSuchEnum}) {
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetIntegerv(pname, ints.data()));
    EXPECT_REFUSED(GL_INVALID_ENUM, glGetFloatv(pname, floats.data()));
  }
  EXPECT_EQ(ints, kInts) << "a refused get wrote";
  EXPECT_EQ(floats, kFloats) << "a refused get wrote";
}

TEST_F(GlErrorsNv2a, OfNullPointers) {
  constexpr GLenum s = GL_COMBINER0_NV, a = GL_VARIABLE_A_NV, c0 = GL_CONSTANT_COLOR0_NV;
  EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerParameterivNV(GL_NUM_GENERAL_COMBINERS_NV, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerParameterfvNV(c0, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glCombinerStageParameterfvNV(s, c0, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glGetCombinerStageParameterfvNV(s, c0, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glGetIntegerv(GL_NUM_GENERAL_COMBINERS_NV, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glGetFloatv(c0, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glGetCombinerInputParameterivNV(s, GL_RGB, a, GL_COMBINER_INPUT_NV, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glGetCombinerOutputParameterfvNV(s, GL_RGB, GL_COMBINER_SCALE_NV, nullptr));
  EXPECT_REFUSED(GL_INVALID_VALUE, glGetFinalCombinerInputParameterivNV(a, GL_COMBINER_INPUT_NV, nullptr));
}

TEST_F(GlErrors, KeepTheFirstUntilAsked) {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 0);
  glEnable(kNoSuchEnum);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 2) << "a pending error must not stop later commands";
  EXPECT_EQ(context.error(), GlError::invalid_value);
  EXPECT_EQ(glGetError(), GL_INVALID_VALUE);
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
  glEnable(kNoSuchEnum);
  EXPECT_EQ(glGetError(), GL_INVALID_ENUM);
}

}  // namespace
}  // namespace ninebit::gl
