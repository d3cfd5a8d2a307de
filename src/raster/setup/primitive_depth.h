// Depth codes on a primitive.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"
#include "src/raster/surface/floor_divider.h"

namespace ninebit {

// The depths of a format of real numbers on a primitive (rules 50 and 51), from shares of its corners:
// FragmentPlace::edge, in doubles. lane_depth-inl.h does the same operations in vectors, in the same order.
struct RealDepth {
  std::array<double, 3> corner;  // window depths, or 1/w
  double parts;                  // the sum of the shares
  double offset;

  RealDepth(const SetupPrimitive& p, std::int64_t sum_of_shares)
      : parts(static_cast<double>(sum_of_shares)), offset(static_cast<double>(std::bit_cast<float>(p.offset_z24))) {
    for (std::size_t i = 0; i < 3; ++i) corner[i] = static_cast<double>(std::bit_cast<float>(p.z24[i]));
  }
  [[nodiscard]] double number(const WindowDepth& depth, const std::array<std::int64_t, 3>& share) const {
    const auto of = [&](std::size_t i) { return static_cast<double>(share[i]) * corner[i]; };
    const double sum = (of(0) + of(1)) + of(2);
    return (depth.is_w() ? parts / sum : sum / parts * depth.one()) + offset;
  }
};

// `parts` is the sum of a fragment's shares: a triangle's area, a line's squared length, 1 of a point.
class PrimitiveDepth {
 public:
  PrimitiveDepth(const WindowDepth& depth, const SetupPrimitive& p, std::int64_t parts)
      : depth_(depth),
        p_(p),
        divide_(parts),
        real_(p, parts),
        fraction_(p.fraction_of(parts)),
        is_real_(depth.is_real()),
        is_code_(p.offset_z24 == 0 && depth.step_z24() == 1) {}

  // The code at a fragment with these shares.
  [[nodiscard]] std::uint32_t operator()(const std::array<std::int64_t, 3>& share) const {
    if (is_real_) return depth_.code_of_number(real_.number(depth_, share));
    const std::int64_t wide = share[0] * p_.z24[0] + share[1] * p_.z24[1] + share[2] * p_.z24[2];
    const auto z24 = static_cast<std::uint32_t>(divide_(wide + fraction_));
    return is_code_ ? z24 : depth_.code(z24, p_.offset_z24);
  }

 private:
  const WindowDepth& depth_;
  const SetupPrimitive& p_;
  FloorDivider divide_;
  RealDepth real_;
  std::int64_t fraction_;
  bool is_real_, is_code_;
};

}  // namespace ninebit
