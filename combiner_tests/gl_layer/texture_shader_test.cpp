// NV_texture_shader: the operations that depend on no other texture unit, and its state.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

constexpr GLenum kShader = GL_TEXTURE_SHADER_NV;

GLint shader_value(GLenum name) {
  GLint value = -1;
  glGetTexEnviv(kShader, name, &value);
  return value;
}

void set_operation(GLint operation) {
  glTexEnvi(kShader, GL_SHADER_OPERATION_NV, operation);
}

// Draws the square with a texture coordinate of unit 0.
Pixel drawn_with(GLfloat s, GLfloat t, GLfloat r, GLfloat q) {
  clear_picture();
  draw_corners([=](GLfloat x, GLfloat y) {
    glTexCoord4f(s, t, r, q);
    glVertex2f(x, y);
  });
  return center_pixel();
}

void make_textures() {
  const std::uint8_t two[]{20, 21, 22, 23}, three[]{30, 31, 32, 33}, cube[]{40, 41, 42, 43}, one[]{10, 11, 12, 13};
  const std::uint8_t rectangle[]{50, 51, 52, 53};
  glTexImage1D(GL_TEXTURE_1D, 0, GL_RGBA8, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, one);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, two);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8, 1, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, three);
  glTexImage2D(GL_TEXTURE_RECTANGLE, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, rectangle);
  for (GLenum face = 0; face < 6; ++face) {
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, cube);
  }
  for (const int target : {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP}) {
    glTexParameteri(static_cast<GLenum>(target), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  }
}

// The operation chooses the target; what is enabled does not count.
TEST(LayerTextureShader, TargetsOfOperations) {
  NINEBIT_GL_CONTEXT(context);
  make_textures();
  show_register(GL_TEXTURE0);
  glEnable(kShader);
  const std::pair<GLint, std::uint8_t> operations[]{{GL_TEXTURE_1D, 10},
                                                    {GL_TEXTURE_2D, 20},
                                                    {GL_TEXTURE_3D, 30},
                                                    {GL_TEXTURE_RECTANGLE, 50},
                                                    {GL_TEXTURE_CUBE_MAP, 40}};
  for (const int enabled : {GL_FOG, GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP}) {
    glEnable(static_cast<GLenum>(enabled));
    for (const auto& [operation, red] : operations) {
      set_operation(operation);
      EXPECT_EQ(drawn_with(0.5F, 0.5F, 0.5F, 1.0F)[0], red);
    }
    set_operation(GL_NONE);
    EXPECT_EQ(drawn_with(0.5F, 0.5F, 0.5F, 1.0F), (Pixel{0, 0, 0, 0}));
    glDisable(kShader);
    const std::uint8_t red = enabled == GL_TEXTURE_2D ? 20 : enabled == GL_FOG ? 0 : 40;
    EXPECT_EQ(drawn_with(0.5F, 0.5F, 0.5F, 1.0F)[0], red);
    glEnable(kShader);
  }
}

TEST(LayerTextureShader, PassThroughClampsCoordinates) {
  NINEBIT_GL_CONTEXT(context);
  show_register(GL_TEXTURE0);
  glEnable(kShader);
  set_operation(GL_PASS_THROUGH_NV);
  EXPECT_EQ(drawn_with(0.2F, 0.4F, 0.6F, 0.8F), (Pixel{51, 102, 153, 204}));
  EXPECT_EQ(drawn_with(-1.0F, 2.0F, 0.0F, 1.0F), (Pixel{0, 255, 0, 255}));
}

// GL_GEQUAL lets coordinates of 0 and more pass, GL_LESS those below 0; a fragment needs all four.
TEST(LayerTextureShader, CullFragment) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  glEnable(kShader);
  set_operation(GL_CULL_FRAGMENT_NV);
  for (unsigned modes = 0; modes < 16; ++modes) {
    GLint values[4]{};
    for (unsigned c = 0; c < 4; ++c) values[c] = (modes >> c & 1U) != 0 ? GL_LESS : GL_GEQUAL;
    glTexEnviv(kShader, GL_CULL_MODES_NV, values);
    for (unsigned negative = 0; negative < 16; ++negative) {
      const auto coordinate = [&](unsigned c) { return (negative >> c & 1U) != 0 ? -0.5F : 0.5F; };
      const Pixel expected = modes == negative ? Pixel{255, 0, 0, 255} : Pixel{0, 0, 0, 0};
      EXPECT_EQ(drawn_with(coordinate(0), coordinate(1), coordinate(2), coordinate(3)), expected)
          << "modes " << modes << ", negative " << negative;
    }
  }
  const GLint default_modes[]{GL_GEQUAL, GL_GEQUAL, GL_GEQUAL, GL_GEQUAL};
  glTexEnviv(kShader, GL_CULL_MODES_NV, default_modes);
  EXPECT_EQ(drawn_with(0, 0, 0, 0), (Pixel{255, 0, 0, 255}));
  show_register(GL_TEXTURE0);
  EXPECT_EQ(drawn_with(1, 1, 1, 1), (Pixel{0, 0, 0, 0}));  // its register
}

TEST(LayerTextureShader, Values) {
  NINEBIT_GL_CONTEXT(context);
  for (int i = 0; i < 4; ++i) {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + i));
    EXPECT_EQ(shader_value(GL_SHADER_OPERATION_NV), GL_NONE);
    EXPECT_EQ(shader_value(GL_PREVIOUS_TEXTURE_INPUT_NV), GL_TEXTURE0);
    EXPECT_EQ(shader_value(GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV), GL_UNSIGNED_IDENTITY_NV);
    EXPECT_EQ(shader_value(GL_OFFSET_TEXTURE_SCALE_NV), 1);
    EXPECT_EQ(shader_value(GL_OFFSET_TEXTURE_BIAS_NV), 0);
    EXPECT_EQ(shader_value(GL_SHADER_CONSISTENT_NV), GL_TRUE);
    GLfloat values[5]{9, 9, 9, 9, 9};
    glGetTexEnvfv(kShader, GL_CULL_MODES_NV, values);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(values[c], static_cast<GLfloat>(GL_GEQUAL));
    glGetTexEnvfv(kShader, GL_CONST_EYE_NV, values);
    EXPECT_EQ((std::array{values[0], values[1], values[2]}), (std::array{0.0F, 0.0F, -1.0F}));
    glGetTexEnvfv(kShader, GL_OFFSET_TEXTURE_MATRIX_NV, values);
    EXPECT_EQ((std::array{values[0], values[1], values[2], values[3]}), (std::array{1.0F, 0.0F, 0.0F, 1.0F}));
    EXPECT_EQ(values[4], 9.0F);
    glTexEnvf(kShader, GL_SHADER_OPERATION_NV, static_cast<GLfloat>(GL_PASS_THROUGH_NV));
    const GLint mapping[]{GL_EXPAND_NORMAL_NV};
    glTexEnviv(kShader, GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV, mapping);
    const GLfloat eye[]{1, 2, 3 + static_cast<GLfloat>(i)}, scale[]{0.5F};
    glTexEnvfv(kShader, GL_CONST_EYE_NV, eye);
    glTexEnvfv(kShader, GL_OFFSET_TEXTURE_SCALE_NV, scale);
    EXPECT_EQ(shader_value(GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV), GL_EXPAND_NORMAL_NV);
    glGetTexEnvfv(kShader, GL_OFFSET_TEXTURE_SCALE_NV, values);
    EXPECT_EQ(values[0], 0.5F);
  }
  glActiveTexture(GL_TEXTURE2);
  GLint eye[3]{};
  glGetTexEnviv(kShader, GL_CONST_EYE_NV, eye);
  EXPECT_EQ((std::array{eye[0], eye[1], eye[2]}), (std::array{1, 2, 5}));
  EXPECT_EQ(shader_value(GL_SHADER_OPERATION_NV), GL_PASS_THROUGH_NV);
  EXPECT_EQ(glGetError(), kNoError);
  // The driver's own environments are as ever.
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  GLint mode = 0;
  glGetTexEnviv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &mode);
  EXPECT_EQ(mode, GL_REPLACE);
}

TEST(LayerTextureShader, RefusedValuesLeaveTheState) {
  NINEBIT_GL_CONTEXT(context);
  set_operation(GL_TEXTURE_3D);
  const auto expect_refused = [](GLenum error, const char* what) {
    EXPECT_EQ(glGetError(), error) << what;
    EXPECT_EQ(shader_value(GL_SHADER_OPERATION_NV), GL_TEXTURE_3D) << what;
    EXPECT_EQ(shader_value(GL_PREVIOUS_TEXTURE_INPUT_NV), GL_TEXTURE0) << what;
    GLint modes[4]{};
    glGetTexEnviv(kShader, GL_CULL_MODES_NV, modes);
    for (const GLint mode : modes) EXPECT_EQ(mode, GL_GEQUAL) << what;
  };
  for (const int operation : {GL_REPLACE, -1, 0x7FFFFFFF}) {
    set_operation(operation);
    expect_refused(GL_INVALID_ENUM, "operation");
  }
  for (const int operation : {GL_OFFSET_TEXTURE_2D_NV, GL_DEPENDENT_AR_TEXTURE_2D_NV, GL_DOT_PRODUCT_NV,
                              GL_DOT_PRODUCT_DEPTH_REPLACE_NV, GL_DOT_PRODUCT_REFLECT_CUBE_MAP_NV}) {
    set_operation(operation);
    expect_refused(GL_INVALID_OPERATION, "an operation of later units");
  }
  const GLint one_wrong[]{GL_LESS, GL_LESS, GL_LESS, GL_ALWAYS};
  glTexEnviv(kShader, GL_CULL_MODES_NV, one_wrong);
  expect_refused(GL_INVALID_ENUM, "one cull mode");
  glTexEnvi(kShader, GL_CULL_MODES_NV, GL_LESS);
  expect_refused(GL_INVALID_ENUM, "cull modes as one value");
  glTexEnvi(kShader, GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE31);
  expect_refused(GL_INVALID_ENUM, "previous texture");
  glTexEnvi(kShader, GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV, GL_EXPAND_NEGATE_NV);
  expect_refused(GL_INVALID_ENUM, "dot product mapping");
  glTexEnvi(kShader, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  expect_refused(GL_INVALID_ENUM, "name");
  glTexEnvi(kShader, GL_SHADER_CONSISTENT_NV, 1);
  expect_refused(GL_INVALID_ENUM, "a value that can only be read");
  glTexEnvfv(kShader, GL_SHADER_OPERATION_NV, nullptr);
  expect_refused(GL_INVALID_VALUE, "null");
  GLint value = -1;
  glGetTexEnviv(kShader, GL_TEXTURE_ENV_MODE, &value);
  expect_refused(GL_INVALID_ENUM, "name of a get");
  EXPECT_EQ(value, -1);
  glActiveTexture(GL_TEXTURE5);  // combiners cannot read it
  set_operation(GL_TEXTURE_2D);
  EXPECT_EQ(glGetError(), kInvalidOperation);
}

}  // namespace
}  // namespace ninebit::test
