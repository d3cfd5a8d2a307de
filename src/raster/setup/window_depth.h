// Window depth in 24 bits: the depth codes of a target's format, with as many fraction bits as are left.
#pragma once

#include <algorithm>
#include <cstdint>

#include "ninebit/raster/surface.h"

namespace ninebit {

class WindowDepth {
 public:
  explicit constexpr WindowDepth(DepthStencilFormat format)
      : fraction_bits_(24 - depth_bits(format)), max_z24_(std::int64_t{max_depth(format)} << fraction_bits_) {}

  // One step of the format, and the depth 1.
  [[nodiscard]] constexpr std::int64_t step_z24() const { return std::int64_t{1} << fraction_bits_; }
  [[nodiscard]] constexpr std::int64_t max_z24() const { return max_z24_; }
  [[nodiscard]] constexpr int fraction_bits() const { return fraction_bits_; }

  // A depth in [0, 1], rounded to nearest, halves up; clamped, NaN becomes 0.
  [[nodiscard]] constexpr std::uint32_t z24_of(double depth) const {
    const auto largest = static_cast<double>(max_z24_);
    const double z = depth * largest + 0.5;
    if (!(z > 0.0)) return 0;
    return z >= largest ? static_cast<std::uint32_t>(max_z24_) : static_cast<std::uint32_t>(z);
  }

  // The code that is compared and stored: z24 + offset, clamped, without its fraction bits, halves up.
  [[nodiscard]] constexpr std::uint32_t code(std::int64_t z24, std::int64_t offset_z24) const {
    const std::int64_t z = std::clamp(z24 + offset_z24, std::int64_t{0}, max_z24_);
    return static_cast<std::uint32_t>((z + (step_z24() >> 1)) >> fraction_bits_);
  }

 private:
  int fraction_bits_;
  std::int64_t max_z24_;
};

}  // namespace ninebit
