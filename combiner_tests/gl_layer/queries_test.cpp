// What a program reads of a context: extension strings, glGet, glIsEnabled, the current program.
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <sstream>

#include "combiner_tests/gl_layer/combiner_commands.h"
#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

std::multiset<std::string> words_of_the_extension_string() {
  std::istringstream text(reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS)));
  std::multiset<std::string> words;
  for (std::string word; text >> word;) words.insert(word);
  return words;
}

std::multiset<std::string> indexed_extensions() {
  const GLint number = integer_of(GL_NUM_EXTENSIONS);
  std::multiset<std::string> words;
  for (GLint i = 0; i < number; ++i) {
    const GLubyte* const word = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
    EXPECT_NE(word, nullptr) << i;
    if (word != nullptr) words.insert(reinterpret_cast<const char*>(word));
  }
  EXPECT_EQ(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(number)), nullptr);
  EXPECT_EQ(glGetError(), kInvalidValue);
  return words;
}

void expect_extensions(const std::multiset<std::string>& words, bool second) {
  EXPECT_EQ(words.count("GL_NV_register_combiners"), 1U);
  EXPECT_EQ(words.count("GL_NV_register_combiners2"), second ? 1U : 0U);
  EXPECT_EQ(words.count("GL_NV_texture_shader"), second ? 1U : 0U);
  EXPECT_EQ(words.count("GL_ARB_multitexture"), 1U);  // the driver's own are there
}

TEST(LayerQueries, Extensions) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    NINEBIT_GL_CONTEXT(context, profile);
    const auto words = words_of_the_extension_string();
    expect_extensions(words, profile.per_stage_constants);
    EXPECT_EQ(indexed_extensions(), words);
    const GLubyte* const text = glGetString(GL_EXTENSIONS);
    EXPECT_EQ(glGetString(GL_EXTENSIONS), text) << "the string moves";
    EXPECT_NE(glGetString(GL_VENDOR), nullptr);
    EXPECT_EQ(glGetString(GL_ZERO), nullptr);
    EXPECT_EQ(glGetError(), kInvalidEnum);
    GLfloat as_float = 0;
    GLdouble as_double = 0;
    GLboolean as_boolean = 0;
    glGetFloatv(GL_NUM_EXTENSIONS, &as_float);
    glGetDoublev(GL_NUM_EXTENSIONS, &as_double);
    glGetBooleanv(GL_NUM_EXTENSIONS, &as_boolean);
    EXPECT_EQ(as_float, static_cast<GLfloat>(words.size()));
    EXPECT_EQ(as_double, static_cast<GLdouble>(words.size()));
    EXPECT_EQ(as_boolean, GL_TRUE);
  }
}

// A value by each of the four commands; others of the arrays stay as they are.
void expect_values(GLenum name, std::vector<GLfloat> floats, std::vector<GLint> integers) {
  floats.resize(5, -7.0F);
  integers.resize(5, -7);
  std::vector<GLfloat> got_floats(5, -7.0F);
  std::vector<GLdouble> got_doubles(5, -7.0);
  std::vector<GLint> got_integers(5, -7);
  std::vector<GLboolean> got_booleans(5, 77), booleans;
  glGetFloatv(name, got_floats.data());
  glGetDoublev(name, got_doubles.data());
  glGetIntegerv(name, got_integers.data());
  glGetBooleanv(name, got_booleans.data());
  EXPECT_EQ(glGetError(), kNoError) << std::hex << name;
  for (const GLfloat value : floats) booleans.push_back(value == -7.0F ? 77 : value != 0.0F ? 1 : 0);
  EXPECT_EQ(got_floats, floats) << std::hex << name;
  EXPECT_EQ(got_doubles, std::vector<GLdouble>(floats.begin(), floats.end())) << std::hex << name;
  EXPECT_EQ(got_integers, integers) << std::hex << name;
  EXPECT_EQ(got_booleans, booleans) << std::hex << name;
}

TEST(LayerQueries, Values) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    NINEBIT_GL_CONTEXT(context, profile);
    expect_values(GL_REGISTER_COMBINERS_NV, {0}, {0});
    expect_values(GL_NUM_GENERAL_COMBINERS_NV, {1}, {1});
    expect_values(GL_MAX_GENERAL_COMBINERS_NV, {static_cast<GLfloat>(profile.general_combiners)},
                  {profile.general_combiners});
    expect_values(GL_COLOR_SUM_CLAMP_NV, {1}, {1});
    expect_values(GL_CONSTANT_COLOR0_NV, {0, 0, 0, 0}, {0, 0, 0, 0});
    const GLfloat color[]{0.25F, 1.0F, -3.0F, 5.0F};
    glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, color);
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
    glCombinerParameterfNV(GL_COLOR_SUM_CLAMP_NV, 0.0F);
    glEnable(GL_REGISTER_COMBINERS_NV);
    expect_values(GL_NUM_GENERAL_COMBINERS_NV, {2}, {2});
    expect_values(GL_COLOR_SUM_CLAMP_NV, {0}, {0});
    expect_values(GL_REGISTER_COMBINERS_NV, {1}, {1});
    GLint quarter[4]{};
    glGetIntegerv(GL_CONSTANT_COLOR1_NV, quarter);
    EXPECT_NEAR(quarter[0], 0.25 * 2147483647.0, 1.0);
    expect_values(GL_CONSTANT_COLOR1_NV, {0.25F, 1, 0, 1}, {quarter[0], 2147483647, 0, 2147483647});
    if (profile.per_stage_constants) {
      expect_values(GL_PER_STAGE_CONSTANTS_NV, {0}, {0});
      expect_values(GL_TEXTURE_SHADER_NV, {0}, {0});
      glEnable(GL_PER_STAGE_CONSTANTS_NV);
      glEnable(GL_TEXTURE_SHADER_NV);
      expect_values(GL_PER_STAGE_CONSTANTS_NV, {1}, {1});
      expect_values(GL_TEXTURE_SHADER_NV, {1}, {1});
    }
  }
}

TEST(LayerQueries, TheFirstGenerationHasNothingOfTheSecond) {
  NINEBIT_GL_CONTEXT(context, profiles::geforce2);
  for (const int cap : {GL_PER_STAGE_CONSTANTS_NV, GL_TEXTURE_SHADER_NV}) {
    const auto name = static_cast<GLenum>(cap);
    glEnable(name);
    EXPECT_EQ(glGetError(), kInvalidEnum);
    EXPECT_EQ(glIsEnabled(name), GL_FALSE);
    EXPECT_EQ(glGetError(), kInvalidEnum);
    EXPECT_EQ(integer_of(name), -2);
    EXPECT_EQ(glGetError(), kInvalidEnum);
  }
  GLint value = -1;
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  glGetTexEnviv(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, &value);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  EXPECT_EQ(value, -1);
}

TEST(LayerQueries, EnablesAndTheDriversOwnValues) {
  NINEBIT_GL_CONTEXT(context);
  for (const int name : {GL_REGISTER_COMBINERS_NV, GL_PER_STAGE_CONSTANTS_NV, GL_TEXTURE_SHADER_NV, GL_FOG}) {
    const auto cap = static_cast<GLenum>(name);
    EXPECT_EQ(glIsEnabled(cap), GL_FALSE);
    glEnable(cap);
    EXPECT_EQ(glIsEnabled(cap), GL_TRUE);
    glDisable(cap);
    EXPECT_EQ(glIsEnabled(cap), GL_FALSE);
  }
  glLineWidth(3.0F);
  expect_values(GL_LINE_WIDTH, {3.0F}, {3});
  integer_of(GL_VARIABLE_A_NV);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  glGetIntegerv(GL_NUM_GENERAL_COMBINERS_NV, nullptr);
  EXPECT_EQ(glGetError(), kInvalidValue);
}

// The layer's own shader is none of the program's.
TEST(LayerQueries, NoProgramIsCurrentWhileTheLayersIsBound) {
  NINEBIT_GL_CONTEXT(context);
  expect_values(GL_CURRENT_PROGRAM, {0}, {0});
  show_constant({0.2F, 0.4F, 0.6F, 0.8F});
  EXPECT_EQ(drawn_pixel(), (Pixel{51, 102, 153, 204}));  // so the layer's shader is bound
  expect_values(GL_CURRENT_PROGRAM, {0}, {0});
  EXPECT_EQ(glGetHandleARB(GL_PROGRAM_OBJECT_ARB), 0U);
  const GLuint own = make_green_program();
  ASSERT_NE(own, 0U);
  glUseProgram(own);
  expect_values(GL_CURRENT_PROGRAM, {static_cast<GLfloat>(own)}, {static_cast<GLint>(own)});
  EXPECT_EQ(glGetHandleARB(GL_PROGRAM_OBJECT_ARB), own);
  glUseProgram(0);
  draw_square();
  expect_values(GL_CURRENT_PROGRAM, {0}, {0});
  // A program that does not exist leaves none.
  glUseProgram(own + 1000);
  EXPECT_EQ(glGetError(), kInvalidValue);
  expect_values(GL_CURRENT_PROGRAM, {0}, {0});
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{51, 102, 153, 204}));
}

}  // namespace
}  // namespace ninebit::test
