// Several contexts: each with its own state, display lists that are shared, threads, and no context at all.
#include <EGL/egl.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "combiner_tests/gl_layer/combiner_commands.h"
#include "combiner_tests/gl_layer/pictures.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

GLint general_combiners() {
  return integer_of(GL_NUM_GENERAL_COMBINERS_NV);
}

TEST(LayerContexts, EachHasItsOwnState) {
  NINEBIT_GL_CONTEXT(first, profiles::geforce2);
  show_constant({1, 0, 0, 1});
  glPushAttrib(GL_TEXTURE_BIT);
  const auto second = GlContext::make(why_not, profiles::nv2a);
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  show_constant({0, 1, 0, 1});
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 7);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 99);  // its error stays in this context
  draw_square();
  first->make_current();
  EXPECT_EQ(glGetError(), kNoError);
  EXPECT_EQ(general_combiners(), 1);
  EXPECT_EQ(drawn_pixel(), (Pixel{255, 0, 0, 255}));
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  second->make_current();
  EXPECT_EQ(glGetError(), kInvalidValue);
  EXPECT_EQ(general_combiners(), 7);
  EXPECT_EQ(center_pixel(), (Pixel{0, 255, 0, 255}));
  glPopAttrib();
  EXPECT_EQ(glGetError(), kStackUnderflow);
  first->make_current();
  glPopAttrib();
  EXPECT_EQ(glGetError(), kNoError);
  EXPECT_EQ(general_combiners(), 1);
  // Both draw in turn, and neither disturbs the other.
  for (int i = 0; i < 10; ++i) {
    const GLfloat level = static_cast<GLfloat>(i) / 15.0F, color[]{level, level, level, 1.0F};
    const auto byte = static_cast<std::uint8_t>(17 * i);
    first->make_current();
    glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, color);
    second->make_current();
    EXPECT_EQ(drawn_pixel(), (Pixel{0, 255, 0, 255})) << i;
    first->make_current();
    EXPECT_EQ(drawn_pixel(), (Pixel{byte, byte, byte, 255})) << i;
  }
}

TEST(LayerContexts, ListsAreShared) {
  NINEBIT_GL_CONTEXT(first);
  glNewList(1, GL_COMPILE);
  show_constant({0, 0, 1, 1});
  draw_square();
  glEndList();
  const auto sharing = GlContext::make(why_not, profiles::nv2a, first.get());
  ASSERT_NE(sharing, nullptr);
  // The sharing context has not used combiners itself.
  glCallList(1);
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_TRUE);
  EXPECT_EQ(center_pixel(), (Pixel{0, 0, 255, 255}));
  const auto third = GlContext::make(why_not, profiles::nv2a, sharing.get());
  const GLubyte numbers[]{1};
  glCallLists(1, GL_UNSIGNED_BYTE, numbers);
  EXPECT_EQ(center_pixel(), (Pixel{0, 0, 255, 255}));
  glNewList(1, GL_COMPILE);
  show_constant({1, 1, 0, 1});
  draw_square();
  glEndList();
  first->make_current();
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  glCallList(1);
  EXPECT_EQ(center_pixel(), (Pixel{255, 255, 0, 255}));
  glDeleteLists(1, 1);
  sharing->make_current();
  EXPECT_EQ(glIsList(1), GL_FALSE);
  clear_picture();
  glCallList(1);
  EXPECT_EQ(center_pixel(), (Pixel{0, 0, 0, 0}));
  const auto alone = GlContext::make(why_not);
  glCallList(1);
  EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
  EXPECT_EQ(glGetError(), kNoError);
}

// Draws with programs and constants of its own; returns how many pictures were wrong.
int draw_in_thread(const GlContext& context, int first_level) {
  context.make_current();
  int wrong = 0;
  for (int i = 0; i < 60; ++i) {
    const auto byte = static_cast<std::uint8_t>((first_level + i) & 255);
    const GLfloat level = static_cast<GLfloat>(byte) / 255.0F;
    if (i % 3 == 0) {
      show_register(GL_PRIMARY_COLOR_NV);
      glColor4f(level, level, level, level);
    } else {
      show_constant({level, level, level, level});
    }
    if (i % 5 == 0) {
      glNewList(static_cast<GLuint>(first_level), GL_COMPILE);
      glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, i & 1);
      draw_square();
      glEndList();
    }
    i % 5 == 0 ? glCallList(static_cast<GLuint>(first_level)) : draw_square();
    for (const Pixel& pixel : read_picture()) wrong += pixel == Pixel{byte, byte, byte, byte} ? 0 : 1;
    glCombinerParameteriNV(GL_SPARE0_NV, 0);
    if (glGetError() != GL_INVALID_ENUM) ++wrong;
  }
  GlContext::release();
  return wrong;
}

TEST(LayerContexts, ThreadsDrawAtTheSameTime) {
  if (kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  for (const bool share : {false, true}) {
    NINEBIT_GL_CONTEXT(first);
    const auto second = GlContext::make(why_not, profiles::nv2a, share ? first.get() : nullptr);
    ASSERT_NE(second, nullptr);
    GlContext::release();
    std::atomic<int> wrong{0};
    std::thread one([&] { wrong += draw_in_thread(*first, 10); });
    std::thread two([&] { wrong += draw_in_thread(*second, 90); });
    one.join();
    two.join();
    EXPECT_EQ(wrong, 0) << "sharing: " << share;
  }
}

// A context changes its thread and keeps its state.
TEST(LayerContexts, AContextMovesToAnotherThread) {
  NINEBIT_GL_CONTEXT(context);
  show_constant({0, 1, 0, 1});
  GlContext::release();
  Pixel pixel{};
  std::thread([&] {
    context->make_current();
    draw_square();
    pixel = center_pixel();
    GlContext::release();
  }).join();
  EXPECT_EQ(pixel, (Pixel{0, 255, 0, 255}));
}

// The driver destroys a context that is current when it is no longer current.
TEST(LayerContexts, DestroyedWhileCurrent) {
  NINEBIT_GL_CONTEXT(first);
  show_constant({0, 1, 0, 1});
  eglDestroyContext(eglGetCurrentDisplay(), eglGetCurrentContext());
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 255, 0, 255}));
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 4);
  EXPECT_EQ(general_combiners(), 4);
  // A new one, perhaps at the same address, begins with the defaults.
  for (int i = 0; i < 4; ++i) {
    const auto next = GlContext::make(why_not);
    EXPECT_EQ(general_combiners(), 1);
    EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 4);
  }
}

// Without a context nothing happens, and nothing is written.
TEST(LayerContexts, NoContext) {
  NINEBIT_GL_CONTEXT(context);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  for (const bool release_thread : {false, true}) {
    if (release_thread) {
      context->make_current();
      eglReleaseThread();
      eglBindAPI(EGL_OPENGL_API);
    } else {
      GlContext::release();
    }
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
      const CombinerCommand command = random_command(random, profiles::nv2a, false);
      EXPECT_EQ(execute(kLayerFunctions, command), (std::array<GLfloat, 4>{-1, -1, -1, -1}));
    }
    EXPECT_EQ(general_combiners(), -2);
    EXPECT_EQ(glIsEnabled(GL_REGISTER_COMBINERS_NV), GL_FALSE);
    glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);
    glNewList(1, GL_COMPILE);
    glCallList(1);
    glEndList();
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glPopAttrib();
    glDeleteLists(1, 1);
    glUseProgram(0);
    draw_square();
    glRectf(0, 0, 1, 1);
    EXPECT_EQ(glGetString(GL_EXTENSIONS), nullptr);
    EXPECT_EQ(glGetStringi(GL_EXTENSIONS, 0), nullptr);
  }
  context->make_current();
  EXPECT_EQ(general_combiners(), 2);
}

}  // namespace
}  // namespace ninebit::test
