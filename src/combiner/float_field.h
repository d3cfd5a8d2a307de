// 32-bit floats, a Field of real_rules.h. Compiled without contraction.
#pragma once

#include <cmath>

namespace ninebit {

class FloatField {
 public:
  using Number = float;

  explicit FloatField(int one) : one_(one) {}

  static Number whole(int n) { return static_cast<float>(n); }
  static Number half() { return 0.5F; }
  [[nodiscard]] Number of_code(int code) const { return static_cast<float>(code) / static_cast<float>(one_); }
  static Number add(Number x, Number y) { return x + y; }
  static Number sub(Number x, Number y) { return x - y; }
  static Number mul(Number x, Number y) { return x * y; }
  static Number scaled(Number x, int exponent) { return x * (exponent < 0 ? 0.5F : static_cast<float>(1 << exponent)); }
  static bool is_negative(Number x) { return x < 0.0F; }
  static bool less(Number x, Number y) { return x < y; }

  // Returns the nearest code, halves up. A double holds the product and the sum exactly.
  [[nodiscard]] int nearest_code(Number x) const {
    return static_cast<int>(std::floor(static_cast<double>(x) * one_ + 0.5));
  }
  static double to_double(Number x) { return static_cast<double>(x); }

 private:
  int one_;
};

}  // namespace ninebit
