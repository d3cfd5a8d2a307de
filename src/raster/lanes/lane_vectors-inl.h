// The vectors in which a tile's fragments are drawn, of at most 16 lanes, and what Highway does not have for them.
#if defined(NINEBIT_RASTER_LANES_LANE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_VECTORS_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_VECTORS_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_VECTORS_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/system/emscripten/wasm_doubles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// Words of the tile, real numbers for as many lanes, and half as many 64-bit numbers.
using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using DF = hn::Rebind<float, D>;
using VF = hn::Vec<DF>;
using D64 = hn::Repartition<std::int64_t, D>;
using V64 = hn::Vec<D64>;
using DD = hn::Repartition<double, D>;
constexpr D kD;
constexpr DF kDF;
constexpr D64 kD64;
constexpr DD kDD;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kD));
constexpr std::size_t kLaneCount = hn::MaxLanes(kD);  // the same, as a number of array elements

HWY_INLINE std::int32_t* lanes_of(std::uint32_t* words) {
  return reinterpret_cast<std::int32_t*>(words);  // signed and unsigned words may alias
}
HWY_INLINE const std::int32_t* lanes_of(const std::uint32_t* words) {
  return reinterpret_cast<const std::int32_t*>(words);
}

// 0, 1, 2, … (Highway's Iota assembles it word by word, in memory, each time.)
template <class D>
HWY_INLINE hn::Vec<D> lane_numbers(D d) {
  alignas(64) static constexpr std::array<std::int32_t, 16> kNumbers{0, 1, 2,  3,  4,  5,  6,  7,
                                                                     8, 9, 10, 11, 12, 13, 14, 15};
  return hn::Load(d, kNumbers.data());
}

HWY_INLINE hn::Vec<DD> real_lane_numbers() {
  alignas(64) static constexpr std::array<double, 8> kNumbers{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  return hn::Load(kDD, kNumbers.data());
}

// 0, step, 2 step, …, in half as many lanes as words have.
HWY_INLINE V64 lane_numbers_times(std::int64_t step) {
  const V64 once = hn::Set(kD64, step);
#if HWY_TARGET <= HWY_AVX3
  alignas(64) static constexpr std::array<std::int64_t, 8> kNumbers{0, 1, 2, 3, 4, 5, 6, 7};
  return hn::Mul(hn::Load(kD64, kNumbers.data()), once);
#else  // no instruction multiplies them
  alignas(32) static constexpr std::array<std::int64_t, 4> kOdd{0, -1, 0, -1}, kSecondPair{0, 0, -1, -1};
  const V64 in_pair = hn::And(hn::Load(kD64, kOdd.data()), once);
  if constexpr (hn::MaxLanes(kD64) == 2) return in_pair;
  return hn::Add(in_pair, hn::And(hn::Load(kD64, kSecondPair.data()), hn::ShiftLeft<1>(once)));
#endif
}

// A bit for each lane, the first lane in the lowest bit.
template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
#if HWY_TARGET <= HWY_AVX3
  return static_cast<std::uint64_t>(mask.raw) & ((std::uint64_t{1} << hn::Lanes(d)) - 1);
#else
  // One byte at a time: a wider load would wait until the stored bytes are in the cache.
  std::array<std::uint8_t, 8> bytes;
  hn::StoreMaskBits(d, mask, bytes.data());
  return hn::MaxLanes(d) > 8 ? bytes[0] | static_cast<std::uint64_t>(bytes[1]) << 8 : bytes[0];
#endif
}

// Stores only the lanes of the mask. The other words of the vector are read and may be written with what they hold.
template <class D>
HWY_INLINE void store_where(hn::Mask<D> mask, hn::Vec<D> v, D d, hn::TFromD<D>* at) {
#if HWY_TARGET <= HWY_AVX3
  hn::BlendedStore(v, mask, d, at);
#else
  // AVX2's masked store takes AMD's processors as many cycles as a dozen others.
  hn::StoreU(hn::IfThenElse(mask, v, hn::LoadU(d, at)), d, at);
#endif
}

template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, std::uint32_t word) {
  return hn::MaskFromVec(hn::Set(d, static_cast<std::int32_t>(word)));
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
