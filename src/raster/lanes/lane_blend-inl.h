// Blending for a vector of fragments.
#if defined(NINEBIT_RASTER_LANES_LANE_BLEND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_BLEND_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_BLEND_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_BLEND_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_operations.h"
#include "src/raster/rules/fragment_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// The value domain of blending: two numbers of 16 bits in each word. D is a tag of the words.
template <class D>
struct PairValues {
  using D16 = hn::Repartition<std::uint16_t, D>;
  using V = hn::Vec<D16>;

  static HWY_INLINE V set(int v) { return hn::Set(D16(), static_cast<std::uint16_t>(v)); }
  static HWY_INLINE V add(V a, V b) { return hn::Add(a, b); }
  static HWY_INLINE V sub(V a, V b) { return hn::Sub(a, b); }
  static HWY_INLINE V mul(V a, V b) { return hn::Mul(a, b); }
  static HWY_INLINE V min_of(V a, V b) { return hn::Min(a, b); }
  static HWY_INLINE V max_of(V a, V b) { return hn::Max(a, b); }
  static HWY_INLINE V shift_left(V v, int bits) { return hn::ShiftLeftSame(v, bits); }
  static HWY_INLINE V shift_right(V v, int bits) { return hn::ShiftRightSame(v, bits); }
  static HWY_INLINE V bits_and(V a, V b) { return hn::And(a, b); }
  static HWY_INLINE V saturated_sum(V a, V b) { return hn::SaturatedAdd(a, b); }
  static HWY_INLINE V saturated_difference(V a, V b) { return hn::SaturatedSub(a, b); }
};

// The colours that replace `stored`, words like those of TilePlanes.
template <class D>
HWY_INLINE hn::Vec<D> blended_colors(D d, const LaneBlend& blend, hn::Vec<D> colors, hn::Vec<D> stored) {
  using Values = PairValues<D>;
  constexpr typename Values::D16 d16;
  constexpr hn::RebindToUnsigned<D> words;
  const Values o;
  const auto word = [&](std::uint32_t v) HWY_ATTR { return hn::Set(words, v); };
  const auto source = hn::And(hn::BitCast(words, colors), word(blend.source_kept));
  const auto destination = hn::Or(hn::And(hn::BitCast(words, stored), word(blend.stored_kept)), word(blend.stored_set));
  const auto constant = word(blend.constant);
  // Red and blue, or green and alpha.
  const auto low = [&](auto v) HWY_ATTR { return hn::And(hn::BitCast(d16, v), hn::Set(d16, 0xFF)); };
  const auto high = [&](auto v) HWY_ATTR { return hn::ShiftRight<8>(hn::BitCast(d16, v)); };
  const auto alpha = [&](auto v) HWY_ATTR {
    const auto byte = hn::ShiftRight<24>(v);
    return hn::BitCast(d16, hn::Or(byte, hn::ShiftLeft<16>(byte)));
  };
  BlendComponent<Values> c{low(source),   low(destination), alpha(source), alpha(destination),
                           low(constant), alpha(constant),  o.set(0)};
  const auto red_blue = blended(o, blend.state, c);
  c.source = high(source);
  c.destination = high(destination);
  c.constant = high(constant);
  c.alpha_bits = hn::BitCast(d16, word(0x00FF0000));
  const auto green_alpha = blended(o, blend.state, c);
  return hn::BitCast(d, hn::Or(red_blue, hn::ShiftLeft<8>(green_alpha)));
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
