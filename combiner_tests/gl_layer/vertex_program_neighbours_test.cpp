// NV_vertex_program beside the functions that share its state: programs and attribute arrays of ARB_vertex_program,
// vertex array objects, display lists of before, other threads.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "combiner_tests/gl_layer/vertex_program_kit.h"

namespace ninebit::test {
namespace {

const std::string kShowsColor =
    "!!ARBvp1.0\nMOV result.position, vertex.position;\nMOV result.texcoord[0], vertex.color;\nEND";

GLenum arb_text(const std::string& text = kShowsColor) {
  glProgramStringARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(text.size()),
                     text.data());
  return glGetError();
}

Floats drawn_element(GLint number) {
  glClear(GL_COLOR_BUFFER_BIT);
  glBegin(GL_POINTS);
  glArrayElement(number);
  glEnd();
  return float_pixel();
}

constexpr GLfloat kAtCenter[8]{0, 0, 0, 1, 0, 0, 0, 1};

// glVertexAttribPointerARB has formats and places that the layer does not see when they are set.
TEST(LayerVertexProgramNeighbours, ElementsOfArraysThatOthersSet) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  ASSERT_EQ(use_vertex_program(1, showing("MOV o[TEX0], v[COL0];")), kNoError);
  const GLfloat first[8]{1, 2, 3, 4, 5, 6, 7, 8}, second[8]{9, 8, 7, 6, 5, 4, 3, 2};
  const GLubyte bytes[8]{};
  const GLint integers[8]{};
  glVertexAttribPointerNV(0, 4, GL_FLOAT, 0, kAtCenter);
  glEnableClientState(GL_VERTEX_ATTRIB_ARRAY0_NV);
  glVertexAttribPointerNV(3, 4, GL_FLOAT, 0, first);
  glEnableClientState(GL_VERTEX_ATTRIB_ARRAY3_NV);
  EXPECT_EQ(drawn_element(1), (Floats{5, 6, 7, 8}));
  glVertexAttribPointerARB(3, 4, GL_FLOAT, GL_FALSE, 0, second);
  EXPECT_EQ(drawn_element(0), (Floats{9, 8, 7, 6}));
  glArrayElement(1);
  EXPECT_EQ(drawn_point(), (Floats{5, 4, 3, 2})) << "outside of glBegin and glEnd it sets the current attribute";
  glColor4f(1, 3, 5, 7);
  glVertexAttribPointerARB(3, GL_BGRA, GL_UNSIGNED_BYTE, GL_TRUE, 0, bytes);
  EXPECT_EQ(drawn_element(1), (Floats{1, 3, 5, 7})) << "the log says that it stays";
  glVertexAttribPointerARB(3, 4, GL_INT, GL_FALSE, 0, integers);
  EXPECT_EQ(drawn_element(1), (Floats{1, 3, 5, 7}));
}

TEST(LayerVertexProgramNeighbours, ProgramsHaveTheSameNames) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  GLuint names[4]{}, fragments = 0;
  glGetProgramivARB(GL_FRAGMENT_PROGRAM_ARB, GL_PROGRAM_BINDING_ARB, reinterpret_cast<GLint*>(&fragments));
  ASSERT_EQ(use_vertex_program(5, showing("MOV o[TEX0], c[0];")), kNoError);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 2, 3, 4);
  glColor4f(8, 7, 6, 5);
  glGenProgramsARB(2, names);
  glGenProgramsNV(2, names + 2);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NE(names[i], 5U);
    EXPECT_NE(names[i], fragments);
    for (int k = 0; k < i; ++k) EXPECT_NE(names[i], names[k]);
  }
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, names[2]);
  EXPECT_EQ(arb_text(), kNoError) << "a name of either function takes either text";
  EXPECT_EQ(drawn_point(), (Floats{8, 7, 6, 5}));
  EXPECT_EQ(glIsProgramNV(names[2]), GL_TRUE);
  EXPECT_EQ(glIsProgramARB(5), GL_TRUE);
  glBindProgramARB(GL_VERTEX_PROGRAM_ARB, 5);
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4}));
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), 5);
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, names[2]);
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), static_cast<GLint>(names[2]));
  EXPECT_EQ(drawn_point(), (Floats{8, 7, 6, 5}));
  ASSERT_EQ(use_vertex_program(names[2], showing("MOV o[TEX0], c[0];")), kNoError);
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4})) << "a text of the other extension replaces it";
  // A fragment program's name.
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, fragments);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  EXPECT_EQ(use_vertex_program(fragments, showing("MOV o[TEX0], v[COL0];")), kInvalidOperation);
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4}));
  glBindProgramARB(GL_FRAGMENT_PROGRAM_ARB, 5);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  // Deleted by the other extension's function.
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, 5);
  const GLuint five = 5;
  glDeleteProgramsARB(1, &five);
  EXPECT_EQ(glIsProgramNV(5), GL_FALSE);
  EXPECT_EQ(glIsProgramARB(5), GL_FALSE);
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), 0);
  EXPECT_EQ(arb_text(), kNoError) << "program 0 is the driver's";
  EXPECT_EQ(drawn_point(), (Floats{8, 7, 6, 5}));
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, names[2]);
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, 0);
  EXPECT_EQ(arb_text(), kNoError);
  EXPECT_EQ(drawn_point(), (Floats{8, 7, 6, 5}));
}

TEST(LayerVertexProgramNeighbours, ArraysThatOtherFunctionsEnable) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  ASSERT_EQ(use_vertex_program(1, showing("MOV o[TEX0], v[COL0];")), kNoError);
  constexpr GLfloat kColors[4]{1, 2, 3, 4};
  const auto drawn = [] {
    glClear(GL_COLOR_BUFFER_BIT);
    glDrawArrays(GL_POINTS, 0, 1);
    return float_pixel();
  };
  glColor4f(8, 7, 6, 5);
  GLuint object = 0;
  glGenVertexArrays(1, &object);
  glVertexAttribPointerNV(0, 4, GL_FLOAT, 0, kAtCenter);
  glVertexAttribPointerNV(3, 4, GL_FLOAT, 0, kColors);
  for (const bool arb : {false, true}) {
    (arb ? glEnableVertexAttribArrayARB : glEnableVertexAttribArray)(0);
    (arb ? glEnableVertexAttribArrayARB : glEnableVertexAttribArray)(3);
    EXPECT_EQ(glIsEnabled(GL_VERTEX_ATTRIB_ARRAY3_NV), GL_TRUE);
    EXPECT_EQ(drawn(), (Floats{1, 2, 3, 4}));
    glBindVertexArray(object);
    EXPECT_EQ(glIsEnabled(GL_VERTEX_ATTRIB_ARRAY3_NV), GL_FALSE);
    EXPECT_EQ(drawn_point(), (Floats{8, 7, 6, 5}));
    glBindVertexArray(0);
    EXPECT_EQ(glIsEnabled(GL_VERTEX_ATTRIB_ARRAY3_NV), GL_TRUE);
    EXPECT_EQ(drawn(), (Floats{1, 2, 3, 4}));
    (arb ? glDisableVertexAttribArrayARB : glDisableVertexAttribArray)(3);
    EXPECT_EQ(integer_of(GL_VERTEX_ATTRIB_ARRAY3_NV), 0);
    EXPECT_EQ(drawn(), (Floats{8, 7, 6, 5}));
  }
}

// The list binds a program although the extension had not been used when it was compiled.
TEST(LayerVertexProgramNeighbours, ListsOfBeforeTheFirstCall) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  glBindProgramARB(GL_VERTEX_PROGRAM_ARB, 9);
  ASSERT_EQ(arb_text(), kNoError);
  glNewList(1, GL_COMPILE);
  glBindProgramARB(GL_VERTEX_PROGRAM_ARB, 9);
  glEndList();
  glColor4f(8, 7, 6, 5);
  ASSERT_EQ(use_vertex_program(1, showing("MOV o[TEX0], c[0];")), kNoError);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 2, 3, 4);
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4}));
  glCallList(1);
  EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), 9);
  EXPECT_EQ(drawn_point(), (Floats{8, 7, 6, 5}));
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, 1);
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4}));
}

TEST(LayerVertexProgramNeighbours, ErrorsInLists) {
  NINEBIT_VERTEX_CONTEXT(context);
  const GLubyte text[]{'!'};
  const std::pair<GLenum, void (*)(const GLubyte*)> cases[]{
      {GL_INVALID_ENUM, [](const GLubyte*) { glProgramParameter4fNV(GL_TEXTURE_2D, 0, 1, 2, 3, 4); }},
      {GL_INVALID_VALUE, [](const GLubyte*) { glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 96, 1, 2, 3, 4); }},
      {GL_INVALID_VALUE, [](const GLubyte*) { glVertexAttrib1fNV(16, 1); }},
      {GL_INVALID_VALUE, [](const GLubyte* of) { glLoadProgramNV(GL_VERTEX_PROGRAM_NV, 1, -1, of); }},
  };
  for (const auto& [error, command] : cases) {
    glNewList(1, GL_COMPILE);
    command(text);
    glEndList();
    EXPECT_EQ(glGetError(), kNoError);
    for (int i = 0; i < 2; ++i) {
      glCallList(1);
      EXPECT_EQ(glGetError(), error);
    }
  }
  glBegin(GL_POINTS);
  glLoadProgramNV(GL_VERTEX_PROGRAM_NV, 1, -1, text);
  glEnd();
  EXPECT_EQ(glGetError(), kInvalidOperation);
  // What the layer cannot ask for without a command in the list.
  glNewList(1, GL_COMPILE);
  glBegin(GL_POINTS);
  GLfloat value[4]{-1, -1, -1, -1};
  glGetVertexAttribfvNV(9, GL_CURRENT_ATTRIB_NV, value);
  glEnd();
  glEndList();
  EXPECT_EQ(value[0], -1);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  glActiveTexture(GL_TEXTURE2);
  glCallList(1);
  EXPECT_EQ(integer_of(GL_ACTIVE_TEXTURE), GL_TEXTURE2);
}

TEST(LayerVertexProgramNeighbours, MatrixModesKeepTheirNames) {
  NINEBIT_VERTEX_CONTEXT(context);
  glMatrixMode(GL_MATRIX0_ARB);
  EXPECT_EQ(integer_of(GL_MATRIX_MODE), GL_MATRIX0_ARB);
  glMatrixMode(GL_MATRIX0_NV);
  EXPECT_EQ(integer_of(GL_MATRIX_MODE), GL_MATRIX0_NV);
  glMatrixMode(GL_MODELVIEW);
  EXPECT_EQ(integer_of(GL_MATRIX_MODE), GL_MODELVIEW);
  glNewList(1, GL_COMPILE);
  glMatrixMode(GL_MATRIX1_NV);
  glEndList();
  EXPECT_EQ(integer_of(GL_MATRIX_MODE), GL_MODELVIEW);
  glCallList(1);
  EXPECT_EQ(integer_of(GL_MATRIX_MODE), GL_MATRIX1_NV);
}

// One context loads other texts while another draws: each pixel is of one of the texts.
TEST(LayerVertexProgramNeighbours, TextsThatAnotherThreadReplaces) {
  NINEBIT_VERTEX_CONTEXT(first);
  const auto second = GlContext::make(why_not, profiles::nv2a, first.get());
  ASSERT_NE(second, nullptr);
  const std::string texts[]{showing("MOV o[TEX0], c[1];"), showing("MOV o[TEX0], c[2];")};
  ASSERT_EQ(use_vertex_program(4, texts[0]), kNoError);
  GlContext::release();
  std::atomic<bool> done = false;
  std::thread loader([&] {
    first->make_current();
    for (int i = 0; i < 300; ++i) EXPECT_EQ(use_vertex_program(4, texts[i % 2]), kNoError);
    done = true;
    GlContext::release();
  });
  second->make_current();
  show_coordinates();
  glEnable(GL_VERTEX_PROGRAM_NV);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 1, 1, 1, 1, 1);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 2, 2, 2, 2, 2);
  do {
    glBindProgramNV(GL_VERTEX_PROGRAM_NV, 4);
    const Floats drawn = drawn_point();
    EXPECT_TRUE(drawn == (Floats{1, 1, 1, 1}) || drawn == (Floats{2, 2, 2, 2})) << drawn[0];
  } while (!done);
  EXPECT_EQ(glGetError(), kNoError);
  loader.join();
}

}  // namespace
}  // namespace ninebit::test
