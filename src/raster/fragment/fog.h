// Fog factors of fragments (rules 25 and 49).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/pipeline_state.h"

namespace ninebit {

// With the NV2A's rounding nothing here branches at a fragment: compilers vectorize loops of it.

// 2^t for t <= 0, with sums and products alone, which give every machine the same bits. Its relative error is below
// 2^-40; where t is below -64, or NaN, it is 0.
[[gnu::always_inline]] inline double power_of_two(double t) {
  constexpr double kLog2 = 0x1.62e42fefa39efp-1;
  constexpr int kTerms = 14;
  const double near_enough = t > -64.0 ? t : -64.0;
  const double whole = std::floor(near_enough), x = (near_enough - whole) * kLog2;
  double sum = 1.0;  // 1 + x (1 + x / 2 (1 + x / 3 …))
  for (int k = kTerms; k >= 1; --k) sum = 1.0 + x * (1.0 / k) * sum;
  // The exponent as the low bits of a number from 2^52 on.
  const double power = std::bit_cast<double>(std::bit_cast<std::uint64_t>(whole + (0x1p52 + 1023.0)) << 52);
  return t > -64.0 ? sum * power : 0.0;
}

// fog_byte() of one function.
template <FogFunction kFunction>
[[gnu::always_inline]] inline std::uint8_t fog_byte_of(const HardwareProfile& profile, const Fog& fog, float x) {
  using enum FogFunction;
  if constexpr (kFunction == factor) return byte_of_fog_factor(profile, x);
  if constexpr (kFunction == linear || kFunction == linear_abs) {
    const float at = kFunction == linear ? x : std::fabs(x);
    return byte_of_fog_factor(profile, fog.bias - 1.0F + fog.slope * at);
  }
  const double t = static_cast<double>(fog.bias) - 1.5 + static_cast<double>(fog.slope) * static_cast<double>(x);
  const double exponent = kFunction == exp       ? (t > 0.0 ? 0.0 : 16.0 * t)
                          : kFunction == exp_abs ? -16.0 * std::fabs(t)
                                                 : -32.0 * t * t;
  return static_cast<std::uint8_t>(static_cast<int>(power_of_two(exponent) * 255.0 + 0.5));
}

// Calls visit() with the function as a constant.
template <class Visit>
void with_fog_function(FogFunction function, const Visit& visit) {
  using enum FogFunction;
  switch (function) {
    case factor:
      return visit(std::integral_constant<FogFunction, factor>());
    case linear:
      return visit(std::integral_constant<FogFunction, linear>());
    case linear_abs:
      return visit(std::integral_constant<FogFunction, linear_abs>());
    case exp:
      return visit(std::integral_constant<FogFunction, exp>());
    case exp_abs:
      return visit(std::integral_constant<FogFunction, exp_abs>());
    case exp2:
    case exp2_abs:
      return visit(std::integral_constant<FogFunction, exp2>());
  }
}

// A vertex's value as it is interpolated.
[[nodiscard]] inline float fog_at_vertex(const Fog& fog, float value) {
  if (fog.function != FogFunction::factor) return value;
  return !(value > 0.0F) ? 0.0F : value > 1.0F ? 1.0F : value;
}

// The byte of the factor at a fragment whose interpolated value is x: factors and the linear functions as
// byte_of_fog_factor (rule 25), the exponential ones to nearest (rule 49). NaN becomes 0.
[[nodiscard]] std::uint8_t fog_byte(const HardwareProfile& profile, const Fog& fog, float x);

}  // namespace ninebit
