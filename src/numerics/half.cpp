#include "ninebit/numerics/half.h"

#include <bit>

namespace ninebit {

// binary32: 8 bits of exponent (bias 127), 23 of fraction; binary16: 5 (bias 15) and 10.

Half half_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000U, magnitude = bits & 0x7FFFFFFFU;
  const auto signed_half = [&](std::uint32_t half) { return Half{static_cast<std::uint16_t>(sign | half)}; };
  if (magnitude > 0x7F800000U) {  // NaN: the upper bits of its payload, never infinity
    const std::uint32_t payload = (magnitude >> 13) & 0x3FFU;
    return signed_half(0x7C00U | (payload != 0 ? payload : 0x200U));
  }
  if (magnitude >= 0x47800000U) return signed_half(0x7C00U);  // 2^16 and above
  if (magnitude < 0x33000000U) return signed_half(0);         // below 2^-25, half of the smallest
  const std::uint32_t exponent = magnitude >> 23;
  // The magnitude in units of the result's last place is units / 2^shift.
  const std::uint32_t units = (magnitude & 0x7FFFFFU) | 0x800000U;
  std::uint32_t shift = 13, base = 0;
  if (exponent >= 113) {  // at least 2^-14: normal
    base = (exponent - 113) << 10;
  } else {  // units of 2^-24
    shift += 113 - exponent;
  }
  const std::uint32_t whole = units >> shift, rest = units & ((1U << shift) - 1), middle = 1U << (shift - 1);
  const bool up = rest > middle || (rest == middle && (whole & 1U) != 0);
  // The leading bit of a normal `whole` adds 1 to the exponent. A carry goes into the exponent and, from the largest
  // number, to infinity.
  return signed_half(base + whole + (up ? 1 : 0));
}

float float_of(Half value) {
  const std::uint32_t sign = (value.bits & 0x8000U) << 16, exponent = (value.bits >> 10) & 0x1FU;
  const std::uint32_t fraction = value.bits & 0x3FFU;
  if (exponent == 0) {  // zero or subnormal: units of 2^-24
    const float magnitude = static_cast<float>(fraction) * 0x1p-24F;
    return sign != 0 ? -magnitude : magnitude;
  }
  const std::uint32_t wide = exponent == 31 ? 255 : exponent + 112;
  return std::bit_cast<float>(sign | (wide << 23) | (fraction << 13));
}

}  // namespace ninebit
