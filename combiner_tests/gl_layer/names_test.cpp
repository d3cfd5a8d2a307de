// The driver's objects that the layer makes: a program that never got their names can neither see nor change them, and
// they go with their context.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

constexpr Pixel kShown{0, 0, 255, 255};

// Two programs of the layer; the second shows blue.
void draw_by_two_programs() {
  show_register(GL_PRIMARY_COLOR_NV);
  draw_square();
  show_constant({0, 0, 1, 1});
  draw_square();
}

// The driver's own glIsProgram, behind the layer's back; nullptr: it is not found here.
using IsProgram = GLboolean (*)(GLuint);
IsProgram drivers_is_program() {
  void* const library = dlopen("libc.so.6", RTLD_LAZY);
  for (const char* version : {"GLIBC_2.34", "GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.0"}) {
    void* const find = library != nullptr ? dlvsym(library, "dlsym", version) : nullptr;
    if (find == nullptr) continue;
    void* const driver = dlopen("libGL.so.1", RTLD_LAZY);
    return reinterpret_cast<IsProgram>(reinterpret_cast<void* (*)(void*, const char*)>(find)(driver, "glIsProgram"));
  }
  return nullptr;
}

GLenum error_of_use(GLuint program) {
  glUseProgram(program);
  return glGetError();
}

TEST(LayerNames, ProgramsAreHidden) {
  NINEBIT_GL_CONTEXT(context);
  const GLuint before = make_green_program();
  draw_by_two_programs();
  for (GLuint name = before + 1; name < before + 60; ++name) {
    EXPECT_EQ(glIsProgram(name), GL_FALSE) << name;
    EXPECT_EQ(glIsShader(name), GL_FALSE) << name;
    EXPECT_EQ(error_of_use(name), kInvalidValue) << name;
    GLint value = -1;
    glGetProgramiv(name, GL_LINK_STATUS, &value);
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
    EXPECT_EQ(value, -1) << name;
    glLinkProgram(name);
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
    glDeleteProgram(name);
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
  }
  clear_picture();
  EXPECT_EQ(drawn_pixel(), kShown);
  show_register(GL_PRIMARY_COLOR_NV);
  glColor4f(1, 0, 0, 1);
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 0, 0, 255}));
  // The program's own is its own.
  EXPECT_EQ(glIsProgram(before), GL_TRUE);
  EXPECT_EQ(error_of_use(before), kNoError);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 255, 0, 255}));
  glUseProgram(0);
  glDeleteProgram(before);
  EXPECT_EQ(glIsProgram(before), GL_FALSE);
}

TEST(LayerNames, UniformsOfTheLayersProgramsCannotBeSet) {
  NINEBIT_GL_CONTEXT(context);
  const GLuint before = make_green_program();
  draw_by_two_programs();
  const std::array<GLint, 256> zeros{};
  const std::array<GLfloat, 256> zero_floats{};
  for (GLint location = -1; location < 4; ++location) {
    for (GLsizei count = 1; count <= 32; ++count) {
      glUniform4iv(location, count, zeros.data());
      EXPECT_EQ(glGetError(), kInvalidOperation) << location << " " << count;
    }
    glUniform4f(location, 0, 0, 0, 0);
    EXPECT_EQ(glGetError(), kInvalidOperation) << location;
    glUniform1i(location, 3);
    EXPECT_EQ(glGetError(), kInvalidOperation) << location;
    glUniform4fvARB(location, 1, zero_floats.data());
    EXPECT_EQ(glGetError(), kInvalidOperation) << location;
    glUniformMatrix4fv(location, 1, GL_FALSE, zero_floats.data());
    EXPECT_EQ(glGetError(), kInvalidOperation) << location;
  }
  const IsProgram is_program = drivers_is_program();
  ASSERT_NE(is_program, nullptr);
  int hidden = 0;
  for (GLuint name = before + 1; name < before + 10; ++name) {
    hidden += is_program(name) == GL_TRUE ? 1 : 0;
    glProgramUniform4iv(name, 0, 1, zeros.data());
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
    GLint resources = -1;
    glGetProgramInterfaceiv(name, GL_UNIFORM, GL_ACTIVE_RESOURCES, &resources);
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
    EXPECT_EQ(resources, -1) << name;
    glProgramParameteri(name, GL_PROGRAM_SEPARABLE, GL_TRUE);
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
    glBindFragDataLocation(name, 0, "color");
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
    std::array<char, 9> label{};
    glGetObjectLabel(GL_PROGRAM, name, 9, nullptr, label.data());
    EXPECT_EQ(glGetError(), kInvalidValue) << name;
  }
  EXPECT_GE(hidden, 2);
  // Also in a display list, which keeps the numbers.
  glNewList(7, GL_COMPILE);
  {
    const std::array<GLint, 4> gone{};
    glUniform4iv(0, 1, gone.data());
  }
  glEndList();
  EXPECT_EQ(glGetError(), kNoError);
  glCallList(7);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), kShown);
  // The program's own program takes them.
  const GLuint own = make_program("uniform vec4 color; void main() { gl_FragColor = color; }");
  glUseProgram(own);
  const GLint color = glGetUniformLocation(own, "color");
  glUniform4f(color, 1, 0, 1, 1);
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 0, 255, 255}));
  const std::array<GLfloat, 4> yellow{1, 1, 0, 1};
  glProgramUniform4fv(own, color, 1, yellow.data());
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 255, 0, 255}));
}

TEST(LayerNames, ProgramsGoWithTheirContext) {
  NINEBIT_GL_CONTEXT(first);
  draw_by_two_programs();
  for (int i = 0; i < 30; ++i) {
    auto sharing = GlContext::make(why_not, profiles::nv2a, first.get());
    ASSERT_NE(sharing, nullptr);
    draw_by_two_programs();
    if (i % 2 == 0) first->make_current();  // the context goes while another is current
    sharing.reset();
    first->make_current();
  }
  const IsProgram is_program = drivers_is_program();
  ASSERT_NE(is_program, nullptr);
  const GLuint next = glCreateProgram();
  int left = 0;
  for (GLuint name = 1; name < next; ++name) left += is_program(name) == GL_TRUE ? 1 : 0;
  EXPECT_EQ(left, 2);  // those of the first context
  EXPECT_EQ(drawn_pixel(), kShown);
}

TEST(LayerNames, ListsAreHidden) {
  NINEBIT_GL_CONTEXT(context);
  glNewList(7, GL_COMPILE);
  for (int i = 0; i < 3; ++i) {
    show_constant({0, 0, 1, 1});
    draw_square();
  }
  glEndList();
  constexpr GLuint kFirst = 0x3FFFF000U;
  for (GLuint name = kFirst; name < 0x40001000U; ++name) {
    ASSERT_EQ(glIsList(name), GL_FALSE) << name;
    glCallList(name);
  }
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  glNewList(kFirst + 5, GL_COMPILE);
  glEndList();
  glDeleteLists(kFirst, 0x2000);
  EXPECT_EQ(glIsList(kFirst + 5), GL_FALSE);
  EXPECT_EQ(glGetError(), kNoError);
  clear_picture();
  glCallList(7);
  EXPECT_EQ(center_pixel(), kShown);
  glDeleteLists(6, 2);
  EXPECT_EQ(glIsList(7), GL_FALSE);
  glDeleteLists(6, -1);
  EXPECT_EQ(glGetError(), kInvalidValue);
}

TEST(LayerNames, TheListThatIsCompiledHasItsNumber) {
  NINEBIT_GL_CONTEXT(context);
  const auto index = [] {
    GLfloat same = -1;
    glGetFloatv(GL_LIST_INDEX, &same);
    return std::array{static_cast<GLfloat>(integer_of(GL_LIST_INDEX)), same};
  };
  for (const GLenum mode : {GLenum{GL_COMPILE}, GLenum{GL_COMPILE_AND_EXECUTE}}) {
    glNewList(9, mode);
    show_constant({0, 0, 1, 1});
    EXPECT_EQ(index(), (std::array{9.0F, 9.0F}));
    glEndList();
    EXPECT_EQ(index(), (std::array{0.0F, 0.0F}));
  }
}

TEST(LayerNames, CallListsTakesNameZero) {
  NINEBIT_GL_CONTEXT(context);
  const GLubyte names[]{0, 9, 0};
  const auto error = [&] {
    glCallLists(3, GL_UNSIGNED_BYTE, names);
    return glGetError();
  };
  EXPECT_EQ(error(), kNoError);
  glNewList(9, GL_COMPILE);
  show_constant({0, 0, 1, 1});
  draw_square();
  glEndList();
  EXPECT_EQ(error(), kNoError);
  EXPECT_EQ(center_pixel(), kShown);
  glNewList(10, GL_COMPILE);
  glCallLists(3, GL_UNSIGNED_BYTE, names);
  glEndList();
  glCallList(10);
  EXPECT_EQ(glGetError(), kNoError);
  glCallList(0);  // the driver's own answer
  EXPECT_EQ(glGetError(), kInvalidValue);
}

}  // namespace
}  // namespace ninebit::test
