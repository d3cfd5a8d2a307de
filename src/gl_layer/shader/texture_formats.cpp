#include "src/gl_layer/shader/texture_formats.h"

namespace ninebit::gl_layer {
namespace {

struct Format {
  GLenum name, stored;
};
constexpr Format kFormats[]{{GL_HILO_NV, GL_RG16},
                            {GL_HILO16_NV, GL_RG16},
                            {GL_SIGNED_HILO_NV, GL_RG16_SNORM},
                            {GL_SIGNED_HILO16_NV, GL_RG16_SNORM},
                            {GL_DSDT_NV, GL_RG8_SNORM},
                            {GL_DSDT8_NV, GL_RG8_SNORM},
                            {GL_DSDT_MAG_NV, GL_RGB32F},  // no format of bytes has two signed and one unsigned
                            {GL_DSDT8_MAG8_NV, GL_RGB32F},
                            {GL_DSDT_MAG_INTENSITY_NV, GL_RGBA16F},
                            {GL_DSDT8_MAG8_INTENSITY8_NV, GL_RGBA16F},
                            {GL_SIGNED_RGBA_NV, GL_RGBA8_SNORM},
                            {GL_SIGNED_RGBA8_NV, GL_RGBA8_SNORM},
                            {GL_SIGNED_RGB_NV, GL_RGB8_SNORM},
                            {GL_SIGNED_RGB8_NV, GL_RGB8_SNORM},
                            {GL_SIGNED_RGB_UNSIGNED_ALPHA_NV, GL_RGBA16_SNORM},
                            {GL_SIGNED_RGB8_UNSIGNED_ALPHA8_NV, GL_RGBA16_SNORM},
                            {GL_SIGNED_LUMINANCE_NV, GL_LUMINANCE8_SNORM},
                            {GL_SIGNED_LUMINANCE8_NV, GL_LUMINANCE8_SNORM},
                            {GL_SIGNED_LUMINANCE_ALPHA_NV, GL_LUMINANCE8_ALPHA8_SNORM},
                            {GL_SIGNED_LUMINANCE8_ALPHA8_NV, GL_LUMINANCE8_ALPHA8_SNORM},
                            {GL_SIGNED_ALPHA_NV, GL_ALPHA8_SNORM},
                            {GL_SIGNED_ALPHA8_NV, GL_ALPHA8_SNORM},
                            {GL_SIGNED_INTENSITY_NV, GL_INTENSITY8_SNORM},
                            {GL_SIGNED_INTENSITY8_NV, GL_INTENSITY8_SNORM}};

}  // namespace

GLenum gl_target(StageTarget target) {
  constexpr GLenum kTargets[]{GL_NONE,       GL_TEXTURE_1D,      GL_TEXTURE_2D, GL_TEXTURE_RECTANGLE,
                              GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP};
  return kTargets[static_cast<std::size_t>(target)];
}

GLint base_level_value(GLenum target, GLenum pname) {
  GLint base = 0, value = 0;
  found_driver.GetTexParameteriv(target, GL_TEXTURE_BASE_LEVEL, &base);
  if (base < 0 || base > 16) return 0;
  const GLenum image = target == GL_TEXTURE_CUBE_MAP ? GLenum{GL_TEXTURE_CUBE_MAP_POSITIVE_X} : target;
  found_driver.GetTexLevelParameteriv(image, base, pname, &value);
  return value;
}

namespace {

GLint level_value(GLenum image, GLint level, GLenum pname) {
  GLint value = 0;
  found_driver.GetTexLevelParameteriv(image, level, pname, &value);
  return value;
}

GLint texture_value(GLenum target, GLenum pname) {
  GLint value = 0;
  found_driver.GetTexParameteriv(target, pname, &value);
  return value;
}

// A level's width, height, depth, border and internal format.
using LevelShape = std::array<GLint, 5>;

LevelShape shape_of(GLenum image, GLint level) {
  constexpr GLenum kNames[]{GL_TEXTURE_WIDTH, GL_TEXTURE_HEIGHT, GL_TEXTURE_DEPTH, GL_TEXTURE_BORDER,
                            GL_TEXTURE_INTERNAL_FORMAT};
  LevelShape shape{};
  for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = level_value(image, level, kNames[i]);
  return shape;
}

}  // namespace

BaseImage base_image(GLenum target, const DriverFeatures& features) {
  const bool is_cube = target == GL_TEXTURE_CUBE_MAP;
  BaseImage image{.base = texture_value(target, GL_TEXTURE_BASE_LEVEL),
                  .last = texture_value(target, GL_TEXTURE_MAX_LEVEL),
                  .filter = texture_value(target, GL_TEXTURE_MIN_FILTER)};
  image.immutable = features.texture_storage && texture_value(target, GL_TEXTURE_IMMUTABLE_FORMAT) != 0;
  if (image.base >= 0 && image.base <= 16) {
    image.shape = shape_of(is_cube ? GLenum{GL_TEXTURE_CUBE_MAP_POSITIVE_X} : target, image.base);
  }
  return image;
}

std::array<GLint, 9> BaseImage::values() const {
  return {base, last, filter, immutable ? 1 : 0, shape[0], shape[1], shape[2], shape[3], shape[4]};
}

bool has_all_levels(GLenum target, const BaseImage& base) {
  const bool is_cube = target == GL_TEXTURE_CUBE_MAP;
  const GLenum image = is_cube ? GLenum{GL_TEXTURE_CUBE_MAP_POSITIVE_X} : target;
  const LevelShape& first = base.shape;  // zeros where the level has no image
  if (first[0] == 0 || (is_cube && first[0] != first[1])) return false;
  if (base.immutable) return true;
  const bool mipmaps = base.filter != GL_NEAREST && base.filter != GL_LINEAR;
  if (mipmaps && base.base > base.last) return false;
  for (GLenum face = 0; face < (is_cube ? 6U : 1U); ++face) {
    LevelShape expected = first;
    for (GLint level = base.base;; ++level) {
      const bool is_known = face == 0 && level == base.base;
      if (!is_known && shape_of(image + face, level) != expected) return false;
      const GLint border = 2 * first[3];
      bool is_last = !mipmaps || level == base.last;
      if (!is_last) {
        is_last = true;
        for (std::size_t i = 0; i < 3; ++i) {
          if (expected[i] - border <= 1) continue;  // a side that the target does not have is 1
          is_last = false;
          expected[i] = (expected[i] - border) / 2 + border;
        }
      }
      if (is_last) break;
    }
  }
  return true;
}

GLint stored_format(GLint internal) {
  for (const Format& format : kFormats) {
    if (static_cast<GLenum>(internal) == format.name) return static_cast<GLint>(format.stored);
  }
  return internal;
}

GLenum stored_pixel_format(GLenum format) {
  switch (format) {
    case GL_HILO_NV:
    case GL_DSDT_NV:
      return GL_RG;
    case GL_DSDT_MAG_NV:
      return GL_RGB;
    case GL_DSDT_MAG_VIB_NV:
      return GL_RGBA;
    default:
      return format;
  }
}

TexelKind kind_of_stored_format(GLenum internal) {
  switch (internal) {
    case GL_RG16:
      return TexelKind::hilo;
    case GL_RG16_SNORM:
      return TexelKind::signed_hilo;
    case GL_RG8_SNORM:
      return TexelKind::dsdt;
    case GL_RGB32F:
      return TexelKind::dsdt_mag;
    case GL_RGBA16F:
      return TexelKind::dsdt_mag_intensity;
    case GL_RGBA16_SNORM:
    case GL_RGB8_SNORM:        // whose alpha is 1
    case GL_LUMINANCE8_SNORM:  // likewise
      return TexelKind::signed_rgb_unsigned_alpha;
    case GL_RGBA8_SNORM:
    case GL_LUMINANCE8_ALPHA8_SNORM:
    case GL_ALPHA8_SNORM:
    case GL_INTENSITY8_SNORM:
      return TexelKind::signed_color;
    default:
      return TexelKind::color;
  }
}

}  // namespace ninebit::gl_layer
