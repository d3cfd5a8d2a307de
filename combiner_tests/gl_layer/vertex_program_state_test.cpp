// NV_vertex_program on the driver: programs as objects, attributes, arrays, errors.
#include <gtest/gtest.h>

#include <functional>
#include <tuple>

#include "combiner_tests/gl_layer/vertex_program_kit.h"

namespace ninebit::test {
namespace {

GLenum load(GLuint name, const std::string& text, GLenum target = GL_VERTEX_PROGRAM_NV) {
  glLoadProgramNV(target, name, static_cast<GLsizei>(text.size()), reinterpret_cast<const GLubyte*>(text.data()));
  return glGetError();
}

const std::string kFirst = "!!VP1.0 MOV o[HPOS], v[OPOS]; MOV o[TEX0], c[0];END";

TEST(LayerVertexProgramState, IsTheDriversWithoutTheExtension) {
  NINEBIT_GL_CONTEXT(context);
  load(1, kFirst);
  glVertexAttrib4fNV(8, 1, 2, 3, 4);
  EXPECT_EQ(glIsProgramNV(1), GL_FALSE);
  glGetError();
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), -2);
  EXPECT_EQ(glGetError(), kInvalidEnum);
}

TEST(LayerVertexProgramState, IsListed) {
  for (const auto& [list, has_first, has_second] : {std::tuple{"NV_vertex_program", true, false},
                                                    {"NV_vertex_program1_1", true, true},
                                                    {"all", true, true},
                                                    {"NV_fence", false, false}}) {
    const WithExtensions wanted(list);
    NINEBIT_GL_CONTEXT(context);
    const std::string all = std::string(reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS))) + ' ';
    EXPECT_EQ(all.find(" GL_NV_vertex_program ") != std::string::npos, has_first) << list;
    EXPECT_EQ(all.find(" GL_NV_vertex_program1_1 ") != std::string::npos, has_second) << list;
    if (has_first) {
      EXPECT_EQ(load(1, "!!VP1.1 MOV o[HPOS], v[OPOS];END"), has_second ? kNoError : kInvalidOperation) << list;
    }
  }
}

TEST(LayerVertexProgramState, Programs) {
  NINEBIT_VERTEX_CONTEXT(context);
  GLuint names[3]{};
  glGenProgramsNV(3, names);
  EXPECT_NE(names[0], names[1]);
  EXPECT_EQ(glIsProgramNV(names[0]), GL_FALSE) << "it has no text";
  EXPECT_EQ(load(names[0], kFirst), kNoError);
  EXPECT_EQ(glIsProgramNV(names[0]), GL_TRUE);
  EXPECT_EQ(integer_of(GL_PROGRAM_ERROR_POSITION_NV), -1);
  GLint value = 0;
  glGetProgramivNV(names[0], GL_PROGRAM_LENGTH_NV, &value);
  EXPECT_EQ(value, static_cast<GLint>(kFirst.size()));
  glGetProgramivNV(names[0], GL_PROGRAM_TARGET_NV, &value);
  EXPECT_EQ(value, GL_VERTEX_PROGRAM_NV);
  glGetProgramivNV(names[0], GL_PROGRAM_RESIDENT_NV, &value);
  EXPECT_EQ(value, GL_TRUE);
  std::string text(kFirst.size() + 1, '?');
  glGetProgramStringNV(names[0], GL_PROGRAM_STRING_NV, reinterpret_cast<GLubyte*>(text.data()));
  EXPECT_EQ(text, kFirst + '?');
  GLboolean residences[1]{};
  EXPECT_EQ(glAreProgramsResidentNV(1, names, residences), GL_TRUE);
  glRequestResidentProgramsNV(1, names);
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, names[0]);
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), static_cast<GLint>(names[0]));
  EXPECT_EQ(glGetError(), kNoError);
  EXPECT_EQ(load(names[0], "!!VP1.0 MOV R0, R1"), kInvalidOperation);
  EXPECT_EQ(integer_of(GL_PROGRAM_ERROR_POSITION_NV), 18);
  glGetProgramStringNV(names[0], GL_PROGRAM_STRING_NV, reinterpret_cast<GLubyte*>(text.data()));
  EXPECT_EQ(text, kFirst + '?') << "a refused text changes nothing";
  glDeleteProgramsNV(3, names);
  EXPECT_EQ(glIsProgramNV(names[0]), GL_FALSE);
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), 0);
}

TEST(LayerVertexProgramState, Errors) {
  NINEBIT_VERTEX_CONTEXT(context);
  load(1, kFirst);
  load(2, "!!VSP1.0 MOV c[0], v[0];END", GL_VERTEX_STATE_PROGRAM_NV);
  GLuint names[1]{1}, unknown[2]{1, 77};
  GLboolean residences[2]{};
  GLfloat floats[4]{};
  GLint integers[4]{};
  void* pointer = nullptr;
  const GLubyte* const text = reinterpret_cast<const GLubyte*>(kFirst.data());
  const std::pair<GLenum, std::function<void()>> cases[]{
      {kInvalidEnum, [] { glBindProgramNV(GL_TEXTURE_2D, 1); }},
      {kInvalidOperation, [] { glBindProgramNV(GL_VERTEX_PROGRAM_NV, 2); }},
      {kInvalidValue, [&] { glDeleteProgramsNV(-1, names); }},
      {kInvalidValue, [&] { glGenProgramsNV(-1, names); }},
      {kInvalidEnum, [&] { glLoadProgramNV(GL_TEXTURE_2D, 1, 5, text); }},
      {kInvalidValue, [&] { glLoadProgramNV(GL_VERTEX_PROGRAM_NV, 0, 5, text); }},
      {kInvalidOperation, [&] { glLoadProgramNV(GL_VERTEX_PROGRAM_NV, 2, static_cast<GLsizei>(kFirst.size()), text); }},
      {kInvalidOperation, [&] { glLoadProgramNV(GL_VERTEX_PROGRAM_NV, 1, 5, text); }},
      {kInvalidEnum, [&] { glExecuteProgramNV(GL_VERTEX_PROGRAM_NV, 2, floats); }},
      {kInvalidOperation, [&] { glExecuteProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 1, floats); }},
      {kInvalidOperation, [&] { glExecuteProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 77, floats); }},
      {kInvalidValue, [&] { glAreProgramsResidentNV(2, unknown, residences); }},
      {kInvalidValue, [&] { glAreProgramsResidentNV(-1, unknown, residences); }},
      {kInvalidValue, [&] { glRequestResidentProgramsNV(2, unknown); }},
      {kInvalidOperation, [&] { glGetProgramivNV(77, GL_PROGRAM_LENGTH_NV, integers); }},
      {kInvalidEnum, [&] { glGetProgramivNV(1, GL_PROGRAM_STRING_NV, integers); }},
      {kInvalidOperation, [&] { glGetProgramStringNV(77, GL_PROGRAM_STRING_NV, residences); }},
      {kInvalidEnum, [&] { glGetProgramStringNV(1, GL_PROGRAM_LENGTH_NV, residences); }},
      {kInvalidEnum, [&] { glProgramParameter4fvNV(GL_VERTEX_STATE_PROGRAM_NV, 0, floats); }},
      {kInvalidValue, [&] { glProgramParameter4fvNV(GL_VERTEX_PROGRAM_NV, 96, floats); }},
      {kInvalidValue, [&] { glProgramParameters4fvNV(GL_VERTEX_PROGRAM_NV, 95, 2, floats); }},
      {kInvalidValue, [&] { glProgramParameters4fvNV(GL_VERTEX_PROGRAM_NV, 0, -1, floats); }},
      {kInvalidEnum, [&] { glGetProgramParameterfvNV(GL_TEXTURE_2D, 0, GL_PROGRAM_PARAMETER_NV, floats); }},
      {kInvalidEnum, [&] { glGetProgramParameterfvNV(GL_VERTEX_PROGRAM_NV, 0, GL_PROGRAM_LENGTH_NV, floats); }},
      {kInvalidValue, [&] { glGetProgramParameterfvNV(GL_VERTEX_PROGRAM_NV, 96, GL_PROGRAM_PARAMETER_NV, floats); }},
      {kInvalidEnum, [] { glTrackMatrixNV(GL_TEXTURE_2D, 0, GL_MODELVIEW, GL_IDENTITY_NV); }},
      {kInvalidValue, [] { glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 2, GL_MODELVIEW, GL_IDENTITY_NV); }},
      {kInvalidValue, [] { glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 96, GL_MODELVIEW, GL_IDENTITY_NV); }},
      {kInvalidEnum, [] { glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 0, GL_MODELVIEW_MATRIX, GL_IDENTITY_NV); }},
      {kInvalidEnum, [] { glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 0, GL_MODELVIEW, GL_MODELVIEW); }},
      {kInvalidValue, [&] { glGetTrackMatrixivNV(GL_VERTEX_PROGRAM_NV, 3, GL_TRACK_MATRIX_NV, integers); }},
      {kInvalidEnum, [&] { glGetTrackMatrixivNV(GL_VERTEX_PROGRAM_NV, 4, GL_MATRIX0_NV, integers); }},
      {kInvalidValue, [] { glVertexAttrib1fNV(16, 1); }},
      {kInvalidValue, [&] { glVertexAttribs4fvNV(15, 2, floats); }},
      {kInvalidValue, [&] { glVertexAttribPointerNV(16, 4, GL_FLOAT, 0, floats); }},
      {kInvalidValue, [&] { glVertexAttribPointerNV(1, 5, GL_FLOAT, 0, floats); }},
      {kInvalidValue, [&] { glVertexAttribPointerNV(1, 0, GL_FLOAT, 0, floats); }},
      {kInvalidValue, [&] { glVertexAttribPointerNV(1, 4, GL_FLOAT, -4, floats); }},
      {kInvalidEnum, [&] { glVertexAttribPointerNV(1, 4, GL_INT, 0, floats); }},
      {kInvalidValue, [&] { glVertexAttribPointerNV(1, 3, GL_UNSIGNED_BYTE, 0, floats); }},
      {kInvalidValue, [&] { glGetVertexAttribfvNV(16, GL_CURRENT_ATTRIB_NV, floats); }},
      {kInvalidOperation, [&] { glGetVertexAttribfvNV(0, GL_CURRENT_ATTRIB_NV, floats); }},
      {kInvalidEnum, [&] { glGetVertexAttribfvNV(1, GL_MATRIX0_NV, floats); }},
      {kInvalidValue, [&] { glGetVertexAttribPointervNV(16, GL_ATTRIB_ARRAY_POINTER_NV, &pointer); }},
      {kInvalidEnum, [&] { glGetVertexAttribPointervNV(1, GL_ATTRIB_ARRAY_SIZE_NV, &pointer); }},
  };
  int number = 0;
  for (const auto& [expected, call] : cases) {
    call();
    EXPECT_EQ(glGetError(), expected) << "case " << number;
    EXPECT_EQ(glGetError(), kNoError) << "case " << number;
    glBegin(GL_POINTS);
    call();
    glEnd();
    const GLenum inside = glGetError();
    if (expected != kInvalidValue || inside != kInvalidValue) {
      EXPECT_EQ(inside, kInvalidOperation) << "between glBegin and glEnd, case " << number;
    }
    ++number;
  }
}

TEST(LayerVertexProgramState, DrawingWithoutAProgramIsAnError) {
  NINEBIT_VERTEX_CONTEXT(context);
  glEnable(GL_VERTEX_PROGRAM_NV);
  const auto drawn = [] {
    glBegin(GL_POINTS);
    glEnd();
    return glGetError();
  };
  EXPECT_EQ(drawn(), kInvalidOperation) << "none was bound";
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, 5);
  EXPECT_EQ(drawn(), kInvalidOperation) << "it has no text";
  load(5, kFirst);
  EXPECT_EQ(drawn(), kNoError);
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, 0);
  EXPECT_EQ(drawn(), kInvalidOperation);
  glDisable(GL_VERTEX_PROGRAM_NV);
  EXPECT_EQ(drawn(), kNoError);
}

// The layer's own programs are hidden, and those of ARB_vertex_program have the same place.
TEST(LayerVertexProgramState, BesideProgramsOfArb) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  ASSERT_EQ(use_vertex_program(1, showing("MOV o[TEX0], c[0];")), kNoError);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 2, 3, 4);
  const std::string text =
      "!!ARBvp1.0\nMOV result.position, vertex.position;\nMOV result.texcoord[0], vertex.color;\nEND";
  GLint bound = -1;
  glGetProgramivARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_BINDING_ARB, &bound);
  EXPECT_EQ(bound, 1);
  glProgramStringARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(text.size()),
                     text.data());
  EXPECT_EQ(glGetError(), kInvalidOperation);
  for (GLuint name = 0x3FFFFF00; name < 0x40000000; ++name) {
    EXPECT_EQ(glIsProgramARB(name), GL_FALSE) << name;
    glDeleteProgramsARB(1, &name);
  }
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4}));
  glBindProgramARB(GL_VERTEX_PROGRAM_ARB, 9);
  glProgramStringARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(text.size()),
                     text.data());
  EXPECT_EQ(glGetError(), kNoError);
  glColor4f(8, 7, 6, 5);
  EXPECT_EQ(drawn_point(), (Floats{8, 7, 6, 5}));
  glGetProgramivARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_BINDING_ARB, &bound);
  EXPECT_EQ(bound, 9);
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, 1);
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4}));
}

TEST(LayerVertexProgramState, IsShared) {
  const WithExtensions with_programs("NV_vertex_program1_1");
  std::string why;
  const auto first = GlContext::make(why);
  if (first == nullptr) GTEST_SKIP() << why;
  load(4, kFirst);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 1, 1, 1);
  const auto second = GlContext::make(why, profiles::nv2a, first.get());
  EXPECT_EQ(glIsProgramNV(4), GL_TRUE);
  show_coordinates();
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, 4);
  glEnable(GL_VERTEX_PROGRAM_NV);
  EXPECT_EQ(drawn_point(), (Floats{})) << "parameters are a context's own";
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 5, 6, 7, 8);
  EXPECT_EQ(drawn_point(), (Floats{5, 6, 7, 8}));
  first->make_current();
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), 0);
  const auto other = GlContext::make(why);
  EXPECT_EQ(glIsProgramNV(4), GL_FALSE) << "another group";
}

// What attribute i is in a program.
Floats seen(GLuint i) {
  EXPECT_EQ(use_vertex_program(100 + i, showing("MOV o[TEX0], v[" + std::to_string(i) + "];")), kNoError);
  return drawn_point();
}

TEST(LayerVertexProgramState, AttributesAreConventionalOnes) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  glNormal3f(1, 2, 3);
  glColor4f(4, 5, 6, 7);
  glSecondaryColor3f(8, 9, 10);
  glFogCoordf(11);
  glMultiTexCoord4f(GL_TEXTURE7, 1, 3, 5, 7);
  EXPECT_EQ(seen(2), (Floats{1, 2, 3, 1}));
  EXPECT_EQ(seen(3), (Floats{4, 5, 6, 7}));
  EXPECT_EQ(seen(4), (Floats{8, 9, 10, 1}));
  EXPECT_EQ(seen(5), (Floats{11, 0, 0, 1}));
  EXPECT_EQ(seen(15), (Floats{1, 3, 5, 7}));
  const GLfloat f[8]{1, 2, 3, 4, 5, 6, 7, 8};
  const GLshort s[4]{-1, 2, 300, 4};
  const GLdouble d[4]{1.5, 2.5, 3.5, 4.5};
  const GLubyte ub[4]{255, 0, 51, 102};
  glVertexAttrib3fvNV(2, f);
  EXPECT_EQ(seen(2), (Floats{1, 2, 3, 1}));
  glVertexAttrib4svNV(3, s);
  EXPECT_EQ(seen(3), (Floats{-1, 2, 300, 4}));
  glVertexAttrib3dvNV(4, d);
  EXPECT_EQ(seen(4), (Floats{1.5F, 2.5F, 3.5F, 1}));
  glVertexAttrib1dNV(5, 2.5);
  EXPECT_EQ(seen(5), (Floats{2.5F, 0, 0, 1}));
  for (const GLuint i : {1U, 6U, 7U, 8U, 15U}) {
    glVertexAttrib4ubvNV(i, ub);
    EXPECT_EQ(seen(i), (Floats{1, 0, 0.2F, 0.4F})) << i;
    glVertexAttrib2sNV(i, 7, -8);
    EXPECT_EQ(seen(i), (Floats{7, -8, 0, 1})) << i;
  }
  glVertexAttribs4fvNV(6, 2, f);
  EXPECT_EQ(seen(6), (Floats{1, 2, 3, 4}));
  EXPECT_EQ(seen(7), (Floats{5, 6, 7, 8}));
  for (const GLuint i : {2U, 3U, 4U, 6U, 8U, 15U}) {
    GLfloat now[4]{};
    glVertexAttrib3fNV(i, 3, 2, 1);
    glGetVertexAttribfvNV(i, GL_CURRENT_ATTRIB_NV, now);
    EXPECT_EQ((Floats{now[0], now[1], now[2], now[3]}), (Floats{3, 2, 1, 1})) << i;
  }
  GLfloat color[4]{};
  glGetFloatv(GL_CURRENT_COLOR, color);
  EXPECT_EQ(color[1], 2);
}

Floats drawn_array(GLint first = 0) {
  glClear(GL_COLOR_BUFFER_BIT);
  glDrawArrays(GL_POINTS, first, 1);
  return float_pixel();
}

TEST(LayerVertexProgramState, Arrays) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  constexpr GLfloat kPositions[8]{0, 0, 0, 1, 0, 0, 0, 1};
  constexpr GLfloat kFloats[8]{1, 2, 3, 4, 5, 6, 7, 8};
  constexpr GLshort kShorts[6]{10, 20, 30, 40, 50, -60};
  constexpr GLubyte kBytes[8]{0, 0, 0, 0, 255, 51, 102, 0};
  constexpr GLdouble kDoubles[2]{0.5, 0.25};
  glVertexAttribPointerNV(0, 4, GL_FLOAT, 0, kPositions);
  glEnableClientState(GL_VERTEX_ATTRIB_ARRAY0_NV);
  for (const GLuint i : {1U, 2U, 3U, 4U, 5U, 6U, 8U, 12U}) {
    const GLenum array = GL_VERTEX_ATTRIB_ARRAY0_NV + i;
    EXPECT_EQ(use_vertex_program(1, showing("MOV o[TEX0], v[" + std::to_string(i) + "];")), kNoError);
    glVertexAttrib4fNV(i, -1, 0, 0, 1);
    glEnableClientState(array);
    EXPECT_EQ(glIsEnabled(array), GL_TRUE);
    EXPECT_EQ(integer_of(array), 1);
    glVertexAttribPointerNV(i, 4, GL_FLOAT, 0, kFloats);
    EXPECT_EQ(drawn_array(1), (Floats{5, 6, 7, 8})) << i;
    glVertexAttribPointerNV(i, 3, GL_SHORT, 0, kShorts);
    EXPECT_EQ(drawn_array(1), (Floats{40, 50, -60, 1})) << i;
    glVertexAttribPointerNV(i, 4, GL_UNSIGNED_BYTE, 4, kBytes);
    const Floats bytes = drawn_array(1);
    EXPECT_EQ(bytes[0], 1) << i;
    EXPECT_NEAR(bytes[1], 0.2F, 1e-6F) << i;
    EXPECT_EQ(bytes[3], 0) << i;
    glVertexAttribPointerNV(i, 1, GL_DOUBLE, 0, kDoubles);
    EXPECT_EQ(drawn_array(1), (Floats{0.25F, 0, 0, 1})) << i;
    // Vertices of glBegin have the current attributes, also between draws of arrays, and elements the arrays'.
    EXPECT_EQ(drawn_point(), (Floats{-1, 0, 0, 1})) << i;
    EXPECT_EQ(drawn_array(0), (Floats{0.5F, 0, 0, 1})) << i;
    glClear(GL_COLOR_BUFFER_BIT);
    glBegin(GL_POINTS);
    glArrayElement(1);
    glEnd();
    EXPECT_EQ(float_pixel(), (Floats{0.25F, 0, 0, 1})) << i;
    glDisableClientState(array);
    glVertexAttrib4fNV(i, -2, 0, 0, 1);
    EXPECT_EQ(drawn_array(1), (Floats{-2, 0, 0, 1})) << i;
  }
  GLint value = 0;
  glGetVertexAttribivNV(3, GL_ATTRIB_ARRAY_TYPE_NV, &value);
  EXPECT_EQ(value, GL_DOUBLE);
  void* pointer = nullptr;
  glGetVertexAttribPointervNV(3, GL_ATTRIB_ARRAY_POINTER_NV, &pointer);
  EXPECT_EQ(pointer, kDoubles);
}

TEST(LayerVertexProgramState, ArraysInDisplayLists) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  GLfloat position[4]{0, 0, 0, 1}, colors[4]{1, 2, 3, 4};
  glVertexAttribPointerNV(0, 4, GL_FLOAT, 0, position);
  glVertexAttribPointerNV(3, 4, GL_FLOAT, 0, colors);
  ASSERT_EQ(use_vertex_program(1, showing("MOV o[TEX0], v[COL0];")), kNoError);
  for (const GLenum mode : {GLenum{GL_COMPILE}, GLenum{GL_COMPILE_AND_EXECUTE}}) {
    colors[0] = 1;
    glEnableClientState(GL_VERTEX_ATTRIB_ARRAY0_NV);
    glEnableClientState(GL_VERTEX_ATTRIB_ARRAY3_NV);
    glClear(GL_COLOR_BUFFER_BIT);
    glNewList(1, mode);
    glDrawArrays(GL_POINTS, 0, 1);
    glEndList();
    EXPECT_EQ(float_pixel(), mode == GL_COMPILE ? Floats{} : (Floats{1, 2, 3, 4}));
    glNewList(2, mode);
    glColor4f(7, 7, 7, 7);
    glBegin(GL_POINTS);
    glVertex2f(0, 0);
    glEnd();
    glEndList();
    colors[0] = 100;
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
    for (const bool with_array : {true, false}) {
      if (!with_array) glDisableClientState(GL_VERTEX_ATTRIB_ARRAY3_NV);
      glColor4f(5, 5, 5, 5);
      glCallList(1);
      EXPECT_EQ(float_pixel(), (Floats{1, 2, 3, 4})) << with_array;
      glCallList(2);
      EXPECT_EQ(float_pixel(), (Floats{7, 7, 7, 7})) << with_array;
      EXPECT_EQ(drawn_array(), with_array ? (Floats{100, 2, 3, 4}) : (Floats{7, 7, 7, 7}));
    }
    glPopClientAttrib();
    EXPECT_EQ(drawn_array(), (Floats{100, 2, 3, 4}));
  }
}

}  // namespace
}  // namespace ninebit::test
