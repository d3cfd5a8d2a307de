// Which context a call speaks to.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "combiner_tests/language/gl_test_support.h"

namespace ninebit::gl {
namespace {

TEST(GlContext, ThereIsNoneAtFirstAndCallsAreHarmless) {
  ASSERT_EQ(CurrentContext::get(), nullptr);
  constexpr std::array<GLfloat, 4> color{0.1F, 0.2F, 0.3F, 0.4F};
  constexpr std::array<GLint, 4> ints{1, 2, 3, 4};
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, 2.0F);
  glCombinerParameterivNV(GL_CONSTANT_COLOR0_NV, ints.data());
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, color.data());
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE, GL_NONE, GL_FALSE,
                     GL_FALSE, GL_FALSE);
  glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_CONSTANT_COLOR0_NV, color.data());
  glEnable(GL_REGISTER_COMBINERS_NV);
  glDisable(GL_REGISTER_COMBINERS_NV);
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);

  GLint integer = 77;
  GLfloat real = 77;
  glGetIntegerv(GL_NUM_GENERAL_COMBINERS_NV, &integer);
  glGetFloatv(GL_NUM_GENERAL_COMBINERS_NV, &real);
  glGetCombinerInputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, &integer);
  glGetCombinerInputParameterfvNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, &real);
  glGetCombinerOutputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_COMBINER_SCALE_NV, &integer);
  glGetCombinerOutputParameterfvNV(GL_COMBINER0_NV, GL_RGB, GL_COMBINER_SCALE_NV, &real);
  glGetFinalCombinerInputParameterivNV(GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, &integer);
  glGetFinalCombinerInputParameterfvNV(GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, &real);
  glGetCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_CONSTANT_COLOR0_NV, &real);
  EXPECT_EQ(integer, 77);
  EXPECT_EQ(real, 77.0F);
  EXPECT_EQ(glGetError(), GL_INVALID_OPERATION);
  EXPECT_EQ(glGetError(), GL_INVALID_OPERATION) << "it stays true until a context is made current";
}

TEST(GlContext, NestsAndComesBack) {
  Context outer, inner(profiles::nv2a);
  {
    const CurrentContext first(outer);
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
    glEnable(GL_FOG);
    {
      const CurrentContext second(inner);
      EXPECT_EQ(CurrentContext::get(), &inner);
      EXPECT_EQ(glGetError(), GL_NO_ERROR) << "an error belongs to its context";
      EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 1);
      glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 7);
      glEnable(GL_REGISTER_COMBINERS_NV);
      {
        const CurrentContext again(outer);
        EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 2);
      }
      EXPECT_EQ(CurrentContext::get(), &inner);
    }
    EXPECT_EQ(CurrentContext::get(), &outer);
    EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 2);
    EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
    EXPECT_EQ(glGetError(), GL_INVALID_ENUM);
  }
  EXPECT_EQ(CurrentContext::get(), nullptr);
  EXPECT_EQ(outer.state().num_general_combiners, 2);
  EXPECT_EQ(inner.state().num_general_combiners, 7);
  EXPECT_TRUE(inner.register_combiners_enabled());
}

TEST(GlContext, IsAValue) {
  Context original;
  const CurrentContext current(original);
  glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, GL_FALSE);
  const Context copy = original;
  glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, GL_TRUE);
  EXPECT_FALSE(copy.state().color_sum_clamp);
  EXPECT_TRUE(original.state().color_sum_clamp);
}

TEST(GlContext, KeepsAProfileThatItsMakerChanged) {
  HardwareProfile profile = profiles::geforce2;
  profile.general_combiners.value = 5;
  Context context(profile);
  profile.general_combiners.value = 1;
  const CurrentContext current(context);
  EXPECT_EQ(get_integer(GL_MAX_GENERAL_COMBINERS_NV), 5);
  glCombinerInputNV(GL_COMBINER4_NV, GL_RGB, GL_VARIABLE_A_NV, GL_FOG, GL_SIGNED_NEGATE_NV, GL_RGB);
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
  glCombinerInputNV(GL_COMBINER5_NV, GL_RGB, GL_VARIABLE_A_NV, GL_FOG, GL_SIGNED_NEGATE_NV, GL_RGB);
  EXPECT_EQ(glGetError(), GL_INVALID_ENUM);
}

TEST(GlContext, IsCurrentOnOneThreadOnly) {
  Context here;
  const CurrentContext current(here);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);

  std::atomic<bool> none{false};
  std::thread([&none] { none = CurrentContext::get() == nullptr && glGetError() == GL_INVALID_OPERATION; }).join();
  EXPECT_TRUE(none) << "a new thread has no current context";

  constexpr GLint rounds = 20000;
  std::array<Context, 2> contexts{Context(profiles::nv2a), Context(profiles::nv2a)};
  std::array<GLint, 2> wrong{};
  const auto work = [&](std::size_t i) {
    const CurrentContext mine(contexts[i]);
    for (GLint round = 0; round < rounds; ++round) {
      const GLint number = 1 + (round * static_cast<GLint>(i + 1)) % 8;
      glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, number);
      if (get_integer(GL_NUM_GENERAL_COMBINERS_NV) != number) ++wrong[i];
    }
  };
  std::thread one(work, 0), two(work, 1);
  one.join();
  two.join();
  EXPECT_EQ(wrong[0], 0);
  EXPECT_EQ(wrong[1], 0);
  EXPECT_EQ(CurrentContext::get(), &here);
  EXPECT_EQ(get_integer(GL_NUM_GENERAL_COMBINERS_NV), 2);
}

}  // namespace
}  // namespace ninebit::gl
