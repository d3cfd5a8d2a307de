// The layouts of a vector's lanes in a tile.
#if defined(NINEBIT_RASTER_LANES_LANE_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_ROWS_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_ROWS_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_ROWS_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/surface/tile_size.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// All lanes side by side in one row.
struct OneRow {
  static constexpr std::size_t kRows = 1;
  static constexpr int kColumns = kLanes;
  static constexpr int column(int lane) { return lane; }
  static constexpr int row(int) { return 0; }

  // `at` is the first lane's place, here and below.
  template <class D>
  static HWY_INLINE hn::Vec<D> load(D d, const std::int32_t* at) {
    return hn::LoadU(d, at);
  }
  template <class D>
  static HWY_INLINE void store(hn::Vec<D> v, D d, std::int32_t* at) {
    hn::StoreU(v, d, at);
  }
  // Stores only the lanes of the mask.
  template <class D>
  static HWY_INLINE void blend(hn::Vec<D> v, hn::Mask<D> mask, D d, std::int32_t* at) {
    store_where(mask, v, d, at);
  }
  // Stores only the lanes of the mask, of a vector whose lanes are all equal.
  template <class D>
  static HWY_INLINE void put(hn::Vec<D> v, hn::Mask<D> mask, D d, std::int32_t* at) {
    blend(v, mask, d, at);
  }
  // The lanes' places, relative to the first lane's.
  template <class D>
  static HWY_INLINE hn::Vec<D> places(D d) {
    return lane_numbers(d);
  }
  static HWY_INLINE V columns() { return lane_numbers(kD); }
  static HWY_INLINE V rows(D) { return hn::Zero(kD); }
  // column × step_x + row × step_y, for the lower half of the lanes, and what the upper half has more.
  static HWY_INLINE V64 in_lower_half(std::int64_t step_x, V64) { return lane_numbers_times(step_x); }
  static HWY_INLINE V64 to_upper_half(std::int64_t step_x, V64) { return hn::Set(kD64, step_x * (kLanes / 2)); }
};

// The lanes in two rows or four, one above the other: a half or a quarter of them in each.
template <int kCount>
struct SeveralRows {
  static_assert(kCount == 2 || kCount == 4);
  static constexpr std::size_t kRows = kCount;
  static constexpr int kColumns = std::max(kLanes / kCount, 1);
  static constexpr int column(int lane) { return lane % kColumns; }
  static constexpr int row(int lane) { return lane / kColumns; }

  static HWY_INLINE V load(D d, const std::int32_t* at) {
    const hn::Half<D> half;
    if constexpr (kCount == 2) {
      return hn::Combine(d, hn::LoadU(half, at + kTileSize), hn::LoadU(half, at));
    } else {
      const hn::Half<decltype(half)> part;
      const auto two = [&](const std::int32_t* first) HWY_ATTR {
        return hn::Combine(half, hn::LoadU(part, first + kTileSize), hn::LoadU(part, first));
      };
      return hn::Combine(d, two(at + 2 * kTileSize), two(at));
    }
  }
  static HWY_INLINE void store(V v, D, std::int32_t* at) {
    const hn::Half<D> half;
    const auto low = hn::LowerHalf(half, v), high = hn::UpperHalf(half, v);
    if constexpr (kCount == 2) {
      hn::StoreU(low, half, at);
      hn::StoreU(high, half, at + kTileSize);
    } else {
      const hn::Half<decltype(half)> part;
      hn::StoreU(hn::LowerHalf(part, low), part, at);
      hn::StoreU(hn::UpperHalf(part, low), part, at + kTileSize);
      hn::StoreU(hn::LowerHalf(part, high), part, at + 2 * kTileSize);
      hn::StoreU(hn::UpperHalf(part, high), part, at + 3 * kTileSize);
    }
  }
  static HWY_INLINE void blend(V v, M mask, D d, std::int32_t* at) {
    store(hn::IfThenElse(mask, v, load(d, at)), d, at);
  }
  // Reads nothing where masks store single words.
  static HWY_INLINE void put(V v, M mask, D d, std::int32_t* at) {
    if constexpr (kLanes < 16) return blend(v, mask, d, at);
    const hn::CappedTag<std::int32_t, static_cast<std::size_t>(kColumns)> part;
    const auto value = hn::Set(part, hn::GetLane(v));
    std::uint64_t bits = bits_of(d, mask);
    for (std::size_t r = 0; r < kRows; ++r, bits >>= kColumns) {
      const auto lanes = static_cast<std::uint8_t>(bits & ((1U << kColumns) - 1));
      hn::BlendedStore(value, hn::LoadMaskBits(part, &lanes), part, at + r * kTileSize);
    }
  }
  static HWY_INLINE V64 in_lower_half(std::int64_t step_x, V64 step_y) {
    if constexpr (kCount == 2) return lane_numbers_times(step_x);
    alignas(64) static constexpr std::array<std::int64_t, 8> kColumn{0, 1, 2, 3, 0, 1, 2, 3};
    alignas(64) static constexpr std::array<std::int64_t, 8> kSecondRow{0, 0, 0, 0, -1, -1, -1, -1};
    static_assert(kCount == 2 || kLanes == 16);
    const V64 along = hn::Mul(hn::Load(kD64, kColumn.data()), hn::Set(kD64, step_x));
    return hn::Add(along, hn::And(hn::Load(kD64, kSecondRow.data()), step_y));
  }
  static HWY_INLINE V64 to_upper_half(std::int64_t, V64 step_y) { return hn::ShiftLeft<kCount / 4>(step_y); }
  static HWY_INLINE V columns() { return hn::And(lane_numbers(kD), hn::Set(kD, kColumns - 1)); }
  static HWY_INLINE V rows(D d) { return hn::ShiftRightSame(lane_numbers(d), __builtin_ctz(kColumns)); }
  static HWY_INLINE V places(D d) { return hn::Add(columns(), hn::Mul(rows(d), hn::Set(d, kTileSize))); }
};

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
