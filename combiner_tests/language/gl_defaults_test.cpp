// The answers of a new context: the default state of both extensions.
#include <array>
#include <string>

#include "combiner_tests/language/gl_test_support.h"

namespace ninebit::gl {
namespace {

class GlDefaults : public ::testing::TestWithParam<const HardwareProfile*> {
 protected:
  GlDefaults() : context_(*GetParam()), current_(context_) {}

  Context context_;

 private:
  CurrentContext current_;
};

TEST_P(GlDefaults, OfTheParameters) {
  const bool is_nv2a = GetParam() == &profiles::nv2a;
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  EXPECT_EQ(get_integer(GL_REGISTER_COMBINERS_NV), 0);
  EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 1);
  EXPECT_EQ(get_integer(GL_MAX_GENERAL_COMBINERS_NV), is_nv2a ? 8 : 2);
  EXPECT_EQ(get_integer(GL_COLOR_SUM_CLAMP_NV), 1);
  for (const GLenum pname : {GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV}) {
    std::array<GLint, 4> integers{-1, -1, -1, -1};
    std::array<GLfloat, 4> floats{-1, -1, -1, -1};
    glGetIntegerv(pname, integers.data());
    glGetFloatv(pname, floats.data());
    EXPECT_EQ(integers, (std::array<GLint, 4>{}));
    EXPECT_EQ(floats, (std::array<GLfloat, 4>{}));
  }
  GLfloat value = -1;
  glGetFloatv(GL_NUM_GENERAL_COMBINERS_NV, &value);
  EXPECT_EQ(value, 1.0F);
  glGetFloatv(GL_MAX_GENERAL_COMBINERS_NV, &value);
  EXPECT_EQ(value, is_nv2a ? 8.0F : 2.0F);
  glGetFloatv(GL_COLOR_SUM_CLAMP_NV, &value);
  EXPECT_EQ(value, 1.0F);
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
}

TEST_P(GlDefaults, OfEveryGeneralCombiner) {
  for (GLenum i = 0; i < static_cast<GLenum>(get_integer(GL_MAX_GENERAL_COMBINERS_NV)); ++i) {
    for (const GLenum portion : {GL_RGB, GL_ALPHA}) {
      SCOPED_TRACE("combiner " + std::to_string(i) + (portion == GL_RGB ? " RGB" : " ALPHA"));
      const GLenum stage = GL_COMBINER0_NV + i, usage = portion;
      EXPECT_EQ(get_general_input(stage, portion, GL_VARIABLE_A_NV),
                (InputArguments{GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, usage}));
      EXPECT_EQ(get_general_input(stage, portion, GL_VARIABLE_B_NV),
                (InputArguments{GL_ZERO, GL_UNSIGNED_INVERT_NV, usage}));
      EXPECT_EQ(get_general_input(stage, portion, GL_VARIABLE_C_NV),
                (InputArguments{GL_ZERO, GL_UNSIGNED_IDENTITY_NV, usage}));
      EXPECT_EQ(get_general_input(stage, portion, GL_VARIABLE_D_NV),
                (InputArguments{GL_ZERO, GL_UNSIGNED_IDENTITY_NV, usage}));
      EXPECT_EQ(get_output(stage, portion), (OutputArguments{GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE,
                                                             GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE}));
    }
  }
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
}

TEST_P(GlDefaults, OfTheFinalCombiner) {
  const auto unsigned_identity = [](GLenum input, GLenum usage) {
    return InputArguments{input, GL_UNSIGNED_IDENTITY_NV, usage};
  };
  EXPECT_EQ(get_final_input(GL_VARIABLE_A_NV), unsigned_identity(GL_FOG, GL_ALPHA));
  EXPECT_EQ(get_final_input(GL_VARIABLE_B_NV), unsigned_identity(GL_SPARE0_PLUS_SECONDARY_COLOR_NV, GL_RGB));
  EXPECT_EQ(get_final_input(GL_VARIABLE_C_NV), unsigned_identity(GL_FOG, GL_RGB));
  EXPECT_EQ(get_final_input(GL_VARIABLE_D_NV), unsigned_identity(GL_ZERO, GL_RGB));
  EXPECT_EQ(get_final_input(GL_VARIABLE_E_NV), unsigned_identity(GL_ZERO, GL_RGB));
  EXPECT_EQ(get_final_input(GL_VARIABLE_F_NV), unsigned_identity(GL_ZERO, GL_RGB));
  EXPECT_EQ(get_final_input(GL_VARIABLE_G_NV), unsigned_identity(GL_SPARE0_NV, GL_ALPHA));
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
}

TEST_P(GlDefaults, AreAValidState) {
  EXPECT_TRUE(validate(context_.state(), context_.profile()).empty());
}

INSTANTIATE_TEST_SUITE_P(Profiles, GlDefaults, ::testing::Values(&profiles::geforce2, &profiles::nv2a), profile_name);

TEST_F(GlNv2aTest, DefaultsOfThePerStageConstants) {
  EXPECT_EQ(glIsEnabled(GL_PER_STAGE_CONSTANTS_NV), GL_FALSE);
  EXPECT_EQ(get_integer(GL_PER_STAGE_CONSTANTS_NV), 0);
  for (GLenum i = 0; i < 8; ++i) {
    for (const GLenum pname : {GL_CONSTANT_COLOR0_NV, GL_CONSTANT_COLOR1_NV}) {
      std::array<GLfloat, 4> color{-1, -1, -1, -1};
      glGetCombinerStageParameterfvNV(GL_COMBINER0_NV + i, pname, color.data());
      EXPECT_EQ(color, (std::array<GLfloat, 4>{}));
    }
  }
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
}

}  // namespace
}  // namespace ninebit::gl
