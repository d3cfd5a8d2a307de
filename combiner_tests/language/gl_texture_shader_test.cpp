// NV_texture_shader's state by GL's calls.
#include <gtest/gtest.h>

#include "ninebit/language/gl_nv.h"

namespace ninebit::test {
namespace {

using namespace ninebit::gl;  // NOLINT(google-build-using-namespace): these are OpenGL's names

GLint shader_value(GLenum pname) {
  GLint value = -1;
  glGetTexEnviv(GL_TEXTURE_SHADER_NV, pname, &value);
  return value;
}

TEST(GlTextureShader, EveryOperationIsSetWhereItMayStand) {
  for (int unit = 0; unit < kTextureStages; ++unit) {
    for (const TextureOperationInfo& info : texture_operations()) {
      if (info.gl_value == 0 && info.operation != TextureOperation::none) continue;
      Context context(profiles::nv2a);
      const CurrentContext current(context);
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, info.gl_value);
      const bool fits = unit >= info.first && unit <= info.last;
      EXPECT_EQ(glGetError(), fits ? GL_NO_ERROR : GL_INVALID_OPERATION) << info.name << " on unit " << unit;
      EXPECT_EQ(shader_value(GL_SHADER_OPERATION_NV), fits ? info.gl_value : 0) << info.name;
      const auto set = context.texture_shader().stage[static_cast<std::size_t>(unit)].operation;
      EXPECT_EQ(set, fits ? info.operation : TextureOperation::none);
    }
  }
}

TEST(GlTextureShader, ValuesComeBack) {
  Context context(profiles::nv2a);
  const CurrentContext current(context);
  glEnable(GL_TEXTURE_SHADER_NV);
  EXPECT_EQ(glIsEnabled(GL_TEXTURE_SHADER_NV), GL_TRUE);
  glActiveTextureARB(GL_TEXTURE2_ARB);
  const GLfloat matrix[]{0.5F, 1.5F, -2.0F, 4.0F}, eye[]{1.0F, 2.0F, 3.0F}, scale[]{0.75F};
  const GLint modes[]{GL_LESS, GL_GEQUAL, GL_GEQUAL, GL_LESS};
  glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, matrix);
  glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CONST_EYE_NV, eye);
  glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_SCALE_NV, scale);
  glTexEnvf(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_BIAS_NV, 0.25F);
  glTexEnviv(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, modes);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE1);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV, GL_EXPAND_NORMAL_NV);
  EXPECT_EQ(glGetError(), GL_NO_ERROR);
  const TextureStage& stage = context.texture_shader().stage[2];
  EXPECT_EQ(stage.matrix, (std::array{0.5F, 1.5F, -2.0F, 4.0F}));
  EXPECT_EQ(stage.eye, (std::array{1.0F, 2.0F, 3.0F}));
  EXPECT_EQ(stage.scale, 0.75F);
  EXPECT_EQ(stage.bias, 0.25F);
  EXPECT_EQ(stage.previous, 1);
  EXPECT_EQ(stage.mapping, DotMapping::minus1_to_1_d3d);
  EXPECT_EQ(stage.cull, (std::array{CullMode::kills_not_negative, CullMode::kills_negative, CullMode::kills_negative,
                                    CullMode::kills_not_negative}));
  GLfloat values[4]{};
  glGetTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, values);
  EXPECT_EQ(values[3], 4.0F);
  glGetTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CONST_EYE_NV, values);
  EXPECT_EQ(values[2], 3.0F);
  EXPECT_EQ(shader_value(GL_PREVIOUS_TEXTURE_INPUT_NV), static_cast<GLint>(GL_TEXTURE1));
  EXPECT_EQ(shader_value(GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV), static_cast<GLint>(GL_EXPAND_NORMAL_NV));
  glDisable(GL_TEXTURE_SHADER_NV);
  EXPECT_FALSE(context.texture_shader().enabled);
}

TEST(GlTextureShader, RefusedCallsLeaveTheState) {
  Context context(profiles::nv2a);
  const CurrentContext current(context);
  glActiveTexture(GL_TEXTURE1);
  const TextureShaderState before = context.texture_shader();
  const auto expect_error = [&](GLenum error, const char* what) {
    EXPECT_EQ(glGetError(), error) << what;
    EXPECT_EQ(context.texture_shader(), before) << what;
  };
  for (const GLint value : {0x8523, -1, 0x7FFFFFFF}) {
    glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, value);
    expect_error(GL_INVALID_ENUM, "operation");
  }
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, 0x86EE);  // DOT_PRODUCT_TEXTURE_2D_NV
  expect_error(GL_INVALID_OPERATION, "an operation of later units");
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE1);
  expect_error(GL_INVALID_OPERATION, "the unit itself");
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE3 + 1);
  expect_error(GL_INVALID_ENUM, "a unit that the chip does not have");
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, GL_LESS);
  expect_error(GL_INVALID_ENUM, "a vector as one value");
  const GLint wrong[]{GL_LESS, GL_LESS, GL_LESS, 0x0207};
  glTexEnviv(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, wrong);
  expect_error(GL_INVALID_ENUM, "one wrong mode");
  glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CONST_EYE_NV, nullptr);
  expect_error(GL_INVALID_VALUE, "null");
  glTexEnvi(0x2300, 0x2200, 1);  // GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE
  expect_error(GL_INVALID_ENUM, "another target");
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_CONSISTENT_NV, 1);
  expect_error(GL_INVALID_ENUM, "a value that can only be read");
  glActiveTexture(GL_TEXTURE3 + 1);
  EXPECT_EQ(glGetError(), GL_INVALID_ENUM);
  EXPECT_EQ(context.active_texture(), 1);
}

TEST(GlTextureShader, AGeForce2HasNone) {
  Context context(profiles::geforce2);
  const CurrentContext current(context);
  glEnable(GL_TEXTURE_SHADER_NV);
  EXPECT_EQ(glGetError(), GL_INVALID_ENUM);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, 0x0DE1);
  EXPECT_EQ(glGetError(), GL_INVALID_ENUM);
}

}  // namespace
}  // namespace ninebit::test
