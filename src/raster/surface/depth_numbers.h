// Codes of depths that are real numbers: whole, or floating-point (rules 50 and 51).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/surface.h"

namespace ninebit {

// How a format holds real numbers: whole, or with an exponent above the mantissa and without a sign.
class DepthNumbers {
 public:
  constexpr DepthNumbers(DepthStencilFormat format, Narrowing narrowing)
      : layout_(layout_of(format)),
        cuts_(narrowing == Narrowing::toward_zero),
        largest_code_(max_depth(format)),
        largest_(largest_number(layout_)) {}

  // The number of the largest code.
  [[nodiscard]] constexpr double largest() const { return largest_; }

  // Too small a number and NaN become 0, too large a one all ones; others are cut, or rounded to nearest, halves up.
  [[nodiscard]] std::uint32_t code(double number) const {
    if (layout_.exponent_bits == 0) {
      const double sum = number + (cuts_ ? 0.0 : 0.5);
      if (!(sum > 0.0)) return 0;
      return sum >= static_cast<double>(largest_code_) ? largest_code_ : static_cast<std::uint32_t>(sum);
    }
    const int bias = (1 << layout_.exponent_bits) / 2 - 1, mantissa = layout_.depth_bits - layout_.exponent_bits;
    if (!(number >= std::ldexp(1.0, -bias))) return 0;
    // A double's own bits, with its exponent moved.
    constexpr int kMantissa = 52, kBias = 1023;
    const int dropped = kMantissa - mantissa;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(number) + (cuts_ ? 0 : std::uint64_t{1} << (dropped - 1));
    const std::uint64_t code = (bits >> dropped) - (static_cast<std::uint64_t>(kBias - bias) << mantissa);
    return code < largest_code_ ? static_cast<std::uint32_t>(code) : largest_code_;
  }

 private:
  // 2^(largest exponent) × (2 - the last bit of the mantissa), or all ones.
  static constexpr double largest_number(const DepthStencilLayout& layout) {
    if (layout.exponent_bits == 0) return static_cast<double>((std::int64_t{1} << layout.depth_bits) - 1);
    const std::int64_t one = std::int64_t{1} << (layout.depth_bits - layout.exponent_bits);
    double number = static_cast<double>(2 * one - 1) / static_cast<double>(one);
    for (int i = 0; i < (1 << layout.exponent_bits) / 2; ++i) number *= 2.0;
    return number;
  }

  DepthStencilLayout layout_;
  bool cuts_;
  std::uint32_t largest_code_;
  double largest_;
};

}  // namespace ninebit
