// Which error glGetError returns: the first, whether the driver or the layer raised it; and commands between glBegin
// and glEnd.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/combiner_commands.h"
#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

// Three errors of the driver and three of the layer, by the error.
void fail_in_driver(GLenum error) {
  if (error == GL_INVALID_ENUM) return glCullFace(GL_RGBA);
  if (error == GL_INVALID_VALUE) return glLineWidth(-1.0F);
  glEndList();
}

void fail_in_layer(GLenum error) {
  if (error == GL_INVALID_ENUM) return glCombinerParameteriNV(GL_SPARE0_NV, 1);
  if (error == GL_INVALID_VALUE) return glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 99);
  glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_BLUE);
}

constexpr GLenum kErrors[]{GL_INVALID_ENUM, GL_INVALID_VALUE, GL_INVALID_OPERATION};

TEST(LayerPendingErrors, TheFirstIsKept) {
  NINEBIT_GL_CONTEXT(context);
  for (const GLenum first : kErrors) {
    for (const GLenum second : kErrors) {
      for (int order = 0; order < 4; ++order) {
        (order & 1) != 0 ? fail_in_driver(first) : fail_in_layer(first);
        (order & 2) != 0 ? fail_in_driver(second) : fail_in_layer(second);
        EXPECT_EQ(glGetError(), first) << "order " << order << ", then " << second;
        EXPECT_EQ(glGetError(), kNoError) << "order " << order << ", then " << second;
      }
    }
  }
}

TEST(LayerPendingErrors, AnErrorBeforeBeginIsTheFirst) {
  NINEBIT_GL_CONTEXT(context);
  for (const GLenum first : kErrors) {
    for (const bool by_driver : {false, true}) {
      by_driver ? fail_in_driver(first) : fail_in_layer(first);
      glBegin(GL_POINTS);
      glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, 1);
      glEnd();
      EXPECT_EQ(glGetError(), first) << by_driver;
      EXPECT_EQ(glGetError(), kNoError);
    }
  }
  glBegin(GL_POINTS);
  glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, 1);
  glEnd();
  fail_in_driver(GL_INVALID_VALUE);
  EXPECT_EQ(glGetError(), kInvalidOperation);
}

TEST(LayerPendingErrors, EveryCommandIsRefusedBetweenBeginAndEnd) {
  NINEBIT_GL_CONTEXT(context);
  const auto before = read_state(kLayerFunctions, profiles::nv2a);
  for (int function = 0; function < kCombinerFunctions; ++function) {
    Random random(7, static_cast<std::uint64_t>(function));
    CombinerCommand command;
    do command = random_command(random, profiles::nv2a, false, 1000000);
    while (command.function != function);
    glBegin(GL_TRIANGLES);
    const auto written = execute(kLayerFunctions, command);
    glEnd();
    EXPECT_EQ(glGetError(), kInvalidOperation) << "function " << function;
    EXPECT_EQ(glGetError(), kNoError) << "function " << function;
    EXPECT_EQ(written, (std::array<GLfloat, 4>{-1, -1, -1, -1})) << "function " << function;
  }
  GLint value = -1;
  GLfloat values[4]{-1};
  glBegin(GL_TRIANGLES);
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  glGetIntegerv(GL_NUM_GENERAL_COMBINERS_NV, &value);
  glGetFloatv(GL_CONSTANT_COLOR0_NV, values);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, GL_LESS);
  glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, nullptr);
  EXPECT_EQ(glGetError(), kNoError);  // an error itself there
  glEnd();
  EXPECT_EQ(value, -1);
  EXPECT_EQ(values[0], -1.0F);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  EXPECT_EQ(glGetError(), kNoError);
  EXPECT_EQ(read_state(kLayerFunctions, profiles::nv2a), before);
}

// A glBegin that the driver refuses begins nothing.
TEST(LayerPendingErrors, ARefusedBeginBeginsNothing) {
  NINEBIT_GL_CONTEXT(context);
  glBegin(0x1234);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);
  EXPECT_EQ(glGetError(), kNoError);
  EXPECT_EQ(integer_of(GL_NUM_GENERAL_COMBINERS_NV), 3);
}

}  // namespace
}  // namespace ninebit::test
