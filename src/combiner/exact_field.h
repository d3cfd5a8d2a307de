// Exact numbers n / (2^twos · one^ones). Sums, products and halves of register codes all have this form.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "ninebit/combiner/registers.h"
#include "src/combiner/big_integer.h"

namespace ninebit {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Unsigned128;

// Integers below 2^126, which suffice for two general combiners of ordinary programs. An overflow is remembered;
// results computed after it are meaningless.
class SmallIntegers {
 public:
  using Integer = Int128;

  explicit SmallIntegers(int one) {
    powers_[0] = 1;
    for (std::size_t i = 1; i < kPowers; ++i) powers_[i] = powers_[i - 1] * one;
    inverses_[0] = 1.0;
    for (std::size_t i = 1; i < kPowers; ++i) inverses_[i] = inverses_[i - 1] / one;
  }

  [[nodiscard]] bool overflowed() const { return overflowed_; }
  void forget_overflow() { overflowed_ = false; }

  static Integer whole(int n) { return n; }
  static int sign(Integer x) { return x < 0 ? -1 : x > 0 ? 1 : 0; }
  Integer add(Integer x, Integer y) { return checked(x + y); }
  Integer sub(Integer x, Integer y) { return checked(x - y); }
  Integer mul(Integer x, Integer y) {
    const bool fits = (static_cast<std::int64_t>(x) == x && static_cast<std::int64_t>(y) == y) ||
                      bit_length(x) + bit_length(y) <= kBits;
    return fits ? x * y : overflow();
  }
  Integer shift(Integer x, int bits) { return bit_length(x) + bits <= kBits ? x * (Integer{1} << bits) : overflow(); }
  Integer power(int exponent) {
    return exponent < static_cast<int>(kPowers) ? powers_[static_cast<std::size_t>(exponent)] : overflow();
  }
  // Returns n / (2^twos · one^ones) with a relative error below 2^-40.
  [[nodiscard]] double approximate(Integer n, int twos, int ones) const {
    if (ones >= static_cast<int>(kPowers)) return 0.0;  // after an overflow
    return std::ldexp(static_cast<double>(n) * inverses_[static_cast<std::size_t>(ones)], -twos);
  }

 private:
  static constexpr int kBits = 126;
  static constexpr std::size_t kPowers = 16;  // 255^15 is below 2^120

  static int bit_length(Integer x) {
    const auto magnitude = static_cast<Unsigned128>(x < 0 ? -x : x);
    const auto high = static_cast<std::uint64_t>(magnitude >> 64);
    return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(static_cast<std::uint64_t>(magnitude));
  }
  Integer overflow() {
    overflowed_ = true;
    return 0;
  }
  Integer checked(Integer x) {
    constexpr Integer kLimit = Integer{1} << kBits;
    return x < kLimit && x > -kLimit ? x : overflow();
  }

  std::array<Integer, kPowers> powers_;
  std::array<double, kPowers> inverses_;
  bool overflowed_ = false;
};

// Integers of any size.
class BigIntegers {
 public:
  using Integer = BigInteger;

  explicit BigIntegers(int one) : one_(one) {}

  [[nodiscard]] static bool overflowed() { return false; }

  static Integer whole(int n) { return BigInteger(n); }
  static int sign(const Integer& x) { return x.sign(); }
  static Integer add(const Integer& x, const Integer& y) { return x + y; }
  static Integer sub(const Integer& x, const Integer& y) { return x - y; }
  static Integer mul(const Integer& x, const Integer& y) { return x * y; }
  static Integer shift(const Integer& x, int bits) { return x.shifted_left(bits); }
  const Integer& power(int exponent) {
    while (powers_.size() <= static_cast<std::size_t>(exponent)) powers_.push_back(powers_.back() * BigInteger(one_));
    return powers_[static_cast<std::size_t>(exponent)];
  }
  [[nodiscard]] double approximate(const Integer& n, int twos, int ones) {
    if (n.sign() == 0) return 0.0;
    const BigInteger& d = power(ones);
    const double ratio = static_cast<double>(n.leading_bits()) / static_cast<double>(d.leading_bits());
    return n.sign() * std::ldexp(ratio, n.bit_length() - d.bit_length() - twos);
  }
  [[nodiscard]] double nearest_double(const Integer& n, int twos, int ones) {
    return ninebit::nearest_double(n, power(ones).shifted_left(twos));
  }

 private:
  int one_;
  std::vector<BigInteger> powers_{BigInteger(1)};
};

// Arithmetic on these fractions, a Field of real_rules.h.
template <class Integers>
class ExactField {
 public:
  using Integer = typename Integers::Integer;
  struct Number {
    Integer n{};
    int twos = 0;
    int ones = 0;
  };

  explicit ExactField(int one) : one_(one), integers_(one) {}

  Integers& integers() { return integers_; }

  [[nodiscard]] Number whole(int n) const { return {Integers::whole(n), 0, 0}; }
  [[nodiscard]] Number half() const { return {Integers::whole(1), 1, 0}; }
  // Returns the number of a register code.
  [[nodiscard]] Number of_code(int code) const {
    if (code == 0) return {};
    if (code == one_ || code == -one_) return whole(code / one_);
    return {Integers::whole(code), 0, 1};
  }

  Number add(const Number& x, const Number& y) {
    return combine(x, y, [&](const Integer& a, const Integer& b) { return integers_.add(a, b); });
  }
  Number sub(const Number& x, const Number& y) {
    return combine(x, y, [&](const Integer& a, const Integer& b) { return integers_.sub(a, b); });
  }
  Number mul(const Number& x, const Number& y) {
    Integer n = integers_.mul(x.n, y.n);
    if (Integers::sign(n) == 0) return {};
    return {std::move(n), x.twos + y.twos, x.ones + y.ones};
  }
  // Returns x · 2^exponent.
  Number scaled(Number x, int exponent) {
    if (Integers::sign(x.n) == 0) return x;
    const int twos = x.twos - exponent;
    x.twos = twos < 0 ? 0 : twos;
    if (twos < 0) x.n = integers_.shift(x.n, -twos);
    return x;
  }
  [[nodiscard]] bool is_negative(const Number& x) const { return Integers::sign(x.n) < 0; }
  bool less(const Number& x, const Number& y) { return Integers::sign(sub(x, y).n) < 0; }

  // Returns the nearest code, halves up; x in [-2, 2].
  int nearest_code(const Number& x) {
    const double codes = integers_.approximate(x.n, x.twos, x.ones) * one_ + 0.5;
    const double border = std::nearbyint(codes);
    if (std::abs(codes - border) > 1e-6) return static_cast<int>(std::floor(codes));
    // The approximation is too close to the border between two codes.
    const int above = static_cast<int>(border);
    return less(mul(x, whole(2 * one_)), whole(2 * above - 1)) ? above - 1 : above;
  }
  // Returns x with a relative error of at most 2^-40.
  double approximate(const Number& x) { return integers_.approximate(x.n, x.twos, x.ones); }
  double to_double(const Number& x) { return integers_.nearest_double(x.n, x.twos, x.ones); }

 private:
  template <class Combine>
  Number combine(const Number& x, const Number& y, Combine combined) {
    if (x.twos == y.twos && x.ones == y.ones) return normal({combined(x.n, y.n), x.twos, x.ones});
    const int twos = x.twos > y.twos ? x.twos : y.twos;
    const int ones = x.ones > y.ones ? x.ones : y.ones;
    return normal({combined(over(x, twos, ones), over(y, twos, ones)), twos, ones});
  }
  // Returns the numerator of x over a larger denominator.
  Integer over(const Number& x, int twos, int ones) {
    if (Integers::sign(x.n) == 0) return x.n;
    Integer n = twos == x.twos ? x.n : integers_.shift(x.n, twos - x.twos);
    return ones == x.ones ? n : integers_.mul(n, integers_.power(ones - x.ones));
  }
  static Number normal(Number x) { return Integers::sign(x.n) == 0 ? Number{} : x; }

  int one_;
  Integers integers_;
};

// 32-bit floats, a Field of real_rules.h. Compiled without contraction.

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
