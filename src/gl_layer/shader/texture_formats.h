// The texture formats of NV_texture_shader and the formats of today's drivers that store them.
#pragma once

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/driver_features.h"
#include "src/gl_layer/shader/shader_inputs.h"

namespace ninebit::gl_layer {

// OpenGL's target; GL_NONE for none.
[[nodiscard]] GLenum gl_target(StageTarget target);

// A parameter of the base level of the texture that the active unit has bound.
[[nodiscard]] GLint base_level_value(GLenum target, GLenum pname);

// The parts of a texture that decide its completeness, but for the images of further levels.
struct BaseImage {
  GLint base = 0, last = 0, filter = 0;
  bool immutable = false;
  std::array<GLint, 5> shape{};  // width, height, depth, border and internal format of the base level
  [[nodiscard]] std::array<GLint, 9> values() const;
};
[[nodiscard]] BaseImage base_image(GLenum target, const DriverFeatures& features);

// Whether the texture that the active unit has bound is complete (OpenGL 2.1, 3.8.10): its base level is there, a cube
// map's faces are alike, and with a filter of mip-maps all further levels are there, of their proper size and format.
[[nodiscard]] bool has_all_levels(GLenum target, const BaseImage& base);

// The internal format that stores one of NV_texture_shader; others are returned as they are. The driver's formats end
// at -1: -128 of a signed byte reads as -127, -32768 as -32767.
[[nodiscard]] GLint stored_format(GLint internal);

// The format of pixels in memory that corresponds to one of NV_texture_shader; others are returned as they are.
[[nodiscard]] GLenum stored_pixel_format(GLenum format);

// The kind of a texture's values by its internal format, as the driver reports it.
[[nodiscard]] TexelKind kind_of_stored_format(GLenum internal);

}  // namespace ninebit::gl_layer
