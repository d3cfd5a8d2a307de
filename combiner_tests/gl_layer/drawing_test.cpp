// Every way to draw takes the combiners' colour.
#include <gtest/gtest.h>

#include <functional>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

constexpr GLfloat kCorners[]{-1, -1, 1, -1, 1, 1, -1, 1};
constexpr GLubyte kFan[]{0, 1, 2, 3};

struct WayToDraw {
  const char* name;
  std::function<void()> draw;
};

void set_corners() {
  glEnableClientState(GL_VERTEX_ARRAY);
  glVertexPointer(2, GL_FLOAT, 0, kCorners);
}

std::vector<WayToDraw> ways_of_immediate_mode() {
  static const GLdouble low_d[]{-1, -1}, high_d[]{1, 1};
  static const GLfloat low_f[]{-1, -1}, high_f[]{1, 1};
  static const GLint low_i[]{-1, -1}, high_i[]{1, 1};
  static const GLshort low_s[]{-1, -1}, high_s[]{1, 1};
  const auto mesh = [](GLenum mode) {
    const GLfloat points[]{-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0};
    glEnable(GL_MAP2_VERTEX_3);
    glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 2, 0, 1, 6, 2, points);
    glMapGrid2f(4, 0, 1, 4, 0, 1);
    glEvalMesh2(mode, 0, 4, 0, 4);
  };
  const auto curve = [] {
    const GLfloat points[]{-1, 0.03F, 0, 1, 0.03F, 0};
    glEnable(GL_MAP1_VERTEX_3);
    glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 2, points);
    glMapGrid1f(20, 0, 1);
    glEvalMesh1(GL_LINE, 0, 20);
  };
  return {
      {"glBegin", [] { draw_square(); }},
      {"glRectd", [] { glRectd(-1, -1, 1, 1); }},
      {"glRectf", [] { glRectf(-1, -1, 1, 1); }},
      {"glRecti", [] { glRecti(-1, -1, 1, 1); }},
      {"glRects", [] { glRects(-1, -1, 1, 1); }},
      {"glRectdv", [] { glRectdv(low_d, high_d); }},
      {"glRectfv", [] { glRectfv(low_f, high_f); }},
      {"glRectiv", [] { glRectiv(low_i, high_i); }},
      {"glRectsv", [] { glRectsv(low_s, high_s); }},
      {"glEvalMesh1", curve},
      {"glEvalMesh2", [mesh] { mesh(GL_FILL); }},
  };
}

std::vector<WayToDraw> ways_of_arrays() {
  static const GLint firsts[]{0, 0};
  static const GLsizei counts[]{3, 4};
  static const void* const indices[]{kFan, kFan};
  const auto buffers = [] {
    GLuint names[2]{};
    glGenBuffers(2, names);
    glBindBuffer(GL_ARRAY_BUFFER, names[0]);
    glBufferData(GL_ARRAY_BUFFER, sizeof kCorners, kCorners, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, names[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof kFan, kFan, GL_STATIC_DRAW);
    glVertexPointer(2, GL_FLOAT, 0, nullptr);
    glDrawElements(GL_TRIANGLE_FAN, 4, GL_UNSIGNED_BYTE, nullptr);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glDeleteBuffers(2, names);
    set_corners();
  };
  const auto element = [] {
    glBegin(GL_TRIANGLE_FAN);
    for (GLint i = 0; i < 4; ++i) glArrayElement(i);
    glEnd();
  };
  return {
      {"glDrawArrays", [] { glDrawArrays(GL_TRIANGLE_FAN, 0, 4); }},
      {"glDrawElements", [] { glDrawElements(GL_TRIANGLE_FAN, 4, GL_UNSIGNED_BYTE, kFan); }},
      {"glDrawRangeElements", [] { glDrawRangeElements(GL_TRIANGLE_FAN, 0, 3, 4, GL_UNSIGNED_BYTE, kFan); }},
      {"glMultiDrawArrays", [] { glMultiDrawArrays(GL_TRIANGLE_FAN, firsts, counts, 2); }},
      {"glMultiDrawElements", [] { glMultiDrawElements(GL_TRIANGLE_FAN, counts, GL_UNSIGNED_BYTE, indices, 2); }},
      {"glDrawArraysInstanced", [] { glDrawArraysInstanced(GL_TRIANGLE_FAN, 0, 4, 2); }},
      {"glDrawElementsInstanced", [] { glDrawElementsInstanced(GL_TRIANGLE_FAN, 4, GL_UNSIGNED_BYTE, kFan, 2); }},
      {"glDrawElementsBaseVertex", [] { glDrawElementsBaseVertex(GL_TRIANGLE_FAN, 4, GL_UNSIGNED_BYTE, kFan, 0); }},
      {"glDrawRangeElementsBaseVertex",
       [] { glDrawRangeElementsBaseVertex(GL_TRIANGLE_FAN, 0, 3, 4, GL_UNSIGNED_BYTE, kFan, 0); }},
      {"glArrayElement", element},
      {"buffers", buffers},
  };
}

std::vector<WayToDraw> ways_of_pixels() {
  static const std::vector<GLubyte> white(static_cast<std::size_t>(kPictureSize) * kPictureSize * 4, 255);
  return {
      {"glDrawPixels",
       [] {
         glRasterPos2f(-1, -1);
         glDrawPixels(kPictureSize, kPictureSize, GL_RGBA, GL_UNSIGNED_BYTE, white.data());
       }},
      {"glBitmap",
       [] {
         glRasterPos2f(-1, -1);
         glBitmap(kPictureSize, kPictureSize, 0, 0, 0, 0, white.data());
       }},
      {"glCopyPixels",
       [] {
         glRasterPos2f(-1, -1);
         glCopyPixels(0, 0, kPictureSize, kPictureSize, GL_COLOR);
       }},
  };
}

// Each way with a constant of its own, first without combiners and then with.
void expect_colors_of(const std::vector<WayToDraw>& ways, bool in_list) {
  std::uint8_t byte = 0;
  for (const WayToDraw& way : ways) {
    byte = static_cast<std::uint8_t>(byte + 11);
    glDisable(GL_REGISTER_COMBINERS_NV);
    clear_picture();
    glColor4ub(200, 100, 50, 25);
    way.draw();
    EXPECT_NE(center_pixel(), (Pixel{byte, 77, 33, 66})) << way.name;
    const GLfloat level = static_cast<GLfloat>(byte) / 255.0F;
    show_constant({level, 77.0F / 255.0F, 33.0F / 255.0F, 66.0F / 255.0F});
    clear_picture();
    if (in_list) {
      glNewList(1, GL_COMPILE);
      way.draw();
      glEndList();
      EXPECT_EQ(center_pixel(), (Pixel{0, 0, 0, 0})) << way.name << " is executed while it is compiled";
      glCallList(1);
    } else {
      way.draw();
    }
    EXPECT_EQ(center_pixel(), (Pixel{byte, 77, 33, 66})) << way.name << (in_list ? " in a list" : "");
    EXPECT_EQ(glGetError(), kNoError) << way.name;
  }
}

TEST(LayerDrawing, ImmediateMode) {
  NINEBIT_GL_CONTEXT(context);
  expect_colors_of(ways_of_immediate_mode(), false);
  expect_colors_of(ways_of_immediate_mode(), true);
}

TEST(LayerDrawing, Arrays) {
  NINEBIT_GL_CONTEXT(context);
  set_corners();
  auto ways = ways_of_arrays();
  expect_colors_of(ways, false);
  ways.resize(5);  // later versions of OpenGL leave their commands out of lists, and buffers are never in lists
  expect_colors_of(ways, true);
}

TEST(LayerDrawing, Pixels) {
  NINEBIT_GL_CONTEXT(context);
  expect_colors_of(ways_of_pixels(), false);
  expect_colors_of(ways_of_pixels(), true);
}

// What pixels and bitmaps give to combiners as the primary colour.
TEST(LayerDrawing, PrimaryColorOfPixels) {
  NINEBIT_GL_CONTEXT(context);
  show_register(GL_PRIMARY_COLOR_NV);
  std::vector<Pixel> pixels(static_cast<std::size_t>(kPictureSize) * kPictureSize);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    pixels[i] = {byte, static_cast<std::uint8_t>(255 - byte), 128, static_cast<std::uint8_t>(byte ^ 0x55)};
  }
  glRasterPos2f(-1, -1);
  glDrawPixels(kPictureSize, kPictureSize, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  EXPECT_EQ(differences(read_picture(), pixels), "");
  glColor4ub(12, 34, 56, 78);
  glRasterPos2f(-1, -1);  // takes the current colour
  glColor4ub(1, 1, 1, 1);
  const std::vector<GLubyte> bits(static_cast<std::size_t>(kPictureSize) * kPictureSize, 255);
  glBitmap(kPictureSize, kPictureSize, 0, 0, 0, 0, bits.data());
  EXPECT_EQ(center_pixel(), (Pixel{12, 34, 56, 78}));
}

}  // namespace
}  // namespace ninebit::test
