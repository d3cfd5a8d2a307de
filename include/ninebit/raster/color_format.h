// The formats of colour surfaces, by the NV2A's names (rule 43).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// How colours are stored. Z and O name the bits that hold nothing: all zeros, or all ones.
enum class ColorFormat : std::uint8_t {
  a8r8g8b8,    // 32 bits
  x8r8g8b8_z,  // 32 bits without alpha
  x8r8g8b8_o,
  x1a7r8g8b8_z,  // 32 bits with 7 bits of alpha
  x1a7r8g8b8_o,
  r5g6b5,      // 16 bits without alpha
  x1r5g5b5_z,  // likewise
  x1r5g5b5_o,
  g8b8,  // 16 bits: green and blue; cannot be blended
  b8     // 8 bits: blue; cannot be blended
};

// The bits that a format stores.
struct ColorFormatFacts {
  ColorFormat format;            // whose facts these are
  std::string_view name;         // "r5g6b5"
  std::array<int, 4> bits;       // of red, green, blue and alpha; 0: not stored
  int unused_bits = 0;           // above alpha
  bool unused_are_ones = false;  // else zeros
  // Bits of a pixel in memory: 8, 16 or 32.
  [[nodiscard]] constexpr int word_bits() const { return bits[0] + bits[1] + bits[2] + bits[3] + unused_bits; }
  // Whether the chip blends into it.
  [[nodiscard]] constexpr bool blends() const { return bits[0] > 0; }
};

// All formats, in the order of ColorFormat.
inline constexpr std::array<ColorFormatFacts, 10> kColorFormats{
    {{ColorFormat::a8r8g8b8, "a8r8g8b8", {8, 8, 8, 8}},
     {ColorFormat::x8r8g8b8_z, "x8r8g8b8_z", {8, 8, 8, 0}, 8},
     {ColorFormat::x8r8g8b8_o, "x8r8g8b8_o", {8, 8, 8, 0}, 8, true},
     {ColorFormat::x1a7r8g8b8_z, "x1a7r8g8b8_z", {8, 8, 8, 7}, 1},
     {ColorFormat::x1a7r8g8b8_o, "x1a7r8g8b8_o", {8, 8, 8, 7}, 1, true},
     {ColorFormat::r5g6b5, "r5g6b5", {5, 6, 5, 0}},
     {ColorFormat::x1r5g5b5_z, "x1r5g5b5_z", {5, 5, 5, 0}, 1},
     {ColorFormat::x1r5g5b5_o, "x1r5g5b5_o", {5, 5, 5, 0}, 1, true},
     {ColorFormat::g8b8, "g8b8", {0, 8, 8, 0}},
     {ColorFormat::b8, "b8", {0, 0, 8, 0}}}};

// The facts of one format.
[[nodiscard]] constexpr const ColorFormatFacts& facts_of(ColorFormat format) {
  return kColorFormats[static_cast<std::size_t>(format)];
}

// A colour as the planes of a surface hold it after a write without blending: each component is cut to its bits (rule
// 43), which are then widened to a byte by repetition, as textures of the format are (rule 40). An alpha that is not
// stored is 255, another component that is not stored 0.
[[nodiscard]] std::array<std::uint8_t, 4> stored_color(ColorFormat format, const std::array<std::uint8_t, 4>& rgba);

// The word in memory of a colour that the planes hold: facts_of(format).word_bits() bits, with blue in the lowest.
[[nodiscard]] std::uint32_t color_word(ColorFormat format, const std::array<std::uint8_t, 4>& rgba);

}  // namespace ninebit
