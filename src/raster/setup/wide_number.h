// Whole numbers from 0 to 2^768 - 1, for comparisons that must be exact and are rare.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace ninebit {

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
