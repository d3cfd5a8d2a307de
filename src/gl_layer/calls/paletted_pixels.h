// Indices and colours as a program gives them to EXT_paletted_texture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/gl_layer/calls/paletted_textures.h"
#include "src/gl_layer/driver/driver.h"

namespace ninebit::gl_layer {

// The bits of an index, by the internal format.
[[nodiscard]] int bits_of(GLenum format);

// The size of a component of pixels; 0: it is not a type of indices and colours.
[[nodiscard]] std::size_t component_bytes(GLenum type);

// Indices after the pixel transfer's shift and offset.
[[nodiscard]] std::vector<std::uint16_t> read_indices(const GivenPixels& given, GLenum format);

// The components of a pixel's format as positions in RGBA; 4: red, green and blue. Empty: it is not a format of
// colours.
[[nodiscard]] std::vector<std::size_t> components_of_colors(GLenum format);

// The base format of a palette; GL_NONE: it is not a format of palettes.
[[nodiscard]] GLenum palette_base(GLenum internal);

// A colour as its base format keeps it.
[[nodiscard]] PaletteColor kept_color(const std::array<double, 4>& color, GLenum base);

// The colours of a palette, as the base format keeps them.
[[nodiscard]] std::vector<PaletteColor> read_colors(GLsizei count, GLenum format, GLenum type, const void* data,
                                                    GLenum base);

}  // namespace ninebit::gl_layer
