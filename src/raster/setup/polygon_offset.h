// The polygon offset, factor × m + units × r, of one polygon (OpenGL 1.3, 3.5.5).
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/pipeline_state.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

// A triangle's depth plane as exact fractions: window depth changes by dx / area for 1/16 pixel in x, dy / area in y.
// Within |dx|, |dy| <= 2^43, |area| <= 2^38.
struct DepthPlane {
  std::int64_t area = 0;  // twice the triangle's, in square sixteenths of a pixel; negative: clockwise
  std::int64_t dx = 0;
  std::int64_t dy = 0;
};
[[nodiscard]] DepthPlane depth_plane(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c);

// The offset stays within ± this in window depth, far beyond which every sum of depth and offset is clamped.
inline constexpr std::int64_t kLargestOffset = 1 << 25;

// How a profile finds offsets.
struct OffsetRule {
  OffsetSlope slope;
  OffsetFraction fraction;
  // The fraction bits that may be other than 0.
  [[nodiscard]] constexpr int bits() const { return fraction == OffsetFraction::kept ? kOffsetBits : 0; }
};

// A double's factor × m + units × r is within kOffsetError × (|factor × m| + |units × r| + 1) of the exact sum: m, the
// product, the sum, these bounds and the half that is added are eight roundings or fewer, of 2^-53 each.
inline constexpr double kOffsetError = 0x1p-49;

// The offset in window depth times 2^kOffsetBits: the exact sum, rounded to nearest, halves up, to the rule's fraction
// bits, and clamped to ±kLargestOffset. Doubles bound the sum; where both bounds do not round to the same number, whole
// numbers decide. The plane has an area; factor and units are finite.
[[nodiscard]] std::int64_t polygon_offset_q16(const PolygonOffset& offset, const OffsetRule& rule,
                                              const DepthPlane& plane, const WindowDepth& depth);

// The offset of a polygon with this triangle's plane, as primitives hold it. Of real numbers: factor × m + units, in
// doubles, to the nearest float, the largest at most; the slope of w is that at the first corner. The triangle has an
// area.
[[nodiscard]] SetupOffset setup_offset(const PolygonOffset& offset, const OffsetRule& rule,
                                       const std::array<WindowVertex, 3>& triangle, const WindowDepth& depth);

// Whole numbers from 0 to 2^768 - 1, for comparisons that must be exact and are rare.

// Results must fit; nothing is checked.
class WideNumber {
 public:
  WideNumber() = default;
  // value × 2^shift
  explicit WideNumber(std::uint64_t value, int shift = 0) {
    const auto at = static_cast<std::size_t>(shift / kBits);
    const int rest = shift % kBits;
    limb_[at] = value << rest;
    if (rest > 0 && at + 1 < kLimbs) limb_[at + 1] = value >> (kBits - rest);
  }

  friend WideNumber operator+(const WideNumber& a, const WideNumber& b) {
    WideNumber sum;
    Pair carry = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      carry += static_cast<Pair>(a.limb_[i]) + b.limb_[i];
      sum.limb_[i] = static_cast<std::uint64_t>(carry);
      carry >>= kBits;
    }
    return sum;
  }
  // a >= b
  friend WideNumber operator-(const WideNumber& a, const WideNumber& b) {
    WideNumber difference;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      const Pair left = static_cast<Pair>(a.limb_[i]) - b.limb_[i] - borrow;
      difference.limb_[i] = static_cast<std::uint64_t>(left);
      borrow = static_cast<std::uint64_t>(left >> kBits) & 1;
    }
    return difference;
  }
  friend WideNumber operator*(const WideNumber& a, const WideNumber& b) {
    WideNumber product;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      if (a.limb_[i] == 0) continue;
      Pair carry = 0;
      for (std::size_t j = 0; i + j < kLimbs; ++j) {
        carry += static_cast<Pair>(a.limb_[i]) * b.limb_[j] + product.limb_[i + j];
        product.limb_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= kBits;
      }
    }
    return product;
  }
  friend std::strong_ordering operator<=>(const WideNumber& a, const WideNumber& b) {
    for (std::size_t i = kLimbs; i-- > 0;) {
      if (a.limb_[i] != b.limb_[i]) return a.limb_[i] <=> b.limb_[i];
    }
    return std::strong_ordering::equal;
  }
  friend bool operator==(const WideNumber&, const WideNumber&) = default;

 private:
  __extension__ using Pair = unsigned __int128;
  static constexpr int kBits = 64;
  static constexpr std::size_t kLimbs = 12;
  std::array<std::uint64_t, kLimbs> limb_{};  // the lowest first
};

}  // namespace ninebit
