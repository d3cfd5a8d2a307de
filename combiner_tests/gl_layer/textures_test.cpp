// Which texture a unit gives to the combiners, and what of its format.
#include <gtest/gtest.h>

#include "combiner_tests/gl_layer/pictures.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/fixed9.h"

namespace ninebit::test {
namespace {

// A texture of one texel, bound to a target of the active unit.
void make_texture(GLenum target, GLint internal, GLenum format, const Pixel& texel) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(target, name);
  if (target == GL_TEXTURE_1D) {
    glTexImage1D(target, 0, internal, 1, 0, format, GL_UNSIGNED_BYTE, texel.data());
  } else if (target == GL_TEXTURE_3D) {
    glTexImage3D(target, 0, internal, 1, 1, 1, 0, format, GL_UNSIGNED_BYTE, texel.data());
  } else if (target == GL_TEXTURE_CUBE_MAP) {
    for (GLenum face = 0; face < 6; ++face) {
      glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, internal, 1, 1, 0, format, GL_UNSIGNED_BYTE, texel.data());
    }
  } else {
    glTexImage2D(target, 0, internal, 1, 1, 0, format, GL_UNSIGNED_BYTE, texel.data());
  }
  use_nearest(target);
}

constexpr GLenum kTextureTargets[]{GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_RECTANGLE, GL_TEXTURE_3D,
                                   GL_TEXTURE_CUBE_MAP};

Pixel texel_of(std::size_t unit, std::size_t target) {
  return {static_cast<std::uint8_t>(10 + 40 * target), static_cast<std::uint8_t>(5 + 50 * unit), 200, 100};
}

// Of the enabled targets the last in this order is drawn with: each combination, on each unit of the profile.
TEST(LayerTextures, TargetsInOrderOfPrecedence) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    NINEBIT_GL_CONTEXT(context, profile);
    const auto units = static_cast<std::size_t>(profile.texture_units.value);
    for (std::size_t unit = 0; unit < units; ++unit) {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      for (std::size_t i = 0; i < 5; ++i) make_texture(kTextureTargets[i], GL_RGBA8, GL_RGBA, texel_of(unit, i));
    }
    for (std::size_t unit = 0; unit < units; ++unit) {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      show_register(GL_TEXTURE0 + static_cast<GLenum>(unit));
      for (unsigned enabled = 0; enabled < 32; ++enabled) {
        Pixel expected{0, 0, 0, static_cast<std::uint8_t>(profile.disabled_texture_alpha.value)};
        for (std::size_t i = 0; i < 5; ++i) {
          const bool on = (enabled >> i & 1U) != 0;
          (on ? glEnable : glDisable)(kTextureTargets[i]);
          if (on) expected = texel_of(unit, i);
        }
        EXPECT_EQ(drawn_pixel(), expected) << profile.name << ", unit " << unit << ", enabled " << enabled;
      }
      for (const GLenum target : kTextureTargets) glDisable(target);
    }
  }
}

// What the program reads of the active unit stays as it was.
TEST(LayerTextures, TheActiveUnitStays) {
  NINEBIT_GL_CONTEXT(context);
  for (const int unit : {GL_TEXTURE2, GL_TEXTURE7, GL_TEXTURE0}) {
    glActiveTexture(static_cast<GLenum>(unit));
    show_constant({1, 1, 1, 1});
    draw_square();
    EXPECT_EQ(integer_of(GL_ACTIVE_TEXTURE), unit);
  }
}

// What the library says of a texel.
Pixel expected_texel(const HardwareProfile& profile, TextureFormat format, const Pixel& value) {
  const Rgba9 codes = texel_codes(profile, Texel{.value = value, .format = format});
  return {to_byte(profile, codes[0]), to_byte(profile, codes[1]), to_byte(profile, codes[2]),
          to_byte(profile, codes[3])};
}

struct FormatCase {
  const char* name;
  GLint internal;
  GLenum format;
  Pixel upload, value;
  TextureFormat in_library;
};

TEST(LayerTextures, Formats) {
  const FormatCase cases[]{
      {"ALPHA", GL_ALPHA8, GL_ALPHA, {99}, {0, 0, 0, 99}, TextureFormat::alpha},
      {"LUMINANCE", GL_LUMINANCE8, GL_LUMINANCE, {98}, {98}, TextureFormat::luminance},
      {"LUMINANCE_ALPHA",
       GL_LUMINANCE8_ALPHA8,
       GL_LUMINANCE_ALPHA,
       {97, 3},
       {97, 0, 0, 3},
       TextureFormat::luminance_alpha},
      {"INTENSITY", GL_INTENSITY8, GL_LUMINANCE, {96}, {96}, TextureFormat::intensity},
      {"RGB", GL_RGB8, GL_RGB, {1, 2, 3, 4}, {1, 2, 3, 4}, TextureFormat::rgb},
      {"RGBA", GL_RGBA8, GL_RGBA, {1, 2, 3, 4}, {1, 2, 3, 4}, TextureFormat::rgba},
  };
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    NINEBIT_GL_CONTEXT(context, profile);
    show_register(GL_TEXTURE0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (const GLenum target : kTextureTargets) {
      glEnable(target);
      for (const FormatCase& one : cases) {
        make_texture(target, one.internal, one.format, one.upload);
        EXPECT_EQ(drawn_pixel(), expected_texel(profile, one.in_library, one.value))
            << one.name << ", target " << std::hex << target;
      }
      glDisable(target);
    }
  }
}

// The mode of depth textures is ignored; comparisons give 0 or 1.
TEST(LayerTextures, DepthTextures) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    NINEBIT_GL_CONTEXT(context, profile);
    show_register(GL_TEXTURE0);
    for (const int name : {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_RECTANGLE}) {
      const auto target = static_cast<GLenum>(name);
      glEnable(target);
      make_texture(target, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, {96, 96, 96, 96});
      for (const int mode : {GL_LUMINANCE, GL_INTENSITY, GL_ALPHA, GL_RED}) {
        glTexParameteri(target, GL_DEPTH_TEXTURE_MODE, mode);
        glTexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_NONE);
        EXPECT_EQ(drawn_pixel(), expected_texel(profile, TextureFormat::depth, {96})) << name << ", mode " << mode;
        glTexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE);
        for (const auto& [function, passes] : {std::pair{GL_LEQUAL, true}, {GL_GEQUAL, false}}) {
          glTexParameteri(target, GL_TEXTURE_COMPARE_FUNC, function);  // r is 0
          const std::uint8_t value = passes ? 255 : 0;
          EXPECT_EQ(drawn_pixel(), expected_texel(profile, TextureFormat::depth_comparison, {value}))
              << name << ", mode " << mode << ", comparison " << function;
        }
      }
      // A texture of colours at the same place.
      make_texture(target, GL_RGBA8, GL_RGBA, {9, 8, 7, 6});
      EXPECT_EQ(drawn_pixel(), (Pixel{9, 8, 7, 6}));
      glDisable(target);
    }
  }
}

// A new image, another texture and a deleted one change what is read.
TEST(LayerTextures, ChangesOfTheBoundTexture) {
  NINEBIT_GL_CONTEXT(context);
  show_register(GL_TEXTURE0);
  glEnable(GL_TEXTURE_2D);
  const std::uint8_t bytes[]{50, 60, 70, 80};
  make_texture(GL_TEXTURE_2D, GL_RGBA8, GL_RGBA, {50, 60, 70, 80});
  EXPECT_EQ(drawn_pixel(), (Pixel{50, 60, 70, 80}));
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 1, 1, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, bytes);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 50}));
  glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA8, 1, 1, 0, GL_ALPHA, GL_UNSIGNED_BYTE, bytes + 1);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 60}));
  const auto texture = static_cast<GLuint>(integer_of(GL_TEXTURE_BINDING_2D));
  glBindTexture(GL_TEXTURE_2D, 0);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 255}));  // it has no image
  glBindTexture(GL_TEXTURE_2D, texture);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 60}));
  glDeleteTextures(1, &texture);
  EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 255}));
}

}  // namespace
}  // namespace ninebit::test
