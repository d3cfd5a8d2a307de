// EXT_paletted_texture and EXT_shared_texture_palette: indices, palettes, what changes which textures, errors.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

constexpr GLubyte kColors[4][4]{{10, 20, 30, 40}, {50, 60, 70, 80}, {90, 100, 110, 120}, {130, 140, 150, 160}};
constexpr GLubyte kOthers[4][4]{{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};

// Adds EXT_paletted_texture, too.
constexpr const char* kBothExtensions = "EXT_shared_texture_palette";

void use_texture(GLenum target) {
  use_nearest(target);
  glEnable(target);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
}

// The pixel at a texture coordinate of the square.
Pixel shown_at(int x, int y) {
  clear_picture();
  draw_square();
  return read_picture()[static_cast<std::size_t>(y * kPictureSize + x)];
}

Pixel color(const GLubyte* c) {
  return {c[0], c[1], c[2], c[3]};
}

void set_palette(GLenum target, const GLubyte (&colors)[4][4]) {
  glColorTableEXT(target, GL_RGBA8, 4, GL_RGBA, GL_UNSIGNED_BYTE, colors);
}

TEST(LayerPalettes, IndicesAndPalettes) {
  const WithExtensions with_palettes(kBothExtensions);
  NINEBIT_GL_CONTEXT(context);
  use_texture(GL_TEXTURE_2D);
  constexpr GLubyte kIndices[4]{0, 1, 2, 7};  // 7 is 3 in a palette of four
  for (const bool combiners : {false, true}) {
    if (combiners) show_register(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 2, 2, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, kIndices);
    set_palette(GL_TEXTURE_2D, kColors);
    EXPECT_EQ(shown_at(2, 2), color(kColors[0]));
    EXPECT_EQ(shown_at(12, 2), color(kColors[1]));
    EXPECT_EQ(shown_at(2, 12), color(kColors[2]));
    EXPECT_EQ(shown_at(12, 12), color(kColors[3]));
    set_palette(GL_TEXTURE_2D, kOthers);  // without another image
    EXPECT_EQ(shown_at(12, 2), color(kOthers[1]));
    glColorSubTableEXT(GL_TEXTURE_2D, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, kColors[3]);
    EXPECT_EQ(shown_at(12, 2), (Pixel{130, 140, 150, 255}));
    EXPECT_EQ(shown_at(2, 2), color(kOthers[0]));
    const GLushort index = 3;
    glTexSubImage2D(GL_TEXTURE_2D, 0, 1, 0, 1, 1, GL_COLOR_INDEX, GL_UNSIGNED_SHORT, &index);
    EXPECT_EQ(shown_at(12, 2), color(kOthers[3]));
    EXPECT_EQ(shown_at(2, 12), color(kOthers[2]));
  }
  GLint value = 0;
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &value);
  EXPECT_EQ(value, GL_COLOR_INDEX8_EXT);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INDEX_SIZE_EXT, &value);
  EXPECT_EQ(value, 8);
  glGetColorTableParameterivEXT(GL_TEXTURE_2D, GL_COLOR_TABLE_WIDTH, &value);
  EXPECT_EQ(value, 4);
  glGetColorTableParameterivEXT(GL_TEXTURE_2D, GL_COLOR_TABLE_FORMAT, &value);
  EXPECT_EQ(value, GL_RGBA8);
  GLubyte got[4][4]{};
  glGetColorTableEXT(GL_TEXTURE_2D, GL_RGBA, GL_UNSIGNED_BYTE, got);
  EXPECT_EQ(color(got[3]), color(kOthers[3]));
}

TEST(LayerPalettes, PixelStoreAndTransfer) {
  const WithExtensions with_palettes(kBothExtensions);
  NINEBIT_GL_CONTEXT(context);
  use_texture(GL_TEXTURE_2D);
  set_palette(GL_TEXTURE_2D, kColors);
  // Rows of three with a skipped one, an index shift and an offset; the driver's scales do not reach the colours.
  constexpr GLubyte kIndices[9]{9, 9, 9, 9, 0, 1, 9, 1, 0};
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 3);
  glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, 1);
  glPixelTransferi(GL_INDEX_SHIFT, 1);
  glPixelTransferi(GL_INDEX_OFFSET, 1);
  glPixelTransferf(GL_RED_SCALE, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX4_EXT, 2, 2, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, kIndices);
  glPixelTransferf(GL_RED_SCALE, 1);
  EXPECT_EQ(shown_at(2, 2), color(kColors[1]));
  EXPECT_EQ(shown_at(12, 2), color(kColors[3]));
  EXPECT_EQ(shown_at(2, 12), color(kColors[3]));
  EXPECT_EQ(integer_of(GL_UNPACK_ROW_LENGTH), 3) << "the program's own stays";
}

TEST(LayerPalettes, SharedPalette) {
  const WithExtensions with_palettes(kBothExtensions);
  NINEBIT_GL_CONTEXT(context);
  const GLubyte index = 2;
  for (const GLuint name : {1U, 2U}) {
    glBindTexture(GL_TEXTURE_2D, name);
    use_texture(GL_TEXTURE_2D);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 1, 1, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index);
    set_palette(GL_TEXTURE_2D, kColors);
  }
  set_palette(GL_SHARED_TEXTURE_PALETTE_EXT, kOthers);
  EXPECT_EQ(shown_at(8, 8), color(kColors[2])) << "not enabled";
  glEnable(GL_SHARED_TEXTURE_PALETTE_EXT);
  EXPECT_EQ(glIsEnabled(GL_SHARED_TEXTURE_PALETTE_EXT), GL_TRUE);
  for (const GLuint name : {1U, 2U}) {
    glBindTexture(GL_TEXTURE_2D, name);
    EXPECT_EQ(shown_at(8, 8), color(kOthers[2])) << name;
  }
  glPushAttrib(GL_ENABLE_BIT);
  glDisable(GL_SHARED_TEXTURE_PALETTE_EXT);
  EXPECT_EQ(shown_at(8, 8), color(kColors[2]));
  glPopAttrib();
  EXPECT_EQ(shown_at(8, 8), color(kOthers[2]));
  glColorSubTableEXT(GL_SHARED_TEXTURE_PALETTE_EXT, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, kColors[0]);
  EXPECT_EQ(shown_at(8, 8), color(kColors[0]));
  // An image of colours is none of indices any more, and no palette changes it.
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, kOthers[3]);
  set_palette(GL_SHARED_TEXTURE_PALETTE_EXT, kColors);
  EXPECT_EQ(shown_at(8, 8), color(kOthers[3]));
}

TEST(LayerPalettes, DisplayLists) {
  const WithExtensions with_palettes(kBothExtensions);
  NINEBIT_GL_CONTEXT(context);
  use_texture(GL_TEXTURE_2D);
  GLubyte index = 1;
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 1, 1, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index);
  set_palette(GL_TEXTURE_2D, kColors);
  glNewList(1, GL_COMPILE);
  set_palette(GL_TEXTURE_2D, kOthers);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 1, 1, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index);
  glEndList();
  index = 3;
  EXPECT_EQ(shown_at(8, 8), color(kColors[1]));
  glCallList(1);
  EXPECT_EQ(shown_at(8, 8), color(kOthers[1]));
}

TEST(LayerPalettes, Errors) {
  const WithExtensions with_palettes(kBothExtensions);
  NINEBIT_GL_CONTEXT(context);
  GLubyte bytes[64]{};
  const auto expect = [](GLenum error, const char* what) { EXPECT_EQ(glGetError(), error) << what; };
  glColorTableEXT(GL_MODELVIEW, GL_RGBA, 4, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidEnum, "target");
  glColorTableEXT(GL_TEXTURE_2D, GL_DEPTH_COMPONENT, 4, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidEnum, "internal format");
  glColorTableEXT(GL_TEXTURE_2D, GL_RGBA, 3, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidValue, "3 is no power of two");
  glColorTableEXT(GL_TEXTURE_2D, GL_RGBA, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidValue, "no colours");
  glColorTableEXT(GL_TEXTURE_2D, GL_RGBA, 4, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidEnum, "format");
  glColorTableEXT(GL_TEXTURE_2D, GL_RGBA, 4, GL_RGBA, GL_BITMAP, bytes);
  expect(kInvalidEnum, "type");
  glColorSubTableEXT(GL_TEXTURE_2D, 0, 2, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidValue, "more than the palette has");
  glColorSubTableEXT(GL_TEXTURE_2D, -1, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidValue, "start");
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidOperation, "colours for indices");
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, -1, 1, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidValue, "size");
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidOperation, "there is no image of indices");
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 2, 2, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, bytes);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 1, 0, 2, 1, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, bytes);
  expect(kInvalidValue, "outside of the image");
  GLint value = 0;
  glGetColorTableParameterivEXT(GL_TEXTURE_2D, GL_TEXTURE_INDEX_SIZE_EXT, &value);
  expect(kInvalidEnum, "parameter");
  glGetColorTableEXT(GL_TEXTURE_2D, GL_RGBA, GL_UNSIGNED_SHORT, bytes);
  expect(kInvalidEnum, "type of what is read");
  glBegin(GL_POINTS);
  glColorTableEXT(GL_TEXTURE_2D, GL_RGBA, 4, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
  glEnd();
  expect(kInvalidOperation, "between glBegin and glEnd");
}

TEST(LayerPalettes, AreTheDriversWithoutTheExtension) {
  NINEBIT_GL_CONTEXT(context);
  const GLubyte index = 0;
  glTexImage2D(GL_TEXTURE_2D, 0, GL_COLOR_INDEX8_EXT, 1, 1, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, &index);
  EXPECT_NE(glGetError(), kNoError);
  glEnable(GL_SHARED_TEXTURE_PALETTE_EXT);
  EXPECT_EQ(glGetError(), kInvalidEnum);
}

}  // namespace
}  // namespace ninebit::test
