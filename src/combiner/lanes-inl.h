// Vectors of 16-bit lanes and the arithmetic that Highway does not have. Included once for every SIMD target, by
// batch_kernels.cpp and, in the room study, by sum_kernels.cpp. The combiner is the lowest room that may include
// Highway.
#if defined(NINEBIT_COMBINER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_COMBINER_LANES_INL_H
#undef NINEBIT_COMBINER_LANES_INL_H
#else
#define NINEBIT_COMBINER_LANES_INL_H
#endif

#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::CappedTag<std::int16_t, 32>;
using U16 = hn::RebindToUnsigned<D16>;
#if HWY_TARGET == HWY_SCALAR
using D32 = hn::Rebind<std::int32_t, D16>;
#else
using D32 = hn::RepartitionToWide<D16>;
#endif
using F32 = hn::RebindToFloat<D32>;
constexpr D16 kD16;
constexpr U16 kU16;
constexpr D32 kD32;
constexpr F32 kF32;
using V16 = hn::Vec<D16>;
using VU16 = hn::Vec<U16>;
using V32 = hn::Vec<D32>;
using VF32 = hn::Vec<F32>;

HWY_INLINE V16 set(int v) {
  return hn::Set(kD16, static_cast<std::int16_t>(v));
}
HWY_INLINE VU16 set_unsigned(int v) {
  return hn::Set(kU16, static_cast<std::uint16_t>(v));
}

// Returns a magnitude with the sign of `v`. The magnitude is 0 where v is 0.
HWY_INLINE V16 with_sign(VU16 magnitude, V16 v) {
#if HWY_TARGET <= HWY_AVX3
  return V16{_mm512_mask_sub_epi16(magnitude.raw, _mm512_movepi16_mask(v.raw), _mm512_setzero_si512(), magnitude.raw)};
#elif HWY_TARGET == HWY_AVX2
  return V16{_mm256_sign_epi16(magnitude.raw, v.raw)};
#elif HWY_TARGET == HWY_SSE4
  return V16{_mm_sign_epi16(magnitude.raw, v.raw)};
#else
  const V16 sign = hn::ShiftRight<15>(v);
  return hn::Sub(hn::Xor(hn::BitCast(kD16, magnitude), sign), sign);
#endif
}

// Returns a magnitude with the sign of a · b. The magnitude is 0 where a factor is 0.
HWY_INLINE V16 with_signs(VU16 magnitude, V16 a, V16 b) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4
  return with_sign(hn::BitCast(kU16, with_sign(magnitude, a)),
                   b);  // with_sign of Xor(a, b) would give 0 where a equals b
#else
  return with_sign(magnitude, hn::Xor(a, b));
#endif
}

// One vector of 16-bit lanes as two vectors of 32-bit lanes. narrow_to_16 undoes the order of the lanes.
struct Wide {
  V32 first, second;
};

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Wide widen(V16 v) {
  return {hn::PromoteTo(kD32, v), hn::Zero(kD32)};
}
HWY_INLINE V16 narrow_to_16(V32 first, V32 /*second*/) {
  return hn::DemoteTo(kD16, first);
}
HWY_INLINE Wide multiply(V16 x, V16 y) {
  const Wide a = widen(x), b = widen(y);
  return {hn::Mul(a.first, b.first), hn::Mul(a.second, b.second)};
}
HWY_INLINE Wide multiply(V16 x0, V16 y0, V16 x1, V16 y1) {
  const Wide a = multiply(x0, y0), b = multiply(x1, y1);
  return {hn::Add(a.first, b.first), hn::Add(a.second, b.second)};
}
#else
HWY_INLINE Wide multiply(V16 x, V16 y) {
  const V16 low = hn::Mul(x, y), high = hn::MulHigh(x, y);
  return {hn::BitCast(kD32, hn::InterleaveLower(kD16, low, high)),
          hn::BitCast(kD32, hn::InterleaveUpper(kD16, low, high))};
}
HWY_INLINE V32 sum_of_pairs(V16 x, V16 y) {
  V32 other = hn::Zero(kD32);
  const V32 sum = hn::ReorderWidenMulAccumulate(kD32, x, y, hn::Zero(kD32), other);
  return hn::RearrangeToOddPlusEven(sum, other);
}
HWY_INLINE Wide multiply(V16 x0, V16 y0, V16 x1, V16 y1) {
  return {sum_of_pairs(hn::InterleaveLower(kD16, x0, x1), hn::InterleaveLower(kD16, y0, y1)),
          sum_of_pairs(hn::InterleaveUpper(kD16, x0, x1), hn::InterleaveUpper(kD16, y0, y1))};
}
// Interleaving and packing both work within blocks of 128 bits.
HWY_INLINE V16 narrow_to_16(V32 first, V32 second) {
  return hn::ReorderDemote2To(kD16, first, second);
}
#endif

// Converts floats to integers, toward zero or to nearest. Highway's functions spend two more instructions on values out
// of int32's range, which do not occur here.
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE V32 to_integers(VF32 v, bool nearest) {
  return V32{nearest ? _mm512_cvtps_epi32(v.raw) : _mm512_cvttps_epi32(v.raw)};
}
#elif HWY_TARGET == HWY_AVX2
HWY_INLINE V32 to_integers(VF32 v, bool nearest) {
  return V32{nearest ? _mm256_cvtps_epi32(v.raw) : _mm256_cvttps_epi32(v.raw)};
}
#elif HWY_TARGET == HWY_SSE4
HWY_INLINE V32 to_integers(VF32 v, bool nearest) {
  return V32{nearest ? _mm_cvtps_epi32(v.raw) : _mm_cvttps_epi32(v.raw)};
}
#else
HWY_INLINE V32 to_integers(VF32 v, bool nearest) {
  return nearest ? hn::NearestInt(v) : hn::ConvertTo(kD32, v);
}
#endif

// Returns first · factor and second · factor as integers, toward zero or to nearest. They lie within 2^15 of zero.
template <bool kNearest>
HWY_INLINE V16 integers_of_products(VF32 first, VF32 second, VF32 factor) {
#if HWY_TARGET <= HWY_AVX3
  // The unit of a float near 1.5 · 2^23 is 1, so that the sum ends in the integer nearest to the product.
  if constexpr (kNearest) {
    const VF32 large = hn::Set(kF32, 12582912.0F);
    const auto sum = [&](VF32 v) HWY_ATTR { return _mm512_castps_si512(hn::MulAdd(v, factor, large).raw); };
    // The lower halves of all 32-bit lanes, in the order of narrow_to_16.
    alignas(64) static constexpr std::uint16_t kLower[32] = {0,  2,  4,  6,  32, 34, 36, 38, 8,  10, 12,
                                                             14, 40, 42, 44, 46, 16, 18, 20, 22, 48, 50,
                                                             52, 54, 24, 26, 28, 30, 56, 58, 60, 62};
    return V16{_mm512_permutex2var_epi16(sum(first), _mm512_load_si512(kLower), sum(second))};
  }
#endif
  return narrow_to_16(to_integers(hn::Mul(first, factor), kNearest), to_integers(hn::Mul(second, factor), kNearest));
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
