// 16-bit floats (IEEE 754 binary16), held as their bits.
#pragma once

#include <cstdint>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The 16 bits of a value: sign, five bits of exponent, ten bits of fraction. Comparison is bitwise: -0 differs from 0,
// and a NaN equals itself.
struct Half {
  std::uint16_t bits = 0;  // in binary16's layout
  friend constexpr bool operator==(Half, Half) = default;
};

// Rounds to nearest, ties to even; beyond the range gives infinity. A NaN stays a NaN with the upper bits of its
// payload.
[[nodiscard]] Half half_of(float value);

// Returns the value, exactly.
[[nodiscard]] float float_of(Half value);

}  // namespace ninebit
