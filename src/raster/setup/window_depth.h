// Window depth in 24 bits: the depth codes of a target's format, with as many fraction bits as are left.
#pragma once

#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/surface.h"
#include "src/raster/rules/one_fragment.h"

namespace ninebit {

class WindowDepth {
 public:
  // `narrowing` is that of depths on primitives, to codes.
  constexpr WindowDepth(DepthStencilFormat format, Narrowing narrowing)
      : fraction_bits_(24 - depth_bits(format)),
        half_(narrowing == Narrowing::toward_zero ? 0 : (1 << fraction_bits_) >> 1),
        cuts_(narrowing == Narrowing::toward_zero),
        max_z24_(std::int64_t{max_depth(format)} << fraction_bits_) {}

  // One step of the format, and the depth 1.
  [[nodiscard]] constexpr std::int64_t step_z24() const { return std::int64_t{1} << fraction_bits_; }
  [[nodiscard]] constexpr std::int64_t max_z24() const { return max_z24_; }
  [[nodiscard]] constexpr int fraction_bits() const { return fraction_bits_; }
  // Added to z24 by code() before it drops the fraction bits.
  [[nodiscard]] constexpr int half() const { return half_; }
  // Whether depths on primitives are cut; else they are rounded to nearest, halves up.
  [[nodiscard]] constexpr bool cuts() const { return cuts_; }

  // A vertex's depth in [0, 1], rounded to nearest, halves up; clamped, NaN becomes 0.
  [[nodiscard]] constexpr std::uint32_t z24_of(double depth) const {
    const auto largest = static_cast<double>(max_z24_);
    const double z = depth * largest + 0.5;
    if (!(z > 0.0)) return 0;
    return z >= largest ? static_cast<std::uint32_t>(max_z24_) : static_cast<std::uint32_t>(z);
  }

  // The code that is compared and stored. |offset_z24| is at most 2^25.
  [[nodiscard]] std::uint32_t code(std::uint32_t z24, std::int32_t offset_z24) const {
    return static_cast<std::uint32_t>(one_fragment::depth_code(one_fragment::Numbers(), static_cast<std::int32_t>(z24),
                                                               offset_z24, static_cast<std::int32_t>(max_z24_),
                                                               fraction_bits_, half_));
  }

 private:
  int fraction_bits_, half_;
  bool cuts_;
  std::int64_t max_z24_;
};

}  // namespace ninebit
