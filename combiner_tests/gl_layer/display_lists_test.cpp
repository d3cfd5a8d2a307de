// Display lists with commands of the combiners, one property each. Random ones: random_lists_test.cpp.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

constexpr Pixel kRed{255, 0, 0, 255}, kGreen{0, 255, 0, 255}, kBlue{0, 0, 255, 255};

void set_constant(GLfloat red, GLfloat green, GLfloat blue) {
  const GLfloat color[]{red, green, blue, 1.0F};
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, color);
}

// A list that makes a constant what is shown.
void make_constant_list(GLuint list, GLfloat red, GLfloat green, GLfloat blue) {
  glNewList(list, GL_COMPILE);
  set_constant(red, green, blue);
  glEndList();
}

GLint number_of_combiners() {
  return integer_of(GL_NUM_GENERAL_COMBINERS_NV);
}

TEST(LayerLists, CompilingExecutesNothing) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  make_constant_list(1, 0, 1, 0);
  EXPECT_EQ(glIsList(1), GL_TRUE);
  EXPECT_EQ(drawn_pixel(), kRed);
  glCallList(1);
  EXPECT_EQ(drawn_pixel(), kGreen);
  // Gets are executed at once.
  glNewList(2, GL_COMPILE);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 5);
  const GLint value = number_of_combiners();
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_TRUE);
  glEndList();
  EXPECT_EQ(value, 1);
  glCallList(2);
  EXPECT_EQ(number_of_combiners(), 5);
}

TEST(LayerLists, TwentyThousandConstants) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  glViewport(0, 0, 4, 4);
  glNewList(1, GL_COMPILE);
  for (int i = 0; i < 20000; ++i) {
    set_constant(0, static_cast<GLfloat>(i % 256) / 255, static_cast<GLfloat>(i / 256) / 255);
    glRectf(-1, -1, 1, 1);
  }
  glEndList();
  glCallList(1);
  Pixel last{};
  glReadPixels(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, last.data());
  EXPECT_EQ(last, (Pixel{0, 19999 % 256, 19999 / 256, 255}));
}

TEST(LayerLists, ErrorsAreRaisedWhenAListIsCalled) {
  NINEBIT_GL_CONTEXT(context);
  glNewList(1, GL_COMPILE);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 99);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, GL_LESS);
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, nullptr);
  glBegin(GL_POINTS);
  glEnable(GL_REGISTER_COMBINERS_NV);
  glEnd();
  glEndList();
  EXPECT_EQ(glGetError(), kNoError);
  glCallList(1);
  EXPECT_EQ(glGetError(), kInvalidValue);
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  glNewList(1, GL_COMPILE);
  glBegin(GL_POINTS);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  glEnable(GL_REGISTER_COMBINERS_NV);
  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
  glEnd();
  glEndList();
  EXPECT_EQ(glGetError(), kNoError);
  for (int i = 0; i < 2; ++i) {
    glCallList(1);
    EXPECT_EQ(glGetError(), kInvalidOperation);
    EXPECT_EQ(number_of_combiners(), 1);
  }
  glNewList(1, GL_COMPILE_AND_EXECUTE);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 0);
  EXPECT_EQ(glGetError(), kInvalidValue);
  glEndList();
}

TEST(LayerLists, WrongListCommands) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  glNewList(0, GL_COMPILE);
  EXPECT_EQ(glGetError(), kInvalidValue);
  glNewList(1, GL_RGBA);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  glEndList();
  EXPECT_EQ(glGetError(), kInvalidOperation);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);  // no list is open
  EXPECT_EQ(number_of_combiners(), 2);
  glNewList(1, GL_COMPILE);
  glNewList(2, GL_COMPILE_AND_EXECUTE);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);
  glEndList();
  EXPECT_EQ(number_of_combiners(), 2);
  glCallList(1);
  EXPECT_EQ(number_of_combiners(), 3);
  glBegin(GL_POINTS);
  glNewList(1, GL_COMPILE);
  glEndList();
  glEnd();
  EXPECT_EQ(glGetError(), kInvalidOperation);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 4);
  EXPECT_EQ(number_of_combiners(), 4);
}

// A list is one after its glEndList; one that it replaces is one until then. The layer has parts of it before.
TEST(LayerLists, AListIsOneAfterItsEnd) {
  NINEBIT_GL_CONTEXT(context);
  for (const GLboolean before : {GLboolean{GL_FALSE}, GLboolean{GL_TRUE}}) {
    SCOPED_TRACE(static_cast<int>(before));
    glNewList(1, GL_COMPILE);
    set_constant(0, 1, 0);
    EXPECT_EQ(glIsList(1), before);
    set_constant(0, 0, 1);
    EXPECT_EQ(glIsList(1), before);
    glEndList();
    EXPECT_EQ(glIsList(1), GL_TRUE);
  }
}

// The former list is deleted, and the one that is compiled is there after its end, with its first commands.
TEST(LayerLists, DeletedWhileItIsCompiled) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  make_constant_list(1, 0, 0, 1);
  glNewList(1, GL_COMPILE);
  glClearColor(0, 1, 0, 0);
  set_constant(0, 1, 0);
  glDeleteLists(1, 1);
  EXPECT_EQ(glIsList(1), GL_FALSE);
  glEndList();
  EXPECT_EQ(glIsList(1), GL_TRUE);
  glCallList(1);
  GLfloat clear[4];
  glGetFloatv(GL_COLOR_CLEAR_VALUE, clear);
  EXPECT_EQ(clear[1], 1);
  EXPECT_EQ(drawn_pixel(), kGreen);
}

// As an error of a program's own call, and as nothing where a list has it.
TEST(LayerLists, ACallOfListZero) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  glCallList(0);
  EXPECT_EQ(glGetError(), kInvalidValue);
  glNewList(1, GL_COMPILE);
  set_constant(0, 1, 0);
  glCallList(0);
  glEndList();
  EXPECT_EQ(glGetError(), kNoError);
  glCallList(1);
  EXPECT_EQ(glGetError(), kNoError);
  EXPECT_EQ(drawn_pixel(), kGreen);
}

TEST(LayerLists, RedefinitionAndDeletion) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  const GLuint list = glGenLists(3);
  make_constant_list(list, 0, 1, 0);
  make_constant_list(list, 0, 0, 1);
  glCallList(list);
  EXPECT_EQ(drawn_pixel(), kBlue);
  // To a list of the driver's commands alone, and back.
  glNewList(list, GL_COMPILE);
  glColor4ub(1, 2, 3, 4);
  glEndList();
  set_constant(1, 0, 0);
  glCallList(list);
  EXPECT_EQ(drawn_pixel(), kRed);
  make_constant_list(list, 0, 1, 0);
  make_constant_list(list + 1, 0, 0, 1);
  glDeleteLists(list, 1);
  EXPECT_EQ(glIsList(list), GL_FALSE);
  EXPECT_EQ(glIsList(list + 1), GL_TRUE);
  glCallList(list);
  EXPECT_EQ(drawn_pixel(), kRed);
  glCallList(list + 1);
  EXPECT_EQ(drawn_pixel(), kBlue);
  glDeleteLists(1, -1);
  EXPECT_EQ(glGetError(), kInvalidValue);
  glDeleteLists(0, 10000);
  set_constant(1, 0, 0);
  glCallList(list + 1);
  EXPECT_EQ(drawn_pixel(), kRed);
  // The layer's own lists are not in the way.
  const GLuint many = glGenLists(100000);
  EXPECT_NE(many, 0U);
  glDeleteLists(many, 100000);
  make_constant_list(list, 0, 1, 0);
  glCallList(list);
  EXPECT_EQ(drawn_pixel(), kGreen);
}

// Lists by number: the base is that of the call's execution, and every type works.
TEST(LayerLists, NumbersOfAllTypes) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  glListBase(0);
  make_constant_list(1000 + 0x0102, 0, 1, 0);
  make_constant_list(1000 + 7, 0, 0, 1);
  const auto expect = [&](GLenum type, const void* numbers, GLsizei n, const Pixel& pixel) {
    set_constant(1, 0, 0);
    glListBase(1000);
    glCallLists(n, type, numbers);
    EXPECT_EQ(drawn_pixel(), pixel) << std::hex << type;
    // The same from a list that was compiled with another base.
    glListBase(5);
    glNewList(1, GL_COMPILE);
    glCallLists(n, type, numbers);
    glEndList();
    set_constant(1, 0, 0);
    glListBase(1000);
    glCallList(1);
    EXPECT_EQ(drawn_pixel(), pixel) << std::hex << type << " in a list";
    glListBase(0);
  };
  const GLbyte bytes[]{7}, negative[]{-9};
  const GLubyte ubytes[]{7, 1, 2}, two[]{0, 7, 1, 2}, three[]{0, 1, 2}, four[]{0, 0, 1, 2};
  const GLshort shorts[]{7, 0x0102};
  const GLushort ushorts[]{0x0102, 7};
  const GLint ints[]{0x0102};
  const GLuint uints[]{0x0102, 7};
  const GLfloat floats[]{258.0F};
  expect(GL_BYTE, bytes, 1, kBlue);
  expect(GL_BYTE, negative, 1, kRed);
  expect(GL_UNSIGNED_BYTE, ubytes, 3, kBlue);
  expect(GL_2_BYTES, two, 2, kGreen);
  expect(GL_3_BYTES, three, 1, kGreen);
  expect(GL_4_BYTES, four, 1, kGreen);
  expect(GL_SHORT, shorts, 2, kGreen);
  expect(GL_UNSIGNED_SHORT, ushorts, 2, kBlue);
  expect(GL_INT, ints, 1, kGreen);
  expect(GL_UNSIGNED_INT, uints, 2, kBlue);
  expect(GL_FLOAT, floats, 1, kGreen);
  expect(GL_INT, nullptr, 0, kRed);
  EXPECT_EQ(glGetError(), kNoError);
  glCallLists(1, GL_DOUBLE, uints);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  glCallLists(-1, GL_INT, uints);
  EXPECT_EQ(glGetError(), kInvalidValue);
}

// A list that changes what shaders depend on, called before one that draws, both of the driver's commands alone.
TEST(LayerLists, AListChangesWhatTheNextOneNeeds) {
  NINEBIT_GL_CONTEXT(context);
  const Pixel texel{9, 99, 199, 149};
  set_texel(texel);
  glNewList(1, GL_COMPILE);
  glEnable(GL_TEXTURE_2D);
  glEndList();
  glNewList(2, GL_COMPILE);
  draw_square();
  glEndList();
  show_register(GL_TEXTURE0);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 255}));
  const GLubyte lists[]{1, 2};
  glCallLists(2, GL_UNSIGNED_BYTE, lists);
  EXPECT_EQ(center_pixel(), texel);
}

// A list with half of a pair of glBegin and glEnd: combiners refuse their commands until glEnd.
TEST(LayerLists, HalfABegin) {
  NINEBIT_GL_CONTEXT(context);
  glNewList(1, GL_COMPILE);
  glBegin(GL_POINTS);
  glEndList();
  glNewList(2, GL_COMPILE);
  glVertex2f(0, 0);
  glEnd();
  glEndList();
  const auto refused = [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
    glEnable(GL_REGISTER_COMBINERS_NV);
  };
  glCallList(1);
  refused();
  glCallList(2);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  EXPECT_EQ(number_of_combiners(), 1);
  glBegin(GL_POINTS);
  refused();
  glCallList(2);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  glCallList(1);
  refused();
  glEnd();
  EXPECT_EQ(glGetError(), kInvalidOperation);
  EXPECT_EQ(number_of_combiners(), 1);
  refused();
  EXPECT_EQ(glGetError(), kNoError);
  EXPECT_EQ(number_of_combiners(), 2);
  // glEndList between glBegin and glEnd of a list that executes.
  glNewList(3, GL_COMPILE_AND_EXECUTE);
  glBegin(GL_POINTS);
  glEndList();
  glEnd();
  EXPECT_EQ(glGetError(), kInvalidOperation);
  if (integer_of(GL_LIST_INDEX) != 0) glEndList();
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);
  EXPECT_EQ(number_of_combiners(), 3);
}

// A list that calls itself ends.
TEST(LayerLists, AListThatCallsItself) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({1, 0, 0, 1});
  glNewList(1, GL_COMPILE);
  set_constant(0, 1, 0);
  glCallList(1);
  glEndList();
  glCallList(1);
  EXPECT_EQ(drawn_pixel(), kGreen);
}

}  // namespace
}  // namespace ninebit::test
