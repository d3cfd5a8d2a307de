// What OpenGL's fixed functions give to combiners and do with their colour: lighting, fog, shade model, alpha test,
// blending; the program's own shaders, which take precedence; and when shaders are compiled.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

Pixel shown(GLenum reg) {
  show_register(reg);
  return drawn_pixel();
}

void set_light(GLint color_control) {
  const GLfloat black[]{0, 0, 0, 1}, white[]{1, 1, 1, 1}, emission[]{0.2F, 0.4F, 0.6F, 1}, specular[]{0.4F, 0.2F, 0, 1};
  const GLfloat towards_viewer[]{0, 0, 1, 0};
  glEnable(GL_LIGHTING);
  glEnable(GL_LIGHT0);
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
  glLightfv(GL_LIGHT0, GL_DIFFUSE, black);
  glLightfv(GL_LIGHT0, GL_SPECULAR, white);
  glLightfv(GL_LIGHT0, GL_POSITION, towards_viewer);
  glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, emission);
  glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, specular);
  glNormal3f(0, 0, 1);
  glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, color_control);
}

TEST(LayerFixedFunctions, Lighting) {
  NINEBIT_GL_CONTEXT(context);
  glSecondaryColor3ub(9, 9, 9);
  EXPECT_EQ(shown(GL_SECONDARY_COLOR_NV), (Pixel{9, 9, 9, 255}));
  set_light(GL_SINGLE_COLOR);
  EXPECT_EQ(shown(GL_PRIMARY_COLOR_NV), (Pixel{153, 153, 153, 255}));
  EXPECT_EQ(shown(GL_SECONDARY_COLOR_NV), (Pixel{0, 0, 0, 0}));
  set_light(GL_SEPARATE_SPECULAR_COLOR);
  EXPECT_EQ(shown(GL_PRIMARY_COLOR_NV), (Pixel{51, 102, 153, 255}));
  const Pixel specular = shown(GL_SECONDARY_COLOR_NV);
  EXPECT_EQ((std::array{specular[0], specular[1], specular[2]}), (std::array<std::uint8_t, 3>{102, 51, 0}));
  glDisable(GL_LIGHTING);
  EXPECT_EQ(shown(GL_SECONDARY_COLOR_NV), (Pixel{9, 9, 9, 255}));
}

TEST(LayerFixedFunctions, FogFactors) {
  NINEBIT_GL_CONTEXT(context);
  const GLfloat color[]{0.2F, 0.4F, 0.6F, 0.1F};
  glFogfv(GL_FOG_COLOR, color);
  glFogi(GL_FOG_COORDINATE_SOURCE, GL_FOG_COORDINATE);
  glFogf(GL_FOG_START, 1.0F);
  glFogf(GL_FOG_END, 3.0F);
  glFogf(GL_FOG_DENSITY, 0.7F);
  std::set<std::uint8_t> factors;
  for (const float distance : {0.25F, 1.2F, 1.7F, 2.9F, 4.0F}) {
    glFogCoordf(distance);
    glDisable(GL_FOG);
    EXPECT_EQ(shown(GL_FOG), (Pixel{51, 102, 153, 255}));
    glEnable(GL_FOG);
    const std::pair<GLint, double> modes[]{{GL_LINEAR, (3.0 - distance) / 2.0},
                                           {GL_EXP, std::exp(-0.7 * distance)},
                                           {GL_EXP2, std::exp(-0.49 * distance * distance)}};
    for (const auto& [mode, factor] : modes) {
      glFogi(GL_FOG_MODE, mode);
      const Pixel pixel = shown(GL_FOG);
      EXPECT_EQ((std::array{pixel[0], pixel[1], pixel[2]}), (std::array<std::uint8_t, 3>{51, 102, 153}));
      EXPECT_NEAR(pixel[3], std::min(std::max(factor, 0.0), 1.0) * 255.0, 1.01) << mode << " at " << distance;
      factors.insert(pixel[3]);
    }
  }
  EXPECT_GT(factors.size(), 10U);
  // The distance of a vertex, where the fog coordinate is not the source.
  glFogi(GL_FOG_COORDINATE_SOURCE, GL_FRAGMENT_DEPTH);
  glFogi(GL_FOG_MODE, GL_LINEAR);
  glFogf(GL_FOG_START, 0.0F);
  glFogf(GL_FOG_END, 1.0F);
  show_register(GL_FOG);
  draw_corners([](GLfloat x, GLfloat y) { glVertex3f(x, y, -0.75F); });
  EXPECT_NEAR(center_pixel()[3], 0.25 * 255.0, 1.01);
}

// The shaders with fog and without are kept beside each other: what changes between is drawn by new ones.
TEST(LayerFixedFunctions, FogBetweenOtherChanges) {
  NINEBIT_GL_CONTEXT(context);
  glFogi(GL_FOG_COORDINATE_SOURCE, GL_FOG_COORDINATE);
  glFogi(GL_FOG_MODE, GL_LINEAR);
  glFogf(GL_FOG_START, 1.0F);
  glFogf(GL_FOG_END, 3.0F);
  glFogCoordf(2.5F);
  set_texel({1, 2, 3, 77}, GL_RGBA);
  const auto alpha = [](bool fog) {
    (fog ? glEnable : glDisable)(GL_FOG);
    clear_picture();
    return int{drawn_pixel()[3]};
  };
  show_register(GL_FOG);
  glDisable(GL_FOG);
  const int without = alpha(false);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(alpha(true), 64, 1);
    EXPECT_EQ(alpha(false), without);
  }
  show_register(GL_TEXTURE0_ARB);
  const int no_texture = alpha(false);
  EXPECT_EQ(alpha(true), no_texture);
  glEnable(GL_TEXTURE_2D);
  EXPECT_EQ(alpha(false), 77);
  EXPECT_EQ(alpha(true), 77);
  glDisable(GL_TEXTURE_2D);
  EXPECT_EQ(alpha(false), no_texture);
  show_register(GL_FOG);
  EXPECT_NEAR(alpha(true), 64, 1);
  glFogi(GL_FOG_MODE, GL_EXP);
  glFogf(GL_FOG_DENSITY, 0.2F);
  EXPECT_NEAR(alpha(true), 255.0 * std::exp(-0.5), 1.01);
  glPushAttrib(GL_FOG_BIT);
  EXPECT_EQ(alpha(false), without);
  glPopAttrib();
  clear_picture();
  EXPECT_NEAR(drawn_pixel()[3], 255.0 * std::exp(-0.5), 1.01);
}

TEST(LayerFixedFunctions, ShadeModel) {
  NINEBIT_GL_CONTEXT(context);
  show_register(GL_PRIMARY_COLOR_NV);
  for (const int model : {GL_SMOOTH, GL_FLAT}) {
    glShadeModel(static_cast<GLenum>(model));
    clear_picture();
    glBegin(GL_TRIANGLES);
    glColor4ub(255, 0, 0, 255);
    glVertex2f(-1, -1);
    glColor4ub(0, 255, 0, 255);
    glVertex2f(3, -1);
    glColor4ub(10, 20, 30, 40);
    glVertex2f(-1, 3);
    glEnd();
    const auto picture = read_picture();
    const std::set<Pixel> colors(picture.begin(), picture.end());
    if (model == GL_SMOOTH) {
      EXPECT_GT(colors.size(), 100U);
    } else {
      EXPECT_EQ(colors, (std::set<Pixel>{{10, 20, 30, 40}}));
    }
  }
}

TEST(LayerFixedFunctions, AlphaTestAndBlendingComeAfterCombiners) {
  NINEBIT_GL_CONTEXT(context);
  glColor4f(1, 1, 1, 1);  // what fixed functions would test
  show_constant({1.0F, 0.4F, 0.2F, 0.2F});
  glEnable(GL_ALPHA_TEST);
  glAlphaFunc(GL_GREATER, 0.5F);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 0}));
  glAlphaFunc(GL_LESS, 0.5F);
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 102, 51, 51}));
  glDisable(GL_ALPHA_TEST);
  glClearColor(0, 1, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  const Pixel blended = drawn_pixel();
  EXPECT_NEAR(blended[0], 51, 1);
  EXPECT_NEAR(blended[1], 0.2 * 102 + 0.8 * 255, 1);
  EXPECT_NEAR(blended[2], 0.2 * 51, 1);
}

TEST(LayerFixedFunctions, OwnShadersTakePrecedence) {
  NINEBIT_GL_CONTEXT(context);
  const Pixel green{0, 255, 0, 255}, constant{255, 51, 51, 51};
  const GLuint program = make_green_program();
  show_constant({1.0F, 0.2F, 0.2F, 0.2F});
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(drawn_pixel(), constant);
    glUseProgram(program);
    EXPECT_EQ(drawn_pixel(), green);
    glDisable(GL_REGISTER_COMBINERS_NV);
    EXPECT_EQ(drawn_pixel(), green);
    glEnable(GL_REGISTER_COMBINERS_NV);
    glUseProgramObjectARB(0);
  }
  const char* const text = "!!ARBfp1.0\nMOV result.color, {0.0, 1.0, 0.0, 1.0};\nEND";
  glBindProgramARB(GL_FRAGMENT_PROGRAM_ARB, 1);
  glProgramStringARB(GL_FRAGMENT_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(std::strlen(text)),
                     text);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(drawn_pixel(), constant);
    glEnable(GL_FRAGMENT_PROGRAM_ARB);
    EXPECT_EQ(drawn_pixel(), green);
    glDisable(GL_FRAGMENT_PROGRAM_ARB);
  }
  // A vertex program gives combiners its colours.
  const char* const vertices =
      "!!ARBvp1.0\nMOV result.position, vertex.position;\nMOV result.color, {0.2, 0.4, 0.6, 0.8};\n"
      "MOV result.color.secondary, {0.4, 0.2, 0.0, 0.0};\nEND";
  glBindProgramARB(GL_VERTEX_PROGRAM_ARB, 2);
  glProgramStringARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(std::strlen(vertices)),
                     vertices);
  set_light(GL_SINGLE_COLOR);
  EXPECT_EQ(shown(GL_PRIMARY_COLOR_NV), (Pixel{153, 153, 153, 255}));
  glEnable(GL_VERTEX_PROGRAM_ARB);
  EXPECT_EQ(shown(GL_PRIMARY_COLOR_NV), (Pixel{51, 102, 153, 204}));
  const Pixel secondary = shown(GL_SECONDARY_COLOR_NV);
  EXPECT_EQ((std::array{secondary[0], secondary[1], secondary[2]}), (std::array<std::uint8_t, 3>{102, 51, 0}));
}

// The texture environment, colour sum and fog are not applied to what combiners give.
TEST(LayerFixedFunctions, NothingElseChangesTheColor) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({0.2F, 0.4F, 0.6F, 0.8F});
  set_texel({99, 9, 200, 77});
  glEnable(GL_TEXTURE_2D);
  glEnable(GL_FOG);
  glEnable(GL_COLOR_SUM);
  glSecondaryColor3ub(255, 255, 255);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_ADD);
  EXPECT_EQ(drawn_pixel(), (Pixel{51, 102, 153, 204}));
}

// Names of shaders advance by one for each that is made: this program's own between two draws, and the layer's.
TEST(LayerFixedFunctions, AChangedConstantCompilesNothing) {
  NINEBIT_GL_CONTEXT(context);
  for (const bool per_stage : {false, true}) {
    show_register(GL_SPARE0_NV);
    for (const int portion : {GL_RGB, GL_ALPHA}) {
      const auto name = static_cast<GLenum>(portion);
      glCombinerInputNV(GL_COMBINER0_NV, name, GL_VARIABLE_A_NV, GL_CONSTANT_COLOR1_NV, GL_UNSIGNED_IDENTITY_NV, name);
      glCombinerInputNV(GL_COMBINER0_NV, name, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, name);
      glCombinerOutputNV(GL_COMBINER0_NV, name, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE,
                         GL_FALSE, GL_FALSE);
    }
    (per_stage ? glEnable : glDisable)(GL_PER_STAGE_CONSTANTS_NV);
    draw_square();
    const GLuint before = glCreateShader(GL_FRAGMENT_SHADER);
    for (int i = 0; i < 40; ++i) {
      const auto byte = static_cast<std::uint8_t>(i * 6);
      const GLfloat level = static_cast<GLfloat>(byte) / 255.0F, color[]{level, 1.0F, level, level};
      per_stage ? glCombinerStageParameterfvNV(GL_COMBINER0_NV, GL_CONSTANT_COLOR1_NV, color)
                : glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, color);
      EXPECT_EQ(drawn_pixel(), (Pixel{byte, 255, byte, byte})) << per_stage;
    }
    const GLuint after = glCreateShader(GL_FRAGMENT_SHADER);
    EXPECT_EQ(after, before + 1) << per_stage;
    const GLenum other = per_stage ? GL_PRIMARY_COLOR_NV : GL_SPARE0_NV;  // a new program each time
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, other, GL_UNSIGNED_INVERT_NV, GL_RGB);
    draw_square();
    EXPECT_GT(glCreateShader(GL_FRAGMENT_SHADER), after + 1) << "names of shaders show no compilation here";
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    const GLuint again = glCreateShader(GL_FRAGMENT_SHADER);
    draw_square();
    EXPECT_EQ(glCreateShader(GL_FRAGMENT_SHADER), again + 1) << "a program of before is compiled again";
  }
}

}  // namespace
}  // namespace ninebit::test
