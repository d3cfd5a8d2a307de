#include "ninebit/raster/color_format.h"

#include "src/raster/rules/one_fragment.h"
#include "src/raster/surface/color_store.h"

namespace ninebit {
namespace {

constexpr std::uint32_t byte_of_word(std::uint32_t byte, std::size_t component) {
  return byte << (8 * component);
}

}  // namespace

std::array<std::uint8_t, 4> stored_color(ColorFormat format, const std::array<std::uint8_t, 4>& rgba) {
  return ColorStore(format)(rgba);
}

std::uint32_t color_word(ColorFormat format, const std::array<std::uint8_t, 4>& rgba) {
  const ColorFormatFacts& facts = facts_of(format);
  std::uint32_t word = 0;
  int at = 0;
  for (const std::size_t k : {2U, 1U, 0U, 3U}) {
    if (facts.bits[k] == 0) continue;
    word |= static_cast<std::uint32_t>(rgba[k] >> (8 - facts.bits[k])) << at;
    at += facts.bits[k];
  }
  if (facts.unused_are_ones) word |= ((1U << facts.unused_bits) - 1) << at;
  return word;
}

ColorStore::ColorStore(ColorFormat format) : is_exact(format == ColorFormat::a8r8g8b8) {
  const ColorFormatFacts& facts = facts_of(format);
  for (std::size_t k = 0; k < 4; ++k) {
    const int bits = facts.bits[k];
    const std::uint32_t low = 0xFFU >> bits;
    masks.kept &= ~byte_of_word(low, k);
    if (bits == 0 && k == 3) masks.set |= byte_of_word(0xFF, k);
    if (bits == 5) masks.low_of_5 |= byte_of_word(low, k);
    if (bits == 6) masks.low_of_6 |= byte_of_word(low, k);
    if (bits == 7) masks.low_of_7 |= byte_of_word(low, k);
  }
}

std::uint32_t ColorStore::operator()(std::uint32_t color) const {
  return static_cast<std::uint32_t>(
      one_fragment::stored_color(one_fragment::Numbers(), static_cast<std::int32_t>(color), masks));
}

// Alpha is never cut; what is not stored of the destination has its plane's value.
BlendReads::BlendReads(ColorFormat format, SurfaceBlend reading) {
  constexpr std::uint32_t kAlphaByte = 0xFF000000;
  const ColorStore store(format);
  set = store.masks.set;
  if (reading == SurfaceBlend::zeros) kept = store.masks.kept | kAlphaByte;
}

}  // namespace ninebit
