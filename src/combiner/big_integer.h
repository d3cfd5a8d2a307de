// Integers of any size, with only the operations that exact evaluation needs. There is no division.
#pragma once

#include <cstdint>
#include <vector>

namespace ninebit {

class BigInteger {
 public:
  BigInteger() = default;
  explicit BigInteger(std::int64_t value);

  // -1, 0 or 1.
  [[nodiscard]] int sign() const { return limbs_.empty() ? 0 : negative_ ? -1 : 1; }
  // The number of bits of the magnitude: 0 for zero, else 1 + floor(log2 |x|).
  [[nodiscard]] int bit_length() const;
  // The first 64 bits of the magnitude: |x| · 2^(64 - bit_length()), truncated; 0 for zero.
  [[nodiscard]] std::uint64_t leading_bits() const;

  [[nodiscard]] BigInteger magnitude() const;
  [[nodiscard]] BigInteger shifted_left(int bits) const;
  void double_in_place();
  // Subtracts in place. Both are at least 0, and `smaller` is not larger.
  void subtract(const BigInteger& smaller);

  friend BigInteger operator-(BigInteger x);
  friend BigInteger operator+(const BigInteger& x, const BigInteger& y) { return sum(x, y, y.negative_); }
  friend BigInteger operator-(const BigInteger& x, const BigInteger& y) { return sum(x, y, !y.negative_); }
  friend BigInteger operator*(const BigInteger& x, const BigInteger& y);
  friend bool operator<(const BigInteger& x, const BigInteger& y);
  friend bool operator==(const BigInteger&, const BigInteger&) = default;

 private:
  using Limbs = std::vector<std::uint64_t>;  // the lowest first; the last is not zero

  static int compare(const Limbs& x, const Limbs& y);
  static BigInteger sum(const BigInteger& x, const BigInteger& y, bool y_negative);
  void trim();

  Limbs limbs_;
  bool negative_ = false;  // never of zero
};

// Returns n / d as the nearest double, ties to even, including subnormal numbers. d > 0.
[[nodiscard]] double nearest_double(const BigInteger& n, const BigInteger& d);

}  // namespace ninebit
