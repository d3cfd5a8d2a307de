// Codes of depths that are real numbers: whole, or floating-point (rules 50 and 51).
#pragma once

#include <bit>
#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/surface.h"

namespace ninebit {

// How a format holds real numbers: whole, or with an exponent above the mantissa and without a sign.
class DepthNumbers {
 public:
  constexpr DepthNumbers(DepthStencilFormat format, Narrowing narrowing)
      : largest_code_(max_depth(format)),
        is_whole_(layout_of(format).exponent_bits == 0),
        half_(narrowing == Narrowing::toward_zero ? 0.0 : 0.5) {
    const DepthStencilLayout& layout = layout_of(format);
    const int exponents = 1 << layout.exponent_bits, bias = exponents / 2 - 1;
    const int mantissa = layout.depth_bits - layout.exponent_bits;
    dropped_ = kMantissa - mantissa;
    half_bit_ = narrowing == Narrowing::toward_zero ? 0 : std::uint64_t{1} << (dropped_ - 1);
    first_code_ = static_cast<std::uint64_t>(kBias - bias) << mantissa;
    largest_ = static_cast<double>(largest_code_);
    if (is_whole_) return;
    // 2^(largest exponent) × (2 - the last bit of the mantissa); 2^-bias.
    const std::int64_t one = std::int64_t{1} << mantissa;
    largest_ = static_cast<double>(2 * one - 1) / static_cast<double>(one);
    for (int i = 0; i < exponents / 2; ++i) largest_ *= 2.0;
    for (int i = 0; i < bias; ++i) least_ /= 2.0;
  }

  // The number of the largest code.
  [[nodiscard]] constexpr double largest() const { return largest_; }

  // The parts of code(), for vectors.
  [[nodiscard]] constexpr bool is_whole() const { return is_whole_; }
  [[nodiscard]] constexpr double half() const { return half_; }
  [[nodiscard]] constexpr double least() const { return least_; }
  [[nodiscard]] constexpr int dropped_bits() const { return dropped_; }
  [[nodiscard]] constexpr std::uint64_t half_bit() const { return half_bit_; }
  [[nodiscard]] constexpr std::uint64_t first_code() const { return first_code_; }
  [[nodiscard]] constexpr std::uint32_t largest_code() const { return largest_code_; }

  // Too small a number and NaN become 0, too large a one all ones; others are cut, or rounded to nearest, halves up.
  [[nodiscard]] std::uint32_t code(double number) const {
    if (is_whole_) {
      const double sum = number + half_;
      if (!(sum > 0.0)) return 0;
      return sum >= largest_ ? largest_code_ : static_cast<std::uint32_t>(sum);
    }
    if (!(number >= least_)) return 0;
    // A double's own bits, with its exponent moved.
    const std::uint64_t code = ((std::bit_cast<std::uint64_t>(number) + half_bit_) >> dropped_) - first_code_;
    return code < largest_code_ ? static_cast<std::uint32_t>(code) : largest_code_;
  }

 private:
  static constexpr int kMantissa = 52, kBias = 1023;  // of doubles
  std::uint32_t largest_code_;
  bool is_whole_;
  double half_;
  int dropped_ = 0;               // bits of a double's mantissa
  std::uint64_t half_bit_ = 0;    // of those, what rounds
  std::uint64_t first_code_ = 0;  // a double's upper bits where the code is 0
  double largest_ = 0.0, least_ = 1.0;
};

}  // namespace ninebit
