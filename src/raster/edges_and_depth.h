// Which pixels a triangle covers, and how deep it lies there: integers alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "src/raster/triangle_setup.h"

namespace ninebit {

// n / d rounded down, for n >= 0, d > 0 and n / d < 2^26. The double quotient, cut to a whole number, is off by one at
// most; the remainder, an integer, says whether it is. (Of a negative n it could be off by two.)
struct FloorDivider {
  std::int64_t divisor;
  double inverse;
  explicit FloorDivider(std::int64_t d) : divisor(d), inverse(1.0 / static_cast<double>(d)) {}
  [[nodiscard]] std::int64_t operator()(std::int64_t n) const {
    auto q = static_cast<std::int64_t>(static_cast<double>(n) * inverse);
    const std::int64_t remainder = n - q * divisor;
    q -= remainder < 0 ? 1 : 0;
    q += remainder >= divisor ? 1 : 0;
    return q;
  }
};

// A triangle's edge functions and depth plane at pixel centres. Edge i lies opposite corner i; its function is twice
// the area of the triangle that the edge and the point make, positive inside, in square sixteenths of a pixel.
class EdgesAndDepth {
 public:
  explicit EdgesAndDepth(const SetupTriangle& t) : triangle_(t), area_(area_of(t)), divide_(2 * area_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      const std::int64_t dx = t.x_q4[b] - t.x_q4[a], dy = t.y_q4[b] - t.y_q4[a];
      step_x_[i] = -dy * 16;
      step_y_[i] = dx * 16;
      // At the centre of pixel (0, 0).
      origin_[i] = dx * (8 - t.y_q4[a]) - dy * (8 - t.x_q4[a]);
      // Top-left rule: a centre on an edge is inside when the edge goes down (left) or, level, to the left (top).
      threshold_[i] = dy < 0 || (dy == 0 && dx < 0) ? 0 : 1;
    }
  }

  [[nodiscard]] std::array<std::int64_t, 3> at(int x, int y) const {
    std::array<std::int64_t, 3> e;
    for (std::size_t i = 0; i < 3; ++i) e[i] = origin_[i] + step_x_[i] * x + step_y_[i] * y;
    return e;
  }
  void step_right(std::array<std::int64_t, 3>& e) const {
    for (std::size_t i = 0; i < 3; ++i) e[i] += step_x_[i];
  }
  [[nodiscard]] bool inside(const std::array<std::int64_t, 3>& e) const {
    return e[0] >= threshold_[0] && e[1] >= threshold_[1] && e[2] >= threshold_[2];
  }

  // The depth plane, rounded to nearest, halves up. Within the triangle it lies between the corners' depths.
  [[nodiscard]] std::uint32_t z24(const std::array<std::int64_t, 3>& e) const {
    const std::int64_t wide = e[0] * triangle_.z24[0] + e[1] * triangle_.z24[1] + e[2] * triangle_.z24[2];
    return static_cast<std::uint32_t>(divide_(2 * wide + area_));
  }

  // Narrows [first, last] to the pixels of row y inside the triangle; false: there are none.
  [[nodiscard]] bool span(int y, int& first, int& last) const {
    const std::array<std::int64_t, 3> e = at(0, y);
    std::int64_t low = first, high = last;
    for (std::size_t i = 0; i < 3; ++i) {
      // The x with e + step · x >= threshold.
      const std::int64_t need = threshold_[i] - e[i];
      if (step_x_[i] > 0) {
        low = std::max(low, ceil_divide(need, step_x_[i]));
      } else if (step_x_[i] < 0) {
        high = std::min(high, floor_divide(-need, -step_x_[i]));
      } else if (need > 0) {
        return false;
      }
    }
    first = static_cast<int>(low);
    last = static_cast<int>(high);
    return low <= high;
  }

 private:
  static std::int64_t area_of(const SetupTriangle& t) {
    return static_cast<std::int64_t>(t.x_q4[1] - t.x_q4[0]) * (t.y_q4[2] - t.y_q4[0]) -
           static_cast<std::int64_t>(t.y_q4[1] - t.y_q4[0]) * (t.x_q4[2] - t.x_q4[0]);
  }
  static std::int64_t floor_divide(std::int64_t n, std::int64_t d) {
    const std::int64_t q = n / d;
    return q - (n % d < 0 ? 1 : 0);
  }
  static std::int64_t ceil_divide(std::int64_t n, std::int64_t d) { return -floor_divide(-n, d); }

  const SetupTriangle& triangle_;
  std::int64_t area_;
  FloorDivider divide_;
  std::array<std::int64_t, 3> step_x_, step_y_, origin_, threshold_;
};

}  // namespace ninebit
