// The extensions that --extensions adds: fences, the vertex array range, and the older names of shadow maps.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "combiner_tests/gl_layer/pictures.h"

extern "C" {
void* glXAllocateMemoryNV(GLsizei, GLfloat, GLfloat, GLfloat);
void glXFreeMemoryNV(void*);
}

namespace ninebit::test {
namespace {

bool is_listed(const std::string& name) {
  const std::string all = std::string(" ") + reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS)) + ' ';
  return all.find(' ' + name + ' ') != std::string::npos;
}

TEST(LayerExtras, AreListedIfTheyAreWanted) {
  const char* const names[]{"GL_NV_fence", "GL_NV_vertex_array_range", "GL_SGIX_depth_texture",
                            "GL_SGIX_shadow"};  // vertex_program_state_test.cpp has its own
  const std::pair<const char*, int> lists[]{
      {"none", 0}, {"all", 15}, {"NV_fence,GL_SGIX_shadow", 9}, {"GL_NV_fences,SGIX_depth_texture", 0}, {"", 0}};
  for (const auto& [list, expected] : lists) {
    const WithExtensions wanted(list);
    NINEBIT_GL_CONTEXT(context);
    int bits = 0;
    for (int i = 0; i < 4; ++i) bits |= is_listed(names[i]) ? 1 << i : 0;
    EXPECT_EQ(bits, expected) << list;
    integer_of(GL_VERTEX_ARRAY_RANGE_LENGTH_NV);
    EXPECT_EQ(glGetError(), (bits & 2) != 0 ? kNoError : kInvalidEnum) << list;
    GLuint fence = 0;
    glGenFencesNV(1, &fence);  // without the extension nothing happens
    EXPECT_EQ(fence, static_cast<GLuint>(bits & 1)) << list;
    EXPECT_EQ(glGetError(), kNoError) << list;
  }
}

TEST(LayerExtras, Fences) {
  const WithExtensions wanted("all");
  NINEBIT_GL_CONTEXT(context);
  GLuint fences[3]{};
  glGenFencesNV(3, fences);
  EXPECT_NE(fences[0], fences[1]);
  EXPECT_EQ(glIsFenceNV(fences[0]), GL_FALSE) << "it was never set";
  EXPECT_EQ(glTestFenceNV(fences[0]), GL_TRUE);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  glFinishFenceNV(fences[0]);
  EXPECT_EQ(glGetError(), kInvalidOperation);
  glSetFenceNV(fences[0], GL_FENCE_STATUS_NV);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  glSetFenceNV(fences[0], GL_ALL_COMPLETED_NV);
  EXPECT_EQ(glIsFenceNV(fences[0]), GL_TRUE);
  EXPECT_EQ(glTestFenceNV(fences[0]), GL_TRUE);
  glFinishFenceNV(fences[0]);
  GLint status = -1, condition = -1;
  glGetFenceivNV(fences[0], GL_FENCE_STATUS_NV, &status);
  glGetFenceivNV(fences[0], GL_FENCE_CONDITION_NV, &condition);
  EXPECT_EQ(status, GL_TRUE);
  EXPECT_EQ(condition, GL_ALL_COMPLETED_NV);
  EXPECT_EQ(glGetError(), kNoError);
  glGetFenceivNV(fences[0], GL_ALL_COMPLETED_NV, &condition);
  EXPECT_EQ(glGetError(), kInvalidEnum);
  glNewList(1, GL_COMPILE);
  glSetFenceNV(fences[1], GL_ALL_COMPLETED_NV);
  glEndList();
  EXPECT_EQ(glIsFenceNV(fences[1]), GL_FALSE) << "the list was not called";
  glCallList(1);
  EXPECT_EQ(glIsFenceNV(fences[1]), GL_TRUE);
  glBegin(GL_POINTS);
  glSetFenceNV(fences[2], GL_ALL_COMPLETED_NV);
  glEnd();
  EXPECT_EQ(glGetError(), kInvalidOperation);
  glDeleteFencesNV(3, fences);
  EXPECT_EQ(glIsFenceNV(fences[0]), GL_FALSE);
  glDeleteFencesNV(-1, fences);
  EXPECT_EQ(glGetError(), kInvalidValue);
  glGenFencesNV(-1, fences);
  EXPECT_EQ(glGetError(), kInvalidValue);
}

TEST(LayerExtras, VertexArrayRange) {
  const WithExtensions wanted("all");
  NINEBIT_GL_CONTEXT(context);
  void* const memory = glXAllocateMemoryNV(4096, 0.0F, 0.0F, 1.0F);
  ASSERT_NE(memory, nullptr);
  EXPECT_EQ(glXAllocateMemoryNV(-1, 0.0F, 0.0F, 1.0F), nullptr);
  glVertexArrayRangeNV(4096, memory);
  glEnableClientState(GL_VERTEX_ARRAY_RANGE_NV);
  EXPECT_EQ(glIsEnabled(GL_VERTEX_ARRAY_RANGE_NV), GL_TRUE);
  GLvoid* pointer = nullptr;
  glGetPointerv(GL_VERTEX_ARRAY_RANGE_POINTER_NV, &pointer);
  EXPECT_EQ(integer_of(GL_VERTEX_ARRAY_RANGE_LENGTH_NV), 4096);
  EXPECT_EQ(integer_of(GL_VERTEX_ARRAY_RANGE_VALID_NV), 1);
  EXPECT_GE(integer_of(GL_MAX_VERTEX_ARRAY_RANGE_ELEMENT_NV), 65535);
  EXPECT_EQ(pointer, memory);
  // What is written after a draw call is not drawn.
  constexpr GLfloat kSquare[]{-1, -1, 1, -1, 1, 1, -1, 1}, kNowhere[8]{};
  std::memcpy(memory, kSquare, sizeof(kSquare));
  glVertexPointer(2, GL_FLOAT, 0, memory);
  glEnableClientState(GL_VERTEX_ARRAY);
  show_constant({0, 1, 0, 1});
  glDrawArrays(GL_QUADS, 0, 4);
  glSetFenceNV(1, GL_ALL_COMPLETED_NV);
  while (glTestFenceNV(1) == GL_FALSE) {
  }
  std::memcpy(memory, kNowhere, sizeof(kNowhere));
  glFlushVertexArrayRangeNV();
  EXPECT_EQ(center_pixel(), (Pixel{0, 255, 0, 255}));
  glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
  glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
  glDisableClientState(GL_VERTEX_ARRAY_RANGE_NV);
  glVertexArrayRangeNV(0, nullptr);
  glPopClientAttrib();
  EXPECT_EQ(glIsEnabled(GL_VERTEX_ARRAY_RANGE_NV), GL_FALSE) << "pixels alone were saved";
  glPopClientAttrib();
  EXPECT_EQ(glIsEnabled(GL_VERTEX_ARRAY_RANGE_NV), GL_TRUE);
  EXPECT_EQ(glGetError(), kNoError);
  glVertexArrayRangeNV(-1, memory);
  EXPECT_EQ(glGetError(), kInvalidValue);
  glXFreeMemoryNV(memory);
}

// A shadow map by the names of SGIX is that of ARB.
TEST(LayerExtras, ShadowMaps) {
  const WithExtensions wanted("all");
  NINEBIT_GL_CONTEXT(context);
  constexpr GLenum kCompareSgix = 0x819A, kOperatorSgix = 0x819B;
  constexpr GLint kLequalSgix = 0x819C, kGequalSgix = 0x819D;
  const GLfloat half = 0.5F;
  glTexImage2D(GL_TEXTURE_2D, 0, 0x81A6, 1, 1, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &half);  // GL_DEPTH_COMPONENT24_SGIX
  use_nearest(GL_TEXTURE_2D);
  glEnable(GL_TEXTURE_2D);
  glMatrixMode(GL_TEXTURE);
  const auto shown = [](GLfloat reference) {
    glLoadIdentity();
    glTranslatef(0, 0, reference);
    draw_square();
    return center_pixel()[0];
  };
  const auto get = [](GLenum name) {
    GLint value = -1;
    GLfloat same = -1;
    glGetTexParameteriv(GL_TEXTURE_2D, name, &value);
    glGetTexParameterfv(GL_TEXTURE_2D, name, &same);
    EXPECT_EQ(static_cast<GLfloat>(value), same);
    return value;
  };
  for (const bool combiners : {false, true}) {
    if (combiners) show_register(GL_TEXTURE0);
    glTexParameteri(GL_TEXTURE_2D, kCompareSgix, GL_TRUE);
    glTexParameterf(GL_TEXTURE_2D, kOperatorSgix, static_cast<GLfloat>(kLequalSgix));
    EXPECT_EQ(get(kCompareSgix), 1);
    EXPECT_EQ(get(kOperatorSgix), kLequalSgix);
    EXPECT_EQ(shown(0.25F), 255) << combiners;
    EXPECT_EQ(shown(0.75F), 0) << combiners;
    const GLint other = kGequalSgix;
    glTexParameteriv(GL_TEXTURE_2D, kOperatorSgix, &other);
    EXPECT_EQ(get(kOperatorSgix), kGequalSgix);
    EXPECT_EQ(shown(0.25F), 0) << combiners;
    EXPECT_EQ(shown(0.75F), 255) << combiners;
    const GLfloat off = 0;
    glTexParameterfv(GL_TEXTURE_2D, kCompareSgix, &off);
    EXPECT_EQ(get(kCompareSgix), 0);
    EXPECT_EQ(shown(0.25F), shown(0.75F)) << combiners;
  }
  EXPECT_EQ(glGetError(), kNoError);
  glTexParameteri(GL_TEXTURE_2D, kOperatorSgix, GL_LEQUAL);
  EXPECT_EQ(glGetError(), kInvalidEnum);
}

}  // namespace
}  // namespace ninebit::test
