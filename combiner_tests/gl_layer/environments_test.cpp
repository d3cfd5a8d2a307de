// Texture shaders without combiners: the layer's texture environments against the driver's own fixed functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>

#include "combiner_tests/gl_layer/pictures.h"
#include "combiner_tests/support/random.h"

namespace ninebit::test {
namespace {

constexpr int kUnits = 3;

void random_texture(Random& random) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  const GLint format = random.pick({GL_ALPHA8, GL_LUMINANCE8, GL_LUMINANCE8_ALPHA8, GL_INTENSITY8, GL_RGB8, GL_RGBA8});
  std::array<std::uint8_t, 64> texels{};
  for (std::uint8_t& byte : texels) byte = static_cast<std::uint8_t>(random.below(256));
  glTexImage2D(GL_TEXTURE_2D, 0, format, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  use_nearest(GL_TEXTURE_2D);
}

void random_combine(Random& random, GLenum function, GLenum source, GLenum operand, GLenum scale, bool is_rgb) {
  const auto set = [](GLenum pname, int value) { glTexEnvi(GL_TEXTURE_ENV, pname, value); };
  int wanted = random.pick({GL_REPLACE, GL_MODULATE, GL_ADD, GL_ADD_SIGNED, GL_INTERPOLATE, GL_SUBTRACT});
  if (is_rgb && random.one_in(4)) wanted = random.pick({GL_DOT3_RGB, GL_DOT3_RGBA});
  set(function, wanted);
  for (GLenum i = 0; i < 3; ++i) {
    set(source + i, random.pick({GL_TEXTURE, GL_CONSTANT, GL_PRIMARY_COLOR, GL_PREVIOUS, GL_TEXTURE0, GL_TEXTURE2}));
    set(operand + i, is_rgb ? random.pick({GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA})
                            : random.pick({GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA}));
  }
  set(scale, random.pick({1, 2, 4}));
}

void random_environment(Random& random) {
  const int mode = random.pick({GL_REPLACE, GL_MODULATE, GL_BLEND, GL_ADD, GL_COMBINE, GL_COMBINE});
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, mode);
  std::array<GLfloat, 4> color{};
  for (GLfloat& c : color) c = static_cast<GLfloat>(random.below(256)) / 255.0F;
  glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, color.data());
  random_combine(random, GL_COMBINE_RGB, GL_SOURCE0_RGB, GL_OPERAND0_RGB, GL_RGB_SCALE, true);
  random_combine(random, GL_COMBINE_ALPHA, GL_SOURCE0_ALPHA, GL_OPERAND0_ALPHA, GL_ALPHA_SCALE, false);
}

// The environments of the units, for a failure's message.
std::string description() {
  std::string text;
  for (GLenum unit = 0; unit < kUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    text += "unit " + std::to_string(unit) + ':';
    for (const int pname : {GL_TEXTURE_ENV_MODE, GL_COMBINE_RGB, GL_SOURCE0_RGB, GL_SOURCE1_RGB, GL_SOURCE2_RGB,
                            GL_OPERAND0_RGB, GL_OPERAND1_RGB, GL_OPERAND2_RGB, GL_RGB_SCALE, GL_COMBINE_ALPHA,
                            GL_SOURCE0_ALPHA, GL_SOURCE1_ALPHA, GL_SOURCE2_ALPHA, GL_ALPHA_SCALE}) {
      GLint value = 0;
      glGetTexEnviv(GL_TEXTURE_ENV, static_cast<GLenum>(pname), &value);
      std::array<char, 16> hex{};
      std::snprintf(hex.data(), hex.size(), " %x", static_cast<unsigned>(value));
      text += hex.data();
    }
    for (const int pname : {GL_TEXTURE_INTERNAL_FORMAT, GL_TEXTURE_RED_SIZE, GL_TEXTURE_ALPHA_SIZE,
                            GL_TEXTURE_LUMINANCE_SIZE, GL_TEXTURE_INTENSITY_SIZE}) {
      GLint value = 0;
      glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, static_cast<GLenum>(pname), &value);
      text += ' ' + std::to_string(value);
    }
    text += '\n';
  }
  return text + (glIsEnabled(GL_COLOR_SUM) == GL_TRUE ? "colour sum " : "") +
         (glIsEnabled(GL_FOG) == GL_TRUE ? "fog" : "");
}

std::vector<Pixel> picture_of_square() {
  clear_picture();
  draw_square();
  return read_picture();
}

TEST(LayerEnvironments, EqualTheDriversFixedFunctions) {
  NINEBIT_GL_CONTEXT(context);
  Random random(0x656E7673);
  int distinct = 0;
  for (int n = 0; n < 40; ++n) {
    for (GLenum unit = 0; unit < kUnits; ++unit) {
      glActiveTexture(GL_TEXTURE0 + unit);
      random_texture(random);
      random_environment(random);
      glEnable(GL_TEXTURE_2D);
      glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
    }
    glActiveTexture(GL_TEXTURE0);
    const auto byte = [&] { return static_cast<GLubyte>(random.below(256)); };
    glColor4ub(byte(), byte(), byte(), byte());
    glSecondaryColor3ub(byte(), byte(), byte());
    // Not both: Mesa does not clamp between them, OpenGL does (1.3, 3.9).
    const int more = random.below(3);
    more == 1 ? glEnable(GL_COLOR_SUM) : glDisable(GL_COLOR_SUM);
    more == 2 ? glEnable(GL_FOG) : glDisable(GL_FOG);
    glFogi(GL_FOG_COORD_SRC, GL_FOG_COORD);
    glFogi(GL_FOG_MODE, GL_LINEAR);
    glFogCoordf(random.real_f(0, 1));
    const std::array<GLfloat, 4> fog{0.25F, 0.5F, 0.75F, 1.0F};
    glFogfv(GL_FOG_COLOR, fog.data());
    glDisable(GL_TEXTURE_SHADER_NV);
    const std::vector<Pixel> expected = picture_of_square();
    glEnable(GL_TEXTURE_SHADER_NV);
    const std::vector<Pixel> got = picture_of_square();
    distinct += std::adjacent_find(expected.begin(), expected.end(), std::not_equal_to<>()) != expected.end() ? 1 : 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) {  // both compute in floats
        ASSERT_NEAR(got[i][c], expected[i][c], 1) << "case " << n << ", pixel " << i << ", component " << c << '\n'
                                                  << description();
      }
    }
  }
  EXPECT_GT(distinct, 10);
}

TEST(LayerEnvironments, DecalBlendsByTheTexelsAlpha) {
  NINEBIT_GL_CONTEXT(context);
  set_texel({200, 100, 0, 51});
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_DECAL);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  glEnable(GL_TEXTURE_SHADER_NV);
  glColor4ub(100, 200, 255, 7);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{120, 180, 204, 7}));
}

// The environment is read when it has changed, and not before combiners are disabled.
TEST(LayerEnvironments, CombinersComeFirst) {
  NINEBIT_GL_CONTEXT(context);
  set_texel({50, 60, 70, 80});
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  glEnable(GL_TEXTURE_SHADER_NV);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{50, 60, 70, 80}));
  show_constant({0, 1, 0, 1});
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 255, 0, 255}));
  glDisable(GL_REGISTER_COMBINERS_NV);
  glColor4ub(255, 0, 255, 255);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
  EXPECT_EQ(drawn_pixel(), (Pixel{50, 0, 70, 80}));
  glDisable(GL_TEXTURE_SHADER_NV);
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 0, 255, 255}));
}

// NV_texture_shader's mode GL_NONE: the unit leaves the colour as it is.
TEST(LayerEnvironments, NoneLeavesTheColour) {
  NINEBIT_GL_CONTEXT(context);
  set_texel({50, 60, 70, 80});
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  glEnable(GL_TEXTURE_SHADER_NV);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_NONE);
  GLint mode = -1;
  glGetTexEnviv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &mode);
  EXPECT_EQ(mode, GL_NONE);
  glColor4ub(1, 2, 3, 4);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{1, 2, 3, 4}));
  glNewList(1, GL_COMPILE);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glEndList();
  EXPECT_EQ(drawn_pixel(), (Pixel{1, 2, 3, 4}));
  glCallList(1);
  EXPECT_EQ(drawn_pixel(), (Pixel{50, 60, 70, 80}));
  glGetTexEnviv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &mode);
  EXPECT_EQ(mode, GL_REPLACE);
}

// It is kept from the first command of a program on, ends with the next mode, and is part of the texture attributes.
TEST(LayerEnvironments, NoneFollowsTheAttributes) {
  NINEBIT_GL_CONTEXT(context);
  const auto mode = [] {
    GLint value = -1;
    glGetTexEnviv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &value);
    return value;
  };
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_NONE);
  EXPECT_EQ(mode(), GL_NONE);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
  EXPECT_EQ(mode(), GL_MODULATE);
  glPushAttrib(GL_TEXTURE_BIT);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_NONE);
  glPushAttrib(GL_TEXTURE_BIT);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glPopAttrib();
  EXPECT_EQ(mode(), GL_NONE);
  glPopAttrib();
  EXPECT_EQ(mode(), GL_MODULATE);
  glActiveTexture(GL_TEXTURE5);  // of the driver alone, which does not have the mode
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_NONE);
  EXPECT_EQ(glGetError(), kInvalidEnum);
}

// Each list of glCallLists gets the shader that fits when it begins, also without combiners.
TEST(LayerEnvironments, ListsHaveShadersOfTheirOwn) {
  NINEBIT_GL_CONTEXT(context);
  GLuint textures[2]{};
  glGenTextures(2, textures);
  for (const std::size_t i : {std::size_t{1}, std::size_t{0}}) {
    glBindTexture(GL_TEXTURE_2D, textures[i]);
    set_texel({50, 60, 70, 128}, i == 0 ? GL_RGBA8 : GL_ALPHA8);
  }
  glNewList(1, GL_COMPILE);
  glBindTexture(GL_TEXTURE_2D, textures[1]);
  glEndList();
  glNewList(2, GL_COMPILE);
  glRectf(-1, -1, 1, 1);
  glEndList();
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  glEnable(GL_TEXTURE_SHADER_NV);
  glColor4ub(1, 2, 3, 4);
  clear_picture();
  glCallList(2);
  EXPECT_EQ(center_pixel(), (Pixel{50, 60, 70, 128}));
  const GLubyte lists[]{1, 2};
  glCallLists(2, GL_UNSIGNED_BYTE, lists);
  EXPECT_EQ(center_pixel(), (Pixel{1, 2, 3, 128}));
}

}  // namespace
}  // namespace ninebit::test
