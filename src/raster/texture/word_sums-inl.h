// Weighs four texels of a level, and two levels, in vectors of words.
#if defined(NINEBIT_RASTER_TEXTURE_WORD_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_TEXTURE_WORD_SUMS_INL_H_
#undef NINEBIT_RASTER_TEXTURE_WORD_SUMS_INL_H_
#else
#define NINEBIT_RASTER_TEXTURE_WORD_SUMS_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/texture/texture_axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DU = hn::RebindToUnsigned<DI>;
using VU = hn::Vec<DU>;
constexpr DU kDU;

// Four texels of each fragment, and the weights between them.
struct WordTaps {
  VU low_left, low_right, high_left, high_right;
  VU u, v;
};

// a + (b - a) × weight / 2^bits, times 2^bits. Numbers side by side in a word stay apart if none exceeds its bits.
HWY_INLINE VU between(VU a, VU b, VU weight, int bits) {
  return hn::Add(hn::ShiftLeftSame(a, bits), hn::Mul(hn::Sub(b, a), weight));
}

// The same of two numbers side by side in each word, of at most 8 bits with weights of at most 8 bits: `weights` has
// each weight twice. Multiplications of 16 bits are faster than those of 32.
HWY_INLINE VU between_pairs(VU a, VU b, VU weights, int bits) {
#if HWY_TARGET == HWY_SCALAR  // its words have no halves
  return between(a, b, hn::And(weights, hn::Set(kDU, 0xFFFF)), bits);
#else
  constexpr hn::Repartition<std::uint16_t, DU> d16;
  const auto first = hn::BitCast(d16, a);
  const auto product = hn::Mul(hn::Sub(hn::BitCast(d16, b), first), hn::BitCast(d16, weights));
  return hn::BitCast(kDU, hn::Add(hn::ShiftLeftSame(first, bits), product));
#endif
}
HWY_INLINE VU twice(VU weight) {
  return hn::Or(weight, hn::ShiftLeft<16>(weight));
}

// Filters that round once: the sums of the weighted texels, by component, times 2^(2 bits).
struct SumOnce {
  VU red, green, blue, alpha;

  HWY_INLINE SumOnce(const WordTaps& taps, int bits) {
    const VU bytes = hn::Set(kDU, 0x00FF00FF), half = hn::Set(kDU, 0xFFFF);
    const auto even = [&](VU word) HWY_ATTR { return hn::And(word, bytes); };
    const auto odd = [&](VU word) HWY_ATTR { return hn::And(hn::ShiftRight<8>(word), bytes); };
    const VU u = twice(taps.u);
    const VU low_even = between_pairs(even(taps.low_left), even(taps.low_right), u, bits);
    const VU low_odd = between_pairs(odd(taps.low_left), odd(taps.low_right), u, bits);
    const VU high_even = between_pairs(even(taps.high_left), even(taps.high_right), u, bits);
    const VU high_odd = between_pairs(odd(taps.high_left), odd(taps.high_right), u, bits);
    red = between(hn::And(low_even, half), hn::And(high_even, half), taps.v, bits);
    green = between(hn::And(low_odd, half), hn::And(high_odd, half), taps.v, bits);
    blue = between(hn::ShiftRight<16>(low_even), hn::ShiftRight<16>(high_even), taps.v, bits);
    alpha = between(hn::ShiftRight<16>(low_odd), hn::ShiftRight<16>(high_odd), taps.v, bits);
  }

  HWY_INLINE void blend(const SumOnce& more, VU weight, int bits) {
    red = between(red, more.red, weight, bits);
    green = between(green, more.green, weight, bits);
    blue = between(blue, more.blue, weight, bits);
    alpha = between(alpha, more.alpha, weight, bits);
  }

  // The rounded words, of one level or of two.
  [[nodiscard]] HWY_INLINE VU words(int bits, bool two_levels) const {
    const int shift = two_levels ? 3 * bits : 2 * bits;
    const VU half = hn::Set(kDU, std::uint32_t{1} << (shift - 1));
    const auto byte = [&](VU sum) HWY_ATTR { return hn::ShiftRightSame(hn::Add(sum, half), shift); };
    const VU low = hn::Or(byte(red), hn::ShiftLeft<8>(byte(green)));
    const VU high = hn::Or(byte(blue), hn::ShiftLeft<8>(byte(alpha)));
    return hn::Or(low, hn::ShiftLeft<16>(high));
  }
};

// Filters that round each blend: bytes, two in a word.
struct SumEach {
  VU even, odd;

  HWY_INLINE SumEach(const WordTaps& taps, int bits) {
    const VU bytes = hn::Set(kDU, 0x00FF00FF);
    const auto evens = [&](VU word) HWY_ATTR { return hn::And(word, bytes); };
    const auto odds = [&](VU word) HWY_ATTR { return hn::And(hn::ShiftRight<8>(word), bytes); };
    const VU u = twice(taps.u), v = twice(taps.v);
    even = rounded(rounded(evens(taps.low_left), evens(taps.low_right), u, bits),
                   rounded(evens(taps.high_left), evens(taps.high_right), u, bits), v, bits);
    odd = rounded(rounded(odds(taps.low_left), odds(taps.low_right), u, bits),
                  rounded(odds(taps.high_left), odds(taps.high_right), u, bits), v, bits);
  }

  HWY_INLINE void blend(const SumEach& more, VU weight, int bits) {
    even = rounded(even, more.even, twice(weight), bits);
    odd = rounded(odd, more.odd, twice(weight), bits);
  }

  [[nodiscard]] HWY_INLINE VU words(int, bool) const { return hn::Or(even, hn::ShiftLeft<8>(odd)); }

 private:
  static HWY_INLINE VU rounded(VU a, VU b, VU weights, int bits) {
    const VU half = hn::Set(kDU, 0x00010001U << (bits - 1));
    const VU sum = hn::Add(between_pairs(a, b, weights, bits), half);
    return hn::And(hn::ShiftRightSame(sum, bits), hn::Set(kDU, 0x00FF00FF));
  }
};

#if HWY_TARGET != HWY_SCALAR
// The same with weights of 8 bits: rounded blends of signed numbers of 16 bits.
struct SumEachByte {
  using D16 = hn::Repartition<std::int16_t, DU>;
  using V16 = hn::Vec<D16>;
  V16 even, odd;

  HWY_INLINE SumEachByte(const WordTaps& taps, int) {
    const VU bytes = hn::Set(kDU, 0x00FF00FF);
    const auto evens = [&](VU word) HWY_ATTR { return hn::BitCast(D16(), hn::And(word, bytes)); };
    const auto odds = [](VU word) HWY_ATTR {
      constexpr hn::RebindToUnsigned<D16> du16;
      return hn::BitCast(D16(), hn::ShiftRight<8>(hn::BitCast(du16, word)));
    };
    const V16 u = share(taps.u), v = share(taps.v);
    even = rounded(rounded(evens(taps.low_left), evens(taps.low_right), u),
                   rounded(evens(taps.high_left), evens(taps.high_right), u), v);
    odd = rounded(rounded(odds(taps.low_left), odds(taps.low_right), u),
                  rounded(odds(taps.high_left), odds(taps.high_right), u), v);
  }

  HWY_INLINE void blend(const SumEachByte& more, VU weight, int) {
    const V16 w = share(weight);
    even = rounded(even, more.even, w);
    odd = rounded(odd, more.odd, w);
  }

  [[nodiscard]] HWY_INLINE VU words(int, bool) const { return hn::BitCast(kDU, hn::Or(even, hn::ShiftLeft<8>(odd))); }

 private:
  // A weight in 1/256 as one in 1/2^15, in both halves of its word.
  static HWY_INLINE V16 share(VU weight) { return hn::BitCast(D16(), twice(hn::ShiftLeft<7>(weight))); }
  // a + (b - a) × weight, to nearest, halves up.
  static HWY_INLINE V16 rounded(V16 a, V16 b, V16 weight) {
    return hn::Add(a, hn::MulFixedPoint15(hn::Sub(b, a), weight));
  }
};
#endif

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
