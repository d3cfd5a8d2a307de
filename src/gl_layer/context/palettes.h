// State of EXT_paletted_texture and EXT_shared_texture_palette.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace ninebit::gl_layer {

using PaletteColor = std::array<std::uint8_t, 4>;

// The colours of indices: one, black, until a palette is given.
struct Palette {
  unsigned format = 0x1908;  // the internal format; GL_RGBA
  std::vector<PaletteColor> colors{PaletteColor{}};
};

// An image of indices. The driver has it as RGBA, looked up in the palette.
struct IndexImage {
  unsigned format = 0;  // GL_COLOR_INDEX1_EXT to GL_COLOR_INDEX16_EXT
  int dimensions = 2;
  std::array<int, 3> size{1, 1, 1};
  int border = 0;
  std::vector<std::uint16_t> indices{};
};

struct PalettedTexture {
  Palette palette{};
  std::map<std::pair<unsigned, int>, IndexImage> images{};  // by OpenGL's target of the image and its level
};

// The textures of a group of contexts by their targets and names.
using PalettedTextures = std::map<std::pair<unsigned, unsigned>, PalettedTexture>;

// A context's own palette for all its textures.
struct SharedPalette {
  bool enabled = false;
  Palette palette{};
};

}  // namespace ninebit::gl_layer
