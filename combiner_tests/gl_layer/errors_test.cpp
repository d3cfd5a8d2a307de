// The errors of the extensions' entry points, through glGetError.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/combiner_commands.h"
#include "ninebit/language/gl_nv.h"

namespace ninebit::test {
namespace {

constexpr GLenum kNone = GL_NO_ERROR, kEnum = GL_INVALID_ENUM, kValue = GL_INVALID_VALUE, kOp = GL_INVALID_OPERATION;

// Checks one command: its error, and that a wrong one changes nothing.
class ErrorChecker {
 public:
  explicit ErrorChecker(const HardwareProfile& profile) : profile_(profile) {}
  template <class Command>
  void operator()(GLenum expected, const char* what, const Command& command) {
    const auto before = read_state(kLayerFunctions, profile_);
    EXPECT_EQ(glGetError(), kNone) << what << ": an error of before";
    command();
    EXPECT_EQ(glGetError(), expected) << what;
    EXPECT_EQ(glGetError(), kNone) << what << ": the error is there twice";
    if (expected == kNone) return;
    EXPECT_EQ(read_state(kLayerFunctions, profile_), before) << what << " changes the state";
  }

 private:
  HardwareProfile profile_;
};

#define CHECK_ERROR(expected, command) check(expected, #command, [&] { command; })

TEST(LayerErrors, Parameters) {
  NINEBIT_GL_CONTEXT(context, profiles::geforce2);
  ErrorChecker check(profiles::geforce2);
  const GLfloat floats[4]{0.5F, 0.25F, 1.0F, 2.0F};
  const GLint integers[4]{2, 2, 2, 2};
  CHECK_ERROR(kNone, glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, floats));
  CHECK_ERROR(kNone, glCombinerParameterivNV(GL_CONSTANT_COLOR1_NV, integers));
  CHECK_ERROR(kNone, glCombinerParameterivNV(GL_NUM_GENERAL_COMBINERS_NV, integers));
  CHECK_ERROR(kNone, glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, 0));
  CHECK_ERROR(kNone, glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, 1.0F));
  CHECK_ERROR(kEnum, glCombinerParameteriNV(GL_CONSTANT_COLOR0_NV, 1));
  CHECK_ERROR(kEnum, glCombinerParameterfNV(GL_CONSTANT_COLOR1_NV, 1.0F));
  CHECK_ERROR(kEnum, glCombinerParameteriNV(GL_MAX_GENERAL_COMBINERS_NV, 1));
  CHECK_ERROR(kEnum, glCombinerParameterfvNV(GL_REGISTER_COMBINERS_NV, floats));
  CHECK_ERROR(kValue, glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 0));
  CHECK_ERROR(kValue, glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, -1));
  CHECK_ERROR(kValue, glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, 3.0F));
  CHECK_ERROR(kValue, glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, nullptr));
  CHECK_ERROR(kValue, glCombinerParameterivNV(GL_NUM_GENERAL_COMBINERS_NV, nullptr));
  // A name that is not one has no values: nothing is read behind the pointer.
  CHECK_ERROR(kEnum, glCombinerParameterfvNV(GL_SPARE0_NV, reinterpret_cast<const GLfloat*>(16)));
  CHECK_ERROR(kEnum, glCombinerParameterivNV(GL_SPARE0_NV, reinterpret_cast<const GLint*>(16)));
}

TEST(LayerErrors, InputsOfGeneralCombiners) {
  NINEBIT_GL_CONTEXT(context, profiles::geforce2);
  ErrorChecker check(profiles::geforce2);
  const auto input = [](GLenum stage, GLenum portion, GLenum variable, GLenum reg, GLenum mapping, GLenum usage) {
    glCombinerInputNV(stage, portion, variable, reg, mapping, usage);
  };
  const GLenum id = GL_UNSIGNED_IDENTITY_NV, a = GL_VARIABLE_A_NV, c0 = GL_COMBINER0_NV;
  CHECK_ERROR(kNone, input(c0, GL_RGB, a, GL_FOG, GL_SIGNED_NEGATE_NV, GL_RGB));
  CHECK_ERROR(kNone, input(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_FOG, id, GL_BLUE));
  CHECK_ERROR(kNone, input(c0, GL_RGB, a, GL_TEXTURE1, id, GL_ALPHA));
  CHECK_ERROR(kEnum, input(GL_COMBINER2_NV, GL_RGB, a, GL_ZERO, id, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGBA, a, GL_ZERO, id, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGB, GL_VARIABLE_E_NV, GL_ZERO, id, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGB, a, GL_ONE, id, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGB, a, GL_TEXTURE2, id, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGB, a, GL_E_TIMES_F_NV, id, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGB, a, GL_SPARE0_PLUS_SECONDARY_COLOR_NV, id, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGB, a, GL_ZERO, GL_SCALE_BY_TWO_NV, GL_RGB));
  CHECK_ERROR(kEnum, input(c0, GL_RGB, a, GL_ZERO, id, GL_RGBA));
  CHECK_ERROR(kOp, input(c0, GL_ALPHA, a, GL_ZERO, id, GL_RGB));
  CHECK_ERROR(kOp, input(c0, GL_RGB, a, GL_ZERO, id, GL_BLUE));
  CHECK_ERROR(kOp, input(c0, GL_RGB, a, GL_FOG, id, GL_ALPHA));
  CHECK_ERROR(kOp, input(c0, GL_ALPHA, a, GL_FOG, id, GL_ALPHA));
}

TEST(LayerErrors, OutputsOfGeneralCombiners) {
  NINEBIT_GL_CONTEXT(context, profiles::geforce2);
  ErrorChecker check(profiles::geforce2);
  const GLenum none = GL_DISCARD_NV, s0 = GL_SPARE0_NV;
  const auto output = [](GLenum portion, GLenum ab, GLenum cd, GLenum sum, GLenum scale, GLenum bias, int dots = 0) {
    glCombinerOutputNV(GL_COMBINER0_NV, portion, ab, cd, sum, scale, bias, (dots & 1) != 0, (dots & 2) != 0, GL_FALSE);
  };
  CHECK_ERROR(kNone,
              output(GL_RGB, s0, GL_SPARE1_NV, GL_TEXTURE0, GL_SCALE_BY_TWO_NV, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV));
  CHECK_ERROR(kNone, output(GL_RGB, none, none, none, GL_NONE, GL_NONE, 3));
  CHECK_ERROR(kNone, output(GL_RGB, s0, none, GL_SPARE1_NV, GL_NONE, GL_NONE, 1));
  CHECK_ERROR(kEnum, output(GL_RGBA, none, none, s0, GL_NONE, GL_NONE));
  CHECK_ERROR(kEnum, output(GL_RGB, GL_FOG, none, s0, GL_NONE, GL_NONE));
  CHECK_ERROR(kEnum, output(GL_RGB, none, GL_ZERO, s0, GL_NONE, GL_NONE));
  CHECK_ERROR(kEnum, output(GL_RGB, none, none, GL_CONSTANT_COLOR0_NV, GL_NONE, GL_NONE));
  CHECK_ERROR(kEnum, output(GL_RGB, none, none, s0, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV, GL_NONE));
  CHECK_ERROR(kEnum, output(GL_RGB, none, none, s0, GL_NONE, GL_SCALE_BY_TWO_NV));
  CHECK_ERROR(kOp, output(GL_RGB, s0, s0, none, GL_NONE, GL_NONE));
  CHECK_ERROR(kOp, output(GL_ALPHA, s0, none, s0, GL_NONE, GL_NONE));
  CHECK_ERROR(kOp, output(GL_RGB, none, none, s0, GL_SCALE_BY_ONE_HALF_NV, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV));
  CHECK_ERROR(kOp, output(GL_ALPHA, none, none, s0, GL_SCALE_BY_FOUR_NV, GL_BIAS_BY_NEGATIVE_ONE_HALF_NV));
  CHECK_ERROR(kValue, output(GL_ALPHA, none, none, s0, GL_NONE, GL_NONE, 1));
  CHECK_ERROR(kValue, output(GL_ALPHA, none, none, s0, GL_NONE, GL_NONE, 2));
}

TEST(LayerErrors, FinalCombiner) {
  NINEBIT_GL_CONTEXT(context, profiles::geforce2);
  ErrorChecker check(profiles::geforce2);
  const GLenum id = GL_UNSIGNED_IDENTITY_NV, sum = GL_SPARE0_PLUS_SECONDARY_COLOR_NV, product = GL_E_TIMES_F_NV;
  const auto input = [](GLenum variable, GLenum reg, GLenum mapping, GLenum usage) {
    glFinalCombinerInputNV(variable, reg, mapping, usage);
  };
  CHECK_ERROR(kNone, input(GL_VARIABLE_A_NV, product, GL_UNSIGNED_INVERT_NV, GL_RGB));
  CHECK_ERROR(kNone, input(GL_VARIABLE_D_NV, sum, id, GL_RGB));
  CHECK_ERROR(kNone, input(GL_VARIABLE_G_NV, GL_FOG, id, GL_BLUE));
  CHECK_ERROR(kNone, input(GL_VARIABLE_F_NV, GL_FOG, id, GL_ALPHA));
  CHECK_ERROR(kEnum, input(GL_VARIABLE_A_NV - 1, GL_ZERO, id, GL_RGB));
  CHECK_ERROR(kEnum, input(GL_VARIABLE_A_NV, GL_DISCARD_NV, id, GL_RGB));
  CHECK_ERROR(kEnum, input(GL_VARIABLE_A_NV, GL_ZERO, GL_SIGNED_IDENTITY_NV, GL_RGB));
  CHECK_ERROR(kEnum, input(GL_VARIABLE_A_NV, GL_ZERO, id, GL_NONE));
  for (const GLenum variable : std::initializer_list<GLenum>{GL_VARIABLE_E_NV, GL_VARIABLE_F_NV, GL_VARIABLE_G_NV}) {
    const GLenum right = variable == GL_VARIABLE_G_NV ? GL_ALPHA : GL_RGB;
    CHECK_ERROR(kOp, input(variable, product, id, right));
    CHECK_ERROR(kOp, input(variable, sum, id, right));
  }
  CHECK_ERROR(kOp, input(GL_VARIABLE_A_NV, sum, id, GL_RGB));
  CHECK_ERROR(kOp, input(GL_VARIABLE_B_NV, GL_ZERO, id, GL_BLUE));
  CHECK_ERROR(kOp, input(GL_VARIABLE_G_NV, GL_ZERO, id, GL_RGB));
  CHECK_ERROR(kOp, input(GL_VARIABLE_B_NV, product, id, GL_ALPHA));
  CHECK_ERROR(kOp, input(GL_VARIABLE_C_NV, sum, id, GL_ALPHA));
}

TEST(LayerErrors, PerStageConstantsAndGets) {
  const GLfloat floats[4]{0.5F, 0.25F, 1.0F, 2.0F};
  GLfloat got[4]{-1, -1, -1, -1};
  GLint integer = -1;
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    NINEBIT_GL_CONTEXT(context, profile);
    ErrorChecker check(profile);
    const bool second = profile.per_stage_constants;
    const GLenum past = GL_COMBINER0_NV + static_cast<GLenum>(profile.general_combiners);
    CHECK_ERROR(second ? kNone : kEnum, glCombinerStageParameterfvNV(GL_COMBINER1_NV, GL_CONSTANT_COLOR0_NV, floats));
    CHECK_ERROR(second ? kNone : kEnum, glGetCombinerStageParameterfvNV(GL_COMBINER1_NV, GL_CONSTANT_COLOR0_NV, got));
    CHECK_ERROR(second ? kNone : kEnum, glEnable(GL_PER_STAGE_CONSTANTS_NV));
    CHECK_ERROR(second ? kNone : kEnum, glDisable(GL_PER_STAGE_CONSTANTS_NV));
    CHECK_ERROR(kEnum, glCombinerStageParameterfvNV(past, GL_CONSTANT_COLOR0_NV, reinterpret_cast<const GLfloat*>(16)));
    CHECK_ERROR(kEnum,
                glCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_SPARE0_NV, reinterpret_cast<const GLfloat*>(16)));
    CHECK_ERROR(kEnum, glGetCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_COMBINER_INPUT_NV, got));
    CHECK_ERROR(kEnum, glGetCombinerInputParameterivNV(past, GL_RGB, GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, &integer));
    CHECK_ERROR(kEnum, glGetCombinerInputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_E_NV, GL_COMBINER_INPUT_NV,
                                                       &integer));
    CHECK_ERROR(kEnum, glGetCombinerOutputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_COMBINER_INPUT_NV, &integer));
    CHECK_ERROR(kEnum, glGetFinalCombinerInputParameterivNV(GL_VARIABLE_G_NV, GL_COMBINER_SCALE_NV, &integer));
    EXPECT_EQ(integer, -1);
    CHECK_ERROR(kValue, glGetFinalCombinerInputParameterfvNV(GL_VARIABLE_G_NV, GL_COMBINER_INPUT_NV, nullptr));
  }
}

// The layer's entry points against the library's, whose errors have tests of their own.
TEST(LayerErrors, RandomCommandsAreTheLibrarys) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    NINEBIT_GL_CONTEXT(context, profile);
    gl::Context library(profile);
    const gl::CurrentContext current(library);
    int errors = 0, right = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      Random random(1999, i);
      const CombinerCommand command = random_command(random, profile, false);
      ASSERT_EQ(execute(kLayerFunctions, command), execute(kLibraryFunctions, command)) << profile.name << ' ' << i;
      const GLenum expected = gl::glGetError();
      ASSERT_EQ(glGetError(), expected) << profile.name << ", command " << i << ", function " << command.function;
      ++(expected == kNone ? right : errors);
      if (i % 64 != 0) continue;
      ASSERT_EQ(read_state(kLayerFunctions, profile), read_state(kLibraryFunctions, profile))
          << profile.name << ' ' << i;
    }
    EXPECT_GT(errors, 4000);
    EXPECT_GT(right, 5000);
  }
}

}  // namespace
}  // namespace ninebit::test
