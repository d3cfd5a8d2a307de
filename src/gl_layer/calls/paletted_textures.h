// EXT_paletted_texture and EXT_shared_texture_palette: textures of indices, which the driver gets as RGBA.
#pragma once

#include <array>

#include "src/gl_layer/context/context.h"

namespace ninebit::gl_layer {

// A part of an image that a program gives.
struct GivenPixels {
  unsigned target = 0;
  int level = 0;
  int dimensions = 2;
  std::array<int, 3> offset{};  // for a part of an image that exists
  std::array<int, 3> size{1, 1, 1};
  int border = 0;
  unsigned format = 0, type = 0;
  const void* pixels = nullptr;
};

// Whether glTexImage's internal format is one of indices that the layer adds.
[[nodiscard]] bool is_index_format(int internal);
void define_index_image(unsigned internal, const GivenPixels& given);

// Whether a part belongs to an image of indices; if so it is replaced.
[[nodiscard]] bool replace_indices(const GivenPixels& given);

// Forgets that the image, or the textures, hold indices.
void forget_index_image(unsigned target, int level);
void forget_paletted_textures(int count, const unsigned* names);

// The context's shared palette is used from here on, or not.
void enable_shared_palette(bool enabled);

}  // namespace ninebit::gl_layer
