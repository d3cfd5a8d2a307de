// The type of a register value, a signed integer code. fixed9.h converts codes as a profile says.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// One component of a register. With every shipped profile it lies in [-256, 255].
using s9 = std::int16_t;

// Four components: red, green, blue, alpha.
using Rgba9 = std::array<s9, 4>;
// Indices of the components in every array of four.
inline constexpr int kRed = 0, kGreen = 1, kBlue = 2, kAlpha = 3;

// Converts a GL colour component to a byte: clamps to [0, 1], rounds to nearest (OpenGL 1.3, 2.13.9). NaN becomes 0.
[[nodiscard]] constexpr std::uint8_t byte_of_color(float component) {
  if (!(component > 0.0F)) return 0;
  if (component >= 1.0F) return 255;
  return static_cast<std::uint8_t>(static_cast<double>(component) * 255.0 + 0.5);
}

}  // namespace ninebit
