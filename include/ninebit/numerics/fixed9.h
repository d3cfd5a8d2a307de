// Conversions between codes, bytes and real numbers, as a profile has them: 1.0 = profile.one (255 with nine bits).
#pragma once

#include <cstdint>

#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Returns the code of a byte (texel, vertex colour, constant) in a register: 255 becomes 1.0 (rule 1).
[[nodiscard]] constexpr s9 from_byte(const HardwareProfile& profile, std::uint8_t byte) {
  return static_cast<s9>(byte >> profile.byte_shift.value);
}

// Returns the byte of a code in [0, one] in the frame buffer: 1.0 becomes 255, a negative code 0. Low bits that
// from_byte dropped are filled with the code's upper bits.
[[nodiscard]] constexpr std::uint8_t to_byte(const HardwareProfile& profile, s9 code) {
  if (code <= 0) return 0;
  if (code >= profile.one) return 255;
  const int shift = profile.byte_shift;
  return static_cast<std::uint8_t>(shift == 0 ? code : (code << shift) | (code >> (8 - 2 * shift)));
}

// Returns the real number of a code: code / one.
[[nodiscard]] constexpr double to_real(const HardwareProfile& profile, s9 code) {
  return static_cast<double>(code) / profile.one;
}

// Converts a fog factor to the byte that the combiners read, as profile.fog_byte says: cut to 12 bits n, which give
// 255 (n + 1) >> 12 (rule 25), or to nearest. Clamped to [0, 255]; NaN becomes 0.
[[nodiscard]] constexpr std::uint8_t byte_of_fog_factor(const HardwareProfile& profile, float factor) {
  if (profile.fog_byte.value == StageByte::nearest) return byte_of_color(factor);
  const float within = factor > 0.0F ? (factor < 1.0F ? factor : 1.0F) : 0.0F;  // compilers vectorize loops of it
  const int n = static_cast<int>(within * 4096.0F);
  return static_cast<std::uint8_t>(n < 4096 ? 255 * (n + 1) >> 12 : 255);
}

// Converts a float vertex colour to the byte that the combiners read (rule 17): cuts the mantissa to the profile's
// bits, multiplies by 255, rounds halves up, clamps to [0, 255]. NaN becomes 0.
[[nodiscard]] std::uint8_t byte_of_vertex_color(const HardwareProfile& profile, float component);

}  // namespace ninebit
