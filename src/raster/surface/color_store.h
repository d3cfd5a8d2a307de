// How a draw stores colours in its target's format, and how blending reads them: masks of words of RGBA (rule 43).
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/color_format.h"

namespace ninebit {

using StoredBytes = std::array<std::uint8_t, 4>;  // red, green, blue, alpha

// Words have red in the lowest byte, alpha in the highest.
struct ColorStore {
  explicit ColorStore(ColorFormat format);

  bool is_exact = true;  // all colours are stored as they are
  // See stored_color in fragment_rules.inl.
  std::uint32_t kept = 0xFFFFFFFF;  // bits that are stored
  std::uint32_t set = 0;            // bits of components that are not stored
  // The low bits of components of 5, 6 and 7 bits, which repeat the high ones.
  std::uint32_t low_of_5 = 0, low_of_6 = 0, low_of_7 = 0;

  // The colour as it is stored.
  [[nodiscard]] std::uint32_t operator()(std::uint32_t color) const;
  [[nodiscard]] StoredBytes operator()(const StoredBytes& color) const {
    return is_exact ? color : std::bit_cast<StoredBytes>((*this)(std::bit_cast<std::uint32_t>(color)));
  }
};

// The bytes that blending takes for a colour.
struct BlendReads {
  BlendReads(ColorFormat format, SurfaceBlend reading);

  std::uint32_t kept = 0xFFFFFFFF;  // of source and destination
  std::uint32_t set = 0;            // of the destination

  [[nodiscard]] StoredBytes source(const StoredBytes& color) const {
    return std::bit_cast<StoredBytes>(std::bit_cast<std::uint32_t>(color) & kept);
  }
  [[nodiscard]] StoredBytes destination(const StoredBytes& stored) const {
    return std::bit_cast<StoredBytes>((std::bit_cast<std::uint32_t>(stored) & kept) | set);
  }
};

}  // namespace ninebit
