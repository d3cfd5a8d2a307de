// How a draw stores colours in its target's format, and how blending reads them (rules 43 and 44).
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/color_format.h"
#include "src/raster/rules/color_masks.h"

namespace ninebit {

using StoredBytes = std::array<std::uint8_t, 4>;  // red, green, blue, alpha

// A colour as a word: red in the lowest byte.
[[nodiscard]] constexpr std::uint32_t word_of(const StoredBytes& color) {
  return color[0] | std::uint32_t{color[1]} << 8 | std::uint32_t{color[2]} << 16 | std::uint32_t{color[3]} << 24;
}
[[nodiscard]] constexpr StoredBytes bytes_of(std::uint32_t word) {
  const auto byte = [word](unsigned shift) { return static_cast<std::uint8_t>(word >> shift); };
  return {byte(0), byte(8), byte(16), byte(24)};
}

struct ColorStore {
  explicit ColorStore(ColorFormat format);

  bool is_exact = true;  // all colours are stored as they are
  ColorMasks masks{};

  // The colour as it is stored.
  [[nodiscard]] std::uint32_t operator()(std::uint32_t color) const;
  [[nodiscard]] StoredBytes operator()(const StoredBytes& color) const {
    return is_exact ? color : bytes_of((*this)(word_of(color)));
  }
};

// The bytes that blending takes for a colour (rule 44).
struct BlendReads {
  BlendReads(ColorFormat format, SurfaceBlend reading);

  std::uint32_t kept = 0xFFFFFFFF;  // of source and destination
  std::uint32_t set = 0;            // of the destination

  [[nodiscard]] StoredBytes source(const StoredBytes& color) const { return bytes_of(word_of(color) & kept); }
  [[nodiscard]] StoredBytes destination(const StoredBytes& stored) const {
    return bytes_of((word_of(stored) & kept) | set);
  }
};

}  // namespace ninebit
