#include "ninebit/raster/texel_words.h"

#include <array>

namespace ninebit {
namespace {

struct Row {
  TexelWord format;
  std::string_view name;
  int bits;
};
using enum TexelWord;
constexpr std::array<Row, 19> kFormats{{{y8, "Y8", 8},
                                        {ay8, "AY8", 8},
                                        {a8, "A8", 8},
                                        {index8, "SZ_Index8", 8},
                                        {a8y8, "A8Y8", 16},
                                        {g8b8, "G8B8", 16},
                                        {r8b8, "R8B8", 16},
                                        {a1r5g5b5, "A1R5G5B5", 16},
                                        {x1r5g5b5, "X1R5G5B5", 16},
                                        {a4r4g4b4, "A4R4G4B4", 16},
                                        {r5g6b5, "R5G6B5", 16},
                                        {r6g5b5, "R6G5B5", 16},
                                        {y16, "Y16", 16},
                                        {a8r8g8b8, "A8R8G8B8", 32},
                                        {x8r8g8b8, "X8R8G8B8", 32},
                                        {a8b8g8r8, "A8B8G8R8", 32},
                                        {b8g8r8a8, "B8G8R8A8", 32},
                                        {r8g8b8a8, "R8G8B8A8", 32},
                                        {r16b16, "R16B16", 32}}};

// The field of `bits` bits from bit `from` on, as a byte.
std::uint8_t field(std::uint32_t word, int from, int bits) {
  const std::uint32_t code = (word >> from) & ((1U << bits) - 1);
  switch (bits) {
    case 1:
      return code != 0 ? 255 : 0;
    case 4:
      return static_cast<std::uint8_t>(17 * code);
    default:  // 5 to 8
      return static_cast<std::uint8_t>(code << (8 - bits) | code >> (2 * bits - 8));
  }
}

// Red, green and blue side by side, blue in the lowest bits.
Bytes4 rgb_of(std::uint32_t word, int red, int green, int blue, std::uint8_t alpha) {
  return {field(word, green + blue, red), field(word, blue, green), field(word, 0, blue), alpha};
}

}  // namespace

std::string_view name_of(TexelWord format) {
  return kFormats[static_cast<std::size_t>(format)].name;
}

std::optional<TexelWord> texel_word_called(std::string_view name) {
  for (const Row& row : kFormats) {
    if (row.name == name) return row.format;
  }
  return std::nullopt;
}

int bits_of(TexelWord format) {
  return kFormats[static_cast<std::size_t>(format)].bits;
}

Bytes4 texel_of_word(TexelWord format, std::uint32_t word, std::span<const std::uint32_t> palette) {
  const auto byte = [word](int n) { return static_cast<std::uint8_t>(word >> (8 * n)); };
  switch (format) {
    case y8:
      return {byte(0), byte(0), byte(0), 255};
    case ay8:
      return {byte(0), byte(0), byte(0), byte(0)};
    case a8:
      return {255, 255, 255, byte(0)};
    case index8:
      return texel_of_word(a8r8g8b8, byte(0) < palette.size() ? palette[byte(0)] : 0);
    case a8y8:
      return {byte(0), byte(0), byte(0), byte(1)};
    case g8b8:
      return {byte(0), byte(1), byte(0), byte(1)};
    case r8b8:
      return {byte(1), byte(0), byte(0), byte(1)};
    case a1r5g5b5:
      return rgb_of(word, 5, 5, 5, field(word, 15, 1));
    case x1r5g5b5:
      return rgb_of(word, 5, 5, 5, 255);
    case a4r4g4b4:
      return rgb_of(word, 4, 4, 4, field(word, 12, 4));
    case r5g6b5:
      return rgb_of(word, 5, 6, 5, 255);
    case r6g5b5:
      return rgb_of(word, 6, 5, 5, 255);
    case y16:
      return {255, byte(1), byte(0), 255};
    case a8r8g8b8:
      return {byte(2), byte(1), byte(0), byte(3)};
    case x8r8g8b8:
      return {byte(2), byte(1), byte(0), 255};
    case a8b8g8r8:
      return {byte(0), byte(1), byte(2), byte(3)};
    case b8g8r8a8:
      return {byte(1), byte(2), byte(3), byte(0)};
    case r8g8b8a8:
      return {byte(3), byte(2), byte(1), byte(0)};
    case r16b16:
      return {byte(2), byte(1), byte(0), byte(3)};
  }
  return {};
}

std::array<Bytes4, 2> texels_of_yuv_word(std::uint32_t word, bool is_uyvy) {
  const auto byte = [word](int n) { return static_cast<std::uint8_t>(word >> (8 * n)); };
  const int y = is_uyvy ? 1 : 0, u = 1 - y;
  const auto texel = [&](int luma) { return Bytes4{byte(luma), byte(u), byte(u + 2), 255}; };
  return {texel(y), texel(y + 2)};
}

}  // namespace ninebit
