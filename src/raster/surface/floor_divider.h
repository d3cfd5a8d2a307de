// Integer division by one divisor, many times.
#pragma once

#include <cstdint>

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

// n / d rounded down or up, for any n and d > 0.
[[nodiscard]] constexpr std::int64_t floor_divide(std::int64_t n, std::int64_t d) {
  return n / d - (n % d < 0 ? 1 : 0);
}
[[nodiscard]] constexpr std::int64_t ceil_divide(std::int64_t n, std::int64_t d) {
  return -floor_divide(-n, d);
}

}  // namespace ninebit
