// The errors of the extensions' entry points, through glGetError. Their rules are the library's: gl_errors_test.cpp and
// gl_legality_test.cpp of its room.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/combiner_commands.h"
#include "ninebit/language/gl_nv.h"

namespace ninebit::test {
namespace {

// Checks one command: its error, and that a wrong one changes nothing.
class ErrorChecker {
 public:
  explicit ErrorChecker(const HardwareProfile& profile) : profile_(profile) {}
  template <class Command>
  void operator()(GLenum expected, const char* what, const Command& command) {
    const auto before = read_state(kLayerFunctions, profile_);
    EXPECT_EQ(glGetError(), kNoError) << what << ": an error of before";
    command();
    EXPECT_EQ(glGetError(), expected) << what;
    EXPECT_EQ(glGetError(), kNoError) << what << ": the error is there twice";
    if (expected == kNoError) return;
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
  CHECK_ERROR(kNoError, glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, floats));
  CHECK_ERROR(kInvalidEnum, glCombinerParameteriNV(GL_CONSTANT_COLOR0_NV, 1));
  CHECK_ERROR(kInvalidValue, glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 0));
  CHECK_ERROR(kInvalidValue, glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, nullptr));
  CHECK_ERROR(kInvalidValue, glCombinerParameterivNV(GL_NUM_GENERAL_COMBINERS_NV, nullptr));
  CHECK_ERROR(kInvalidOperation, glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_BLUE));
  // A name that is not one has no values: nothing is read behind the pointer.
  CHECK_ERROR(kInvalidEnum, glCombinerParameterfvNV(GL_SPARE0_NV, reinterpret_cast<const GLfloat*>(16)));
  CHECK_ERROR(kInvalidEnum, glCombinerParameterivNV(GL_SPARE0_NV, reinterpret_cast<const GLint*>(16)));
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
    CHECK_ERROR(second ? kNoError : kInvalidEnum,
                glCombinerStageParameterfvNV(GL_COMBINER1_NV, GL_CONSTANT_COLOR0_NV, floats));
    CHECK_ERROR(second ? kNoError : kInvalidEnum,
                glGetCombinerStageParameterfvNV(GL_COMBINER1_NV, GL_CONSTANT_COLOR0_NV, got));
    CHECK_ERROR(second ? kNoError : kInvalidEnum, glEnable(GL_PER_STAGE_CONSTANTS_NV));
    CHECK_ERROR(second ? kNoError : kInvalidEnum, glDisable(GL_PER_STAGE_CONSTANTS_NV));
    CHECK_ERROR(kInvalidEnum,
                glCombinerStageParameterfvNV(past, GL_CONSTANT_COLOR0_NV, reinterpret_cast<const GLfloat*>(16)));
    CHECK_ERROR(kInvalidEnum,
                glCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_SPARE0_NV, reinterpret_cast<const GLfloat*>(16)));
    CHECK_ERROR(kInvalidEnum, glGetCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_COMBINER_INPUT_NV, got));
    CHECK_ERROR(kInvalidEnum,
                glGetCombinerInputParameterivNV(past, GL_RGB, GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, &integer));
    CHECK_ERROR(kInvalidEnum, glGetCombinerInputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_E_NV,
                                                              GL_COMBINER_INPUT_NV, &integer));
    CHECK_ERROR(kInvalidEnum,
                glGetCombinerOutputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_COMBINER_INPUT_NV, &integer));
    CHECK_ERROR(kInvalidEnum, glGetFinalCombinerInputParameterivNV(GL_VARIABLE_G_NV, GL_COMBINER_SCALE_NV, &integer));
    EXPECT_EQ(integer, -1);
    CHECK_ERROR(kInvalidValue, glGetFinalCombinerInputParameterfvNV(GL_VARIABLE_G_NV, GL_COMBINER_INPUT_NV, nullptr));
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
      ++(expected == kNoError ? right : errors);
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
