#include "src/combiner/big_integer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace ninebit {
namespace {

__extension__ typedef unsigned __int128 Wide;

constexpr int kLimbBits = 64;

}  // namespace

BigInteger::BigInteger(std::int64_t value) : negative_(value < 0) {
  const auto bits = static_cast<std::uint64_t>(value);
  if (value != 0) limbs_.push_back(negative_ ? 0 - bits : bits);
}

void BigInteger::trim() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  if (limbs_.empty()) negative_ = false;
}

int BigInteger::bit_length() const {
  if (limbs_.empty()) return 0;
  return static_cast<int>(limbs_.size()) * kLimbBits - std::countl_zero(limbs_.back());
}

std::uint64_t BigInteger::leading_bits() const {
  if (limbs_.empty()) return 0;
  const int zeros = std::countl_zero(limbs_.back());
  std::uint64_t bits = limbs_.back() << zeros;
  if (zeros > 0 && limbs_.size() > 1) bits |= limbs_[limbs_.size() - 2] >> (kLimbBits - zeros);
  return bits;
}

BigInteger BigInteger::magnitude() const {
  BigInteger result = *this;
  result.negative_ = false;
  return result;
}

BigInteger BigInteger::shifted_left(int bits) const {
  if (limbs_.empty() || bits == 0) return *this;
  const auto whole = static_cast<std::size_t>(bits / kLimbBits);
  const int rest = bits % kLimbBits;
  BigInteger result;
  result.negative_ = negative_;
  result.limbs_.assign(whole + limbs_.size() + 1, 0);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    result.limbs_[whole + i] |= limbs_[i] << rest;
    if (rest > 0) result.limbs_[whole + i + 1] = limbs_[i] >> (kLimbBits - rest);
  }
  result.trim();
  return result;
}

void BigInteger::double_in_place() {
  std::uint64_t carry = 0;
  for (std::uint64_t& limb : limbs_) carry = std::exchange(limb, limb << 1 | carry) >> (kLimbBits - 1);
  if (carry != 0) limbs_.push_back(carry);
}

void BigInteger::subtract(const BigInteger& smaller) {
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < limbs_.size() && (i < smaller.limbs_.size() || borrow != 0); ++i) {
    const Wide taken = static_cast<Wide>(i < smaller.limbs_.size() ? smaller.limbs_[i] : 0) + borrow;
    borrow = limbs_[i] < taken ? 1 : 0;
    limbs_[i] -= static_cast<std::uint64_t>(taken);
  }
  trim();
}

int BigInteger::compare(const Limbs& x, const Limbs& y) {
  if (x.size() != y.size()) return x.size() < y.size() ? -1 : 1;
  for (std::size_t i = x.size(); i-- > 0;) {
    if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
  }
  return 0;
}

BigInteger BigInteger::sum(const BigInteger& x, const BigInteger& y, bool y_negative) {
  BigInteger result;
  const bool x_larger = compare(x.limbs_, y.limbs_) >= 0;
  const Limbs& large = x_larger ? x.limbs_ : y.limbs_;
  const Limbs& small = x_larger ? y.limbs_ : x.limbs_;
  result.negative_ = x_larger ? x.negative_ : y_negative;
  result.limbs_.resize(large.size() + 1);
  const bool add = x.negative_ == y_negative;
  std::uint64_t carry = 0;  // or borrow
  for (std::size_t i = 0; i < large.size(); ++i) {
    const Wide other = static_cast<Wide>(i < small.size() ? small[i] : 0) + carry;
    const Wide value = add ? static_cast<Wide>(large[i]) + other : static_cast<Wide>(large[i]) - other;
    result.limbs_[i] = static_cast<std::uint64_t>(value);
    carry = static_cast<std::uint64_t>(value >> kLimbBits) & 1;
  }
  result.limbs_.back() = carry;
  result.trim();
  return result;
}

BigInteger operator-(BigInteger x) {
  x.negative_ = !x.negative_ && !x.limbs_.empty();
  return x;
}

BigInteger operator*(const BigInteger& x, const BigInteger& y) {
  BigInteger result;
  result.negative_ = x.negative_ != y.negative_;
  result.limbs_.assign(x.limbs_.size() + y.limbs_.size(), 0);
  for (std::size_t i = 0; i < x.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < y.limbs_.size(); ++j) {
      const Wide value = static_cast<Wide>(x.limbs_[i]) * y.limbs_[j] + result.limbs_[i + j] + carry;
      result.limbs_[i + j] = static_cast<std::uint64_t>(value);
      carry = static_cast<std::uint64_t>(value >> kLimbBits);
    }
    result.limbs_[i + y.limbs_.size()] = carry;
  }
  result.trim();
  return result;
}

bool operator<(const BigInteger& x, const BigInteger& y) {
  if (x.negative_ != y.negative_) return x.negative_;
  return x.negative_ ? BigInteger::compare(y.limbs_, x.limbs_) < 0 : BigInteger::compare(x.limbs_, y.limbs_) < 0;
}

double nearest_double(const BigInteger& n, const BigInteger& d) {
  if (n.sign() == 0) return 0.0;
  // |n / d| = rest / divisor · 2^exponent with 1 <= rest / divisor < 2.
  int exponent = n.bit_length() - d.bit_length();
  BigInteger rest = n.magnitude().shifted_left(std::max(-exponent, 0));
  const BigInteger divisor = d.shifted_left(std::max(exponent, 0));
  if (rest < divisor) {
    rest = rest.shifted_left(1);
    --exponent;
  }
  const int digits = std::min(53, exponent + 1075);  // the last bit of a double is not below 2^-1074
  if (digits < 0) return 0.0;
  std::uint64_t quotient = 0;
  for (int i = 0; i < digits; ++i) {
    quotient <<= 1;
    if (!(rest < divisor)) {
      rest.subtract(divisor);
      quotient |= 1;
    }
    rest.double_in_place();
  }
  // The remainder is rest / (2 divisor) of the last digit.
  if (divisor < rest || (rest == divisor && quotient % 2 == 1)) ++quotient;
  const double result = std::ldexp(static_cast<double>(quotient), exponent - digits + 1);
  return n.sign() < 0 ? -result : result;
}

}  // namespace ninebit
