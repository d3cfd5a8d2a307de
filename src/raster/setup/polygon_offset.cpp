#include "src/raster/setup/polygon_offset.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace ninebit {
namespace {

// The terms of the sum. The depth changes per pixel are numerators over the area.
struct OffsetTerms {
  float factor;
  float units;
  int step_bits;  // r is 2^step_bits
  OffsetSlope slope;
  int scale_bits;     // the whole sum is times 2^scale_bits
  std::int64_t area;  // > 0
  std::int64_t dx;    // >= 0, <= 2^47
  std::int64_t dy;
};

// Floats are whole numbers in steps of 2^-150.
constexpr int kFloatSteps = 150;

// |x| × 2^kFloatSteps × 2^shift
WideNumber magnitude(float x, int shift = 0) {
  constexpr int kMantissaBits = 23;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t mantissa = bits & ((1U << kMantissaBits) - 1), exponent = bits >> kMantissaBits & 0xFFU;
  // The least exponent, and no leading one, are those of subnormal numbers.
  if (exponent == 0) return WideNumber(mantissa, 1 + shift);
  return WideNumber(mantissa | 1U << kMantissaBits, static_cast<int>(exponent) + shift);
}

WideNumber square(const WideNumber& x) {
  return x * x;
}

// Whether factor × m + units × r >= n - 1/2, that is, factor × numerator >= area × (n - 1/2 - units × r), with both
// terms times 2^scale_bits. The numerator of m may be a root, so that squares are compared where the signs do not
// decide. Their sizes: below 2^294 × 2^48 on the left, 2^38 × 2^304 on the right.
bool reaches(const OffsetTerms& t, std::int64_t n) {
  const WideNumber zero, units = magnitude(t.units, t.step_bits + t.scale_bits);
  const std::int64_t twice = 2 * n - 1;
  const WideNumber half_below(static_cast<std::uint64_t>(std::abs(twice)), kFloatSteps - 1);
  // The right side's second factor: a difference of sizes where both terms have the same sign.
  const bool adds = (twice < 0) != (t.units < 0);
  const bool is_first_larger = half_below >= units;
  const WideNumber rest = adds ? half_below + units : is_first_larger ? half_below - units : units - half_below;
  const bool is_negative = adds || is_first_larger ? twice < 0 : twice > 0;

  const WideNumber dx(static_cast<std::uint64_t>(t.dx)), dy(static_cast<std::uint64_t>(t.dy));
  const WideNumber slope_squared = t.slope == OffsetSlope::root ? square(dx) + square(dy) : square(std::max(dx, dy));
  const WideNumber left = square(magnitude(t.factor, t.scale_bits)) * slope_squared;
  const WideNumber right = square(WideNumber(static_cast<std::uint64_t>(t.area)) * rest);
  const int left_sign = left == zero ? 0 : t.factor < 0 ? -1 : 1;
  const int right_sign = right == zero ? 0 : is_negative ? -1 : 1;
  if (left_sign != right_sign) return left_sign > right_sign;
  return left_sign < 0 ? left <= right : left >= right;
}

// To nearest, halves up, times 2^bits.
std::int64_t rounded(double sum, int bits) {
  constexpr auto kLimit = static_cast<double>(kLargestOffset);
  return static_cast<std::int64_t>(std::floor(std::ldexp(std::clamp(sum, -kLimit, kLimit), bits) + 0.5));
}

}  // namespace

DepthPlane depth_plane(const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
  const std::int64_t bx = b.x_q4 - a.x_q4, by = b.y_q4 - a.y_q4, cx = c.x_q4 - a.x_q4, cy = c.y_q4 - a.y_q4;
  const std::int64_t bz = std::int64_t{b.z24} - a.z24, cz = std::int64_t{c.z24} - a.z24;
  return {.area = bx * cy - by * cx, .dx = bz * cy - cz * by, .dy = bx * cz - cx * bz};
}

// Rule 20.
std::int64_t polygon_offset_q16(const PolygonOffset& offset, const OffsetRule& rule, const DepthPlane& plane,
                                const WindowDepth& depth) {
  const OffsetTerms t{.factor = offset.factor,
                      .units = offset.units,
                      .step_bits = depth.fraction_bits(),
                      .slope = rule.slope,
                      .scale_bits = rule.bits(),
                      .area = std::abs(plane.area),
                      .dx = 16 * std::abs(plane.dx),
                      .dy = 16 * std::abs(plane.dy)};
  // Numerators within 2^48, which doubles hold exactly.
  const auto area = static_cast<double>(t.area);
  double m = static_cast<double>(std::max(t.dx, t.dy)) / area;
  if (rule.slope == OffsetSlope::root) {
    const double x = static_cast<double>(t.dx) / area, y = static_cast<double>(t.dy) / area;
    m = std::sqrt(x * x + y * y);
  }
  const double moved = static_cast<double>(offset.factor) * m;
  const double raised = static_cast<double>(offset.units) * static_cast<double>(depth.step_z24());
  const double sum = moved + raised, error = kOffsetError * (std::fabs(moved) + std::fabs(raised) + 1.0);
  // The largest number that the exact sum reaches.
  std::int64_t low = rounded(sum - error, rule.bits()), high = rounded(sum + error, rule.bits());
  while (low < high) {
    const std::int64_t middle = low + (high - low + 1) / 2;
    if (reaches(t, middle)) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low << (kOffsetBits - rule.bits());
}

namespace {

// Rules 50 and 51.
float real_offset(const PolygonOffset& offset, OffsetSlope slope, const std::array<WindowVertex, 3>& v,
                  const WindowDepth& depth) {
  const auto number = [&](std::size_t i) { return static_cast<double>(std::bit_cast<float>(v[i].z24)); };
  const auto from_first = [&](std::int32_t WindowVertex::*at, std::size_t i) {
    return static_cast<double>(v[i].*at - v[0].*at);
  };
  const double bx = from_first(&WindowVertex::x_q4, 1), by = from_first(&WindowVertex::y_q4, 1);
  const double cx = from_first(&WindowVertex::x_q4, 2), cy = from_first(&WindowVertex::y_q4, 2);
  const double bz = number(1) - number(0), cz = number(2) - number(0);
  // 1/w is linear in the window: w changes by its square times as much.
  const double scale = depth.is_w() ? 1.0 / (number(0) * number(0)) : depth.one();
  const double per_pixel = 16.0 * scale / std::fabs(bx * cy - by * cx);
  const double dx = std::fabs(bz * cy - cz * by) * per_pixel, dy = std::fabs(bx * cz - cx * bz) * per_pixel;
  const double m = slope == OffsetSlope::root ? std::sqrt(dx * dx + dy * dy) : std::max(dx, dy);
  constexpr double kMost = std::numeric_limits<float>::max();
  const double sum = static_cast<double>(offset.factor) * m + static_cast<double>(offset.units);
  return static_cast<float>(std::clamp(sum, -kMost, kMost));
}

}  // namespace

SetupOffset setup_offset(const PolygonOffset& offset, const OffsetRule& rule, const std::array<WindowVertex, 3>& v,
                         const WindowDepth& depth) {
  if (depth.is_real()) return SetupOffset(real_offset(offset, rule.slope, v, depth));
  return {polygon_offset_q16(offset, rule, depth_plane(v[0], v[1], v[2]), depth), depth.cuts()};
}

}  // namespace ninebit
