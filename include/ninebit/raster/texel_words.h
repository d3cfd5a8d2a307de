// Texels as words of memory, in the NV2A's formats (docs/numerics.md, rule 40).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// Formats with a word for each texel. Names list components from the highest bits down; x is not read.
enum class TexelWord : std::uint8_t {
  y8,
  ay8,
  a8,
  index8,  // of a palette of A8R8G8B8 words
  a8y8,
  g8b8,
  r8b8,
  a1r5g5b5,
  x1r5g5b5,
  a4r4g4b4,
  r5g6b5,
  r6g5b5,
  y16,
  a8r8g8b8,
  x8r8g8b8,
  a8b8g8r8,
  b8g8r8a8,
  r8g8b8a8,
  r16b16
};

// The name of a format, such as "A8R8G8B8" or "SZ_Index8".
[[nodiscard]] std::string_view name_of(TexelWord format);
// The format of that name; empty: none.
[[nodiscard]] std::optional<TexelWord> texel_word_called(std::string_view name);

// Bits of a format's word: 8, 16 or 32.
[[nodiscard]] int bits_of(TexelWord format);

// Red, green, blue and alpha of a word, whose bits above the format's are not read. Fields of 5 and 6 bits are widened
// by repeating their bits, of 4 bits by 17, of 1 bit to 0 or 255. `palette`: of index8 alone; an entry beyond it is 0.
[[nodiscard]] Bytes4 texel_of_word(TexelWord format, std::uint32_t word, std::span<const std::uint32_t> palette = {});

// The two texels of a word of YUY2 (Y0, U, Y1, V from the lowest byte on) or UYVY (U, Y0, V, Y1): red is Y, green U,
// blue V, alpha 255. Stages convert them to RGB after filters (TextureShaderState::converts_yuv).
[[nodiscard]] std::array<Bytes4, 2> texels_of_yuv_word(std::uint32_t word, bool is_uyvy);

}  // namespace ninebit
