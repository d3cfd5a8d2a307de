// A 16-bit float (IEEE 754 binary16) as its bits.
#pragma once

#include <cstdint>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A value as its 16 bits: sign, five bits of exponent, ten of fraction. Compared by bits: -0 is not 0, a NaN may be
// itself.
struct Half {
  std::uint16_t bits = 0;  // IEEE 754 binary16
  friend constexpr bool operator==(Half, Half) = default;
};

// Rounded to nearest, ties to even; beyond the range infinity. A NaN stays one, with the upper bits of its payload.
[[nodiscard]] Half half_of(float value);

// The half's value, exactly.
[[nodiscard]] float float_of(Half value);

}  // namespace ninebit
