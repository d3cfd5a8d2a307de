// Images of NV_texture_shader's formats: their pixel transfer, packed pixels, mip-maps, and completeness.
#include <gtest/gtest.h>

#include <cmath>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

constexpr GLenum kStages = GL_TEXTURE_SHADER_NV;

void use_operation(GLenum unit, GLint operation) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glTexEnvi(kStages, GL_SHADER_OPERATION_NV, operation);
  glEnable(kStages);
}

bool is_consistent(GLenum unit) {
  glActiveTexture(GL_TEXTURE0 + unit);
  GLint value = -1;
  glGetTexEnviv(kStages, GL_SHADER_CONSISTENT_NV, &value);
  return value == GL_TRUE;
}

void use_filter(GLenum target, GLint filter) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

// The texture's first texel, as the driver keeps it.
std::array<float, 4> kept_texel() {
  std::array<float, 4> texel{};
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, texel.data());
  return texel;
}

void expect_texel(const std::vector<float>& expected, const char* what) {
  const std::array<float, 4> texel = kept_texel();
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(texel[i], expected[i], 0.005F) << what << ' ' << i;
}

// Each component by its own scale and bias, whatever those of the colours are.
TEST(LayerTextureImages, PixelTransfer) {
  NINEBIT_GL_CONTEXT(context);
  const float half[]{0.5F, 0.5F, 0.5F, 0.5F};
  const auto upload = [&](GLint internal, GLenum format) {
    glTexImage2D(GL_TEXTURE_2D, 0, internal, 1, 1, 0, format, GL_FLOAT, half);
  };
  glPixelTransferf(GL_RED_SCALE, 0.0F);
  glPixelTransferf(GL_ALPHA_BIAS, -1.0F);
  upload(GL_HILO16_NV, GL_HILO_NV);
  expect_texel({0.5F, 0.5F}, "not the colours' scale");
  for (GLenum i = 0; i < 6; ++i) glPixelTransferf(GL_HI_SCALE_NV + i, 0.5F + 0.1F * static_cast<float>(i));
  for (GLenum i = 0; i < 6; ++i) glPixelTransferf(GL_HI_BIAS_NV + i, 0.25F - 0.1F * static_cast<float>(i));
  upload(GL_HILO16_NV, GL_HILO_NV);
  expect_texel({0.5F, 0.45F}, "HILO");
  upload(GL_DSDT8_NV, GL_DSDT_NV);
  expect_texel({0.4F, 0.35F}, "DSDT");
  upload(GL_DSDT8_MAG8_NV, GL_DSDT_MAG_NV);
  expect_texel({0.4F, 0.35F, 0.3F}, "DSDT_MAG");
  upload(GL_DSDT8_MAG8_INTENSITY8_NV, GL_DSDT_MAG_VIB_NV);
  expect_texel({0.4F, 0.35F, 0.3F, 0.25F}, "DSDT_MAG_INTENSITY");
  upload(GL_RGBA8, GL_RGBA);
  expect_texel({0.0F, 0.5F, 0.5F, 0.0F}, "colours");
  GLfloat scale = 0;
  glGetFloatv(GL_RED_SCALE, &scale);
  EXPECT_EQ(scale, 0.0F) << "the driver's own is restored";

  glGetFloatv(GL_DT_SCALE_NV, &scale);
  EXPECT_EQ(scale, 0.8F);
  glPushAttrib(GL_PIXEL_MODE_BIT);
  glPixelTransferi(GL_DT_SCALE_NV, -3);
  EXPECT_EQ(integer_of(GL_DT_SCALE_NV), -3);
  glPopAttrib();
  glGetFloatv(GL_DT_SCALE_NV, &scale);
  EXPECT_EQ(scale, 0.8F);

  const GLuint list = glGenLists(1);
  glNewList(list, GL_COMPILE);
  upload(GL_DSDT8_NV, GL_DSDT_NV);
  glPixelTransferf(GL_DS_SCALE_NV, 0.0F);
  glEndList();
  glGetFloatv(GL_DS_SCALE_NV, &scale);
  EXPECT_NEAR(scale, 0.7F, 1e-6F) << "the list has not been called";
  glCallList(list);
  expect_texel({0.4F, 0.35F}, "by a list");
  glGetFloatv(GL_DS_SCALE_NV, &scale);
  EXPECT_EQ(scale, 0.0F);
}

// Colours of signed formats are scaled and biased as other colours are, and keep their sign.
TEST(LayerTextureImages, PixelTransferOfSignedColours) {
  NINEBIT_GL_CONTEXT(context);
  const float texel[]{0.5F, -0.25F, 0.75F, 1.0F};
  glPixelTransferf(GL_RED_SCALE, -1.0F);
  glPixelTransferf(GL_GREEN_BIAS, -0.25F);
  glPixelTransferf(GL_BLUE_SCALE, 2.0F);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SIGNED_RGBA8_NV, 1, 1, 0, GL_RGBA, GL_FLOAT, texel);
  expect_texel({-0.5F, -0.5F, 1.0F, 1.0F}, "signed colours");
}

// Two signed and two unsigned bytes in a word, in both orders, in 1D, 2D, 3D and parts of images.
TEST(LayerTextureImages, PackedPixels) {
  NINEBIT_GL_CONTEXT(context);
  const std::uint32_t words[]{1, 2, 3, 0x7F81FF80, 5, 6};
  const std::vector<float> expected{1.0F, -1.0F, 1.0F, 128.0F / 255.0F},
      reversed{-1.0F, -1.0F / 127, 129.0F / 255, 127.0F / 255};
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 2);
  glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, 1);
  const auto upload = [&](GLenum type) {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DSDT_MAG_INTENSITY_NV, 1, 1, 0, GL_DSDT_MAG_VIB_NV, type, words);
  };
  upload(GL_UNSIGNED_INT_S8_S8_8_8_NV);
  expect_texel(expected, "highest first");
  upload(GL_UNSIGNED_INT_8_8_S8_S8_REV_NV);
  expect_texel(reversed, "lowest first");
  glPixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  upload(GL_UNSIGNED_INT_8_8_S8_S8_REV_NV);
  expect_texel(expected, "swapped");
  glPixelStorei(GL_UNPACK_SWAP_BYTES, GL_FALSE);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_DSDT_MAG_VIB_NV, GL_UNSIGNED_INT_8_8_S8_S8_REV_NV, words);
  expect_texel(reversed, "a part");
  EXPECT_EQ(integer_of(GL_UNPACK_SKIP_PIXELS), 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DSDT_MAG_INTENSITY_NV, 1, 1, 0, GL_DSDT_MAG_VIB_NV, GL_UNSIGNED_INT_S8_S8_8_8_NV,
               nullptr);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_DSDT_MAG_INTENSITY_NV, 1, 1, 2, 0, GL_DSDT_MAG_VIB_NV, GL_UNSIGNED_INT_S8_S8_8_8_NV,
               words);
  std::array<float, 8> volume{};
  glGetTexImage(GL_TEXTURE_3D, 0, GL_RGBA, GL_FLOAT, volume.data());
  EXPECT_NEAR(volume[0], 1.0F, 0.01F);
  EXPECT_NEAR(volume[7], 6.0F / 255.0F, 1e-6F) << "the second image follows the first row";
}

// Combiners see the intensity in alpha, with texture shaders and without.
TEST(LayerTextureImages, IntensityOfOffsets) {
  NINEBIT_GL_CONTEXT(context);
  const std::uint32_t word = 0x7F7F7F40;
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DSDT8_MAG8_INTENSITY8_NV, 1, 1, 0, GL_DSDT_MAG_VIB_NV, GL_UNSIGNED_INT_S8_S8_8_8_NV,
               &word);
  use_filter(GL_TEXTURE_2D, GL_NEAREST);
  glEnable(GL_TEXTURE_2D);
  show_register(GL_TEXTURE0);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 0x40}));
  use_operation(0, GL_TEXTURE_2D);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 0x40}));
}

// A stage whose texture misses a mip-map that its filter needs is inconsistent until the mip-map is there.
TEST(LayerTextureImages, CompletenessOfMipmaps) {
  NINEBIT_GL_CONTEXT(context);
  const std::vector<std::uint8_t> bytes(4096, 200);
  const auto image = [&](GLint level, GLsizei width, GLsizei height) {
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  };
  use_operation(0, GL_TEXTURE_2D);
  show_register(GL_TEXTURE0);
  image(0, 8, 2);
  EXPECT_FALSE(is_consistent(0)) << "the default filter has mip-maps";
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 0}));
  image(1, 4, 1);
  image(2, 2, 1);
  EXPECT_FALSE(is_consistent(0));
  image(3, 1, 1);
  EXPECT_TRUE(is_consistent(0));
  EXPECT_EQ(drawn_pixel(), (Pixel{200, 200, 200, 200}));
  image(1, 4, 2);
  EXPECT_FALSE(is_consistent(0)) << "a level of another size";
  use_filter(GL_TEXTURE_2D, GL_LINEAR);
  EXPECT_TRUE(is_consistent(0)) << "a filter without mip-maps";
  use_filter(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  EXPECT_TRUE(is_consistent(0)) << "no further level is used";
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 1);
  EXPECT_FALSE(is_consistent(0)) << "a base above the last level";
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 1000);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 0}));
  glGenerateMipmap(GL_TEXTURE_2D);
  EXPECT_EQ(drawn_pixel(), (Pixel{200, 200, 200, 200})) << "levels that the driver makes";
  EXPECT_TRUE(is_consistent(0));
  GLuint storage = 0;
  glGenTextures(1, &storage);
  glBindTexture(GL_TEXTURE_2D, storage);
  glTexStorage2D(GL_TEXTURE_2D, 2, GL_RGBA8, 8, 8);
  EXPECT_TRUE(is_consistent(0)) << "two levels of an immutable texture";

  use_operation(0, GL_TEXTURE_CUBE_MAP);
  use_filter(GL_TEXTURE_CUBE_MAP, GL_NEAREST);
  for (GLenum face = 0; face < 6; ++face) {
    EXPECT_FALSE(is_consistent(0)) << face << " faces";
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  }
  EXPECT_TRUE(is_consistent(0));
  use_filter(GL_TEXTURE_CUBE_MAP, GL_NEAREST_MIPMAP_NEAREST);
  EXPECT_FALSE(is_consistent(0));
}

// The square with two texels of level 0 a pixel in each direction in unit 0, so that level 1 is read. The coordinates
// of units 1 and 2 are rows of dot products.
void draw_square_smaller(float side) {
  const float end = 2.0F * static_cast<float>(kPictureSize) / side;
  clear_picture();
  draw_corners([end](float x, float y) {
    glMultiTexCoord3f(GL_TEXTURE0, end * (0.5F * x + 0.5F), end * (0.5F * y + 0.5F), 0.5F);
    glMultiTexCoord3f(GL_TEXTURE1, 0.75F, 0.0F, 0.0F);
    glMultiTexCoord3f(GL_TEXTURE2, 0.0F, 0.0F, 0.5F);
    glVertex2f(x, y);
  });
}

// What the layer remembers of a texture's levels ends with any change of them.
TEST(LayerTextureImages, CompletenessIsNotRememberedForTooLong) {
  NINEBIT_GL_CONTEXT(context);
  const std::vector<std::uint8_t> bytes(4096, 200);
  const auto image = [&](GLint level, GLsizei size) {
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  };
  const auto make = [&](GLuint name, GLsizei second) {
    glBindTexture(GL_TEXTURE_2D, name);
    image(0, 2);
    image(1, second);
  };
  const auto expect = [&](bool complete, const char* why) {
    glColor4f(0, 0, 0, 0);
    EXPECT_EQ(drawn_pixel(), complete ? (Pixel{200, 200, 200, 200}) : (Pixel{0, 0, 0, 0})) << why;
  };
  use_operation(0, GL_TEXTURE_2D);
  show_register(GL_TEXTURE0);
  make(5, 1);
  make(6, 2);
  for (int i = 0; i < 3; ++i) {
    glBindTexture(GL_TEXTURE_2D, 5);
    expect(true, "two textures in turn");
    glBindTexture(GL_TEXTURE_2D, 6);
    expect(false, "two textures in turn");
  }
  for (const GLsizei size : {1, 2}) {
    glNewList(static_cast<GLuint>(size), GL_COMPILE);
    image(1, size);
    glEndList();
  }
  for (const GLuint list : {1U, 2U, 1U}) {
    glCallList(list);
    expect(list == 1, "images in a list");
  }
  const GLubyte lists[]{2, 1};
  glCallLists(1, GL_UNSIGNED_BYTE, lists);
  expect(false, "images in lists");
  glNewList(3, GL_COMPILE_AND_EXECUTE);
  image(1, 1);
  glEndList();
  expect(true, "images in a list that executes");
  glPushAttrib(GL_TEXTURE_BIT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 1);
  expect(true, "the last level alone");
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 2);
  expect(false, "a base level without an image");
  glPopAttrib();
  expect(true, "the parameters are back");
  const GLuint name = 6;
  glDeleteTextures(1, &name);
  make(6, 2);
  expect(false, "a name that is used again");
  const auto sharing = GlContext::make(why_not, profiles::nv2a, context.get());
  ASSERT_NE(sharing, nullptr);
  glBindTexture(GL_TEXTURE_2D, 6);
  glCallList(1);
  glFinish();
  context->make_current();
  glBindTexture(GL_TEXTURE_2D, 6);
  expect(true, "an image by a context that shares it");
}

// Fog's colour and a texture's wrapping change no shader, and are those of the draw.
TEST(LayerTextureImages, ParametersThatChangeNoShader) {
  NINEBIT_GL_CONTEXT(context);
  const std::vector<std::uint8_t> bytes{255, 255, 255, 255, 0, 0, 0, 0};
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  use_filter(GL_TEXTURE_2D, GL_NEAREST);
  glEnable(GL_TEXTURE_2D);
  glMatrixMode(GL_TEXTURE);
  glTranslatef(1, 0, 0);  // from 1 to 2
  for (const bool repeats : {true, false, true}) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, repeats ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    show_register(GL_TEXTURE0);
    draw_square();
    EXPECT_EQ(read_picture().front(), (repeats ? Pixel{255, 255, 255, 255} : Pixel{0, 0, 0, 0}));
    for (const GLfloat level : {0.2F, 0.6F}) {
      const GLfloat color[]{level, level, level, 0};
      glFogfv(GL_FOG_COLOR, color);
      glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
      glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_FOG, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
      draw_square();
      const auto byte = static_cast<std::uint8_t>(level * 255.0F + 0.5F);
      EXPECT_EQ(read_picture().front()[0], byte);
      const GLfloat next[]{1.0F - level, 0, 0, 0};
      glFogfv(GL_FOG_COLOR, next);
      draw_square();
      EXPECT_EQ(read_picture().front()[0], static_cast<std::uint8_t>((1.0F - level) * 255.0F + 0.5F));
    }
  }
}

TEST(LayerTextureImages, MipmapsOf3dTextures) {
  NINEBIT_GL_CONTEXT(context);
  use_operation(0, GL_TEXTURE_3D);
  show_register(GL_TEXTURE0);
  for (GLint level = 0; level < 3; ++level) {
    EXPECT_FALSE(is_consistent(0)) << level;
    const std::vector<std::uint8_t> bytes(256, static_cast<std::uint8_t>(50 + 50 * level));
    const GLsizei side = 4 >> level;
    glTexImage3D(GL_TEXTURE_3D, level, GL_RGBA8, side, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  }
  use_filter(GL_TEXTURE_3D, GL_NEAREST_MIPMAP_NEAREST);
  EXPECT_TRUE(is_consistent(0));
  draw_square_smaller(4);
  EXPECT_EQ(center_pixel(), (Pixel{100, 100, 100, 100}));
}

// Two dot products read a HILO texel of level 1, and so the right half of a texture.
TEST(LayerTextureImages, MipmapsOfHiloTextures) {
  NINEBIT_GL_CONTEXT(context);
  for (GLint level = 0; level < 3; ++level) {
    const std::vector<std::uint16_t> words(32, level == 1 ? 65535 : 0);
    const GLsizei side = 4 >> level;
    glTexImage2D(GL_TEXTURE_2D, level, GL_HILO_NV, side, side, 0, GL_HILO_NV, GL_UNSIGNED_SHORT, words.data());
  }
  use_filter(GL_TEXTURE_2D, GL_NEAREST_MIPMAP_NEAREST);
  glActiveTexture(GL_TEXTURE2);
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  const std::uint8_t halves[]{10, 10, 10, 10, 90, 90, 90, 90};
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, halves);
  use_filter(GL_TEXTURE_2D, GL_NEAREST);
  use_operation(0, GL_TEXTURE_2D);
  use_operation(1, GL_DOT_PRODUCT_NV);
  use_operation(2, GL_DOT_PRODUCT_TEXTURE_2D_NV);
  show_register(GL_TEXTURE2);
  draw_square_smaller(4);
  EXPECT_EQ(center_pixel(), (Pixel{90, 90, 90, 90}));
  for (GLenum unit = 0; unit < 3; ++unit) EXPECT_TRUE(is_consistent(unit)) << unit;
}

}  // namespace
}  // namespace ninebit::test
