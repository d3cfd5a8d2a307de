// Words of several records in memory, a record a lane.
#if defined(NINEBIT_RASTER_LANES_LANE_RECORDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_RECORDS_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_RECORDS_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_RECORDS_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
inline constexpr bool kGathersRecords = true;
#else
// AVX2's gathers take AMD's processors forty operations each, and the other targets have none: four words of each
// record are loaded and transposed.
inline constexpr bool kGathersRecords = false;

// The four words at `at(lane)`, an address, of each lane: `word[i]` has all lanes' i-th one.
template <class D, class At>
HWY_INLINE void load_four_words(D d, const At& at, hn::Vec<D> (&word)[4]) {
  const hn::RepartitionToWide<D> pairs;
  hn::Vec<D> of[4];
  for (std::size_t i = 0; i < 4; ++i) {
    if constexpr (hn::MaxLanes(D()) == 8) {
      const hn::Half<D> half;
      of[i] = hn::Combine(d, hn::LoadU(half, at(i + 4)), hn::LoadU(half, at(i)));
    } else {
      static_assert(hn::MaxLanes(D()) == 4);
      of[i] = hn::LoadU(d, at(i));
    }
  }
  // Interleaving stays within blocks of four words.
  const auto pair = [pairs](hn::Vec<D> v) HWY_ATTR { return hn::BitCast(pairs, v); };
  const auto low = pair(hn::InterleaveLower(d, of[0], of[1])), next_low = pair(hn::InterleaveLower(d, of[2], of[3]));
  const auto high = pair(hn::InterleaveUpper(d, of[0], of[1])), next_high = pair(hn::InterleaveUpper(d, of[2], of[3]));
  word[0] = hn::BitCast(d, hn::InterleaveLower(pairs, low, next_low));
  word[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, low, next_low));
  word[2] = hn::BitCast(d, hn::InterleaveLower(pairs, high, next_high));
  word[3] = hn::BitCast(d, hn::InterleaveUpper(pairs, high, next_high));
}
#endif

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
