#include "src/raster/texture/word_filter.h"

#include <algorithm>

#include "src/numerics/simd_targets.h"
#include "src/raster/texture/texture_level.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/texture/word_filter.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/raster/texture/texture_axis-inl.h"
#include "src/raster/texture/word_sums-inl.h"
#include "src/system/emscripten/wasm_doubles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DD = hn::ScalableTag<double>;
using VD = hn::Vec<DD>;
using M = hn::Mask<DI>;
constexpr DD kDD;

// The larger of the squares of the changes in x and y; a sum that is NaN counts as 0. See rho_squared.
HWY_INLINE VD larger_square(VD x, VD y) {
  const VD zero = hn::Zero(kDD);
  const VD larger = hn::IfThenElse(hn::Gt(x, zero), x, zero);
  return hn::IfThenElse(hn::Gt(y, larger), y, larger);
}

// The exponent of numbers above 0.
HWY_INLINE VD exponent_of(VD v) {
  constexpr hn::RebindToUnsigned<DD> du;
  // As the low bits of a number from 2^52 on.
  const auto bits = hn::Or(hn::ShiftRight<52>(hn::BitCast(du, v)), hn::BitCast(du, hn::Set(kDD, 0x1p52)));
  return hn::Sub(hn::BitCast(kDD, bits), hn::Set(kDD, 0x1p52 + 1023.0));
}

// level_of_detail_q8: whole numbers below 2^21.
HWY_INLINE VD detail(VD rho_squared) {
  constexpr hn::RebindToUnsigned<DD> du;
  const auto mantissa = hn::And(hn::BitCast(du, rho_squared), hn::Set(du, (std::uint64_t{1} << 52U) - 1));
  VD power = hn::BitCast(kDD, hn::Or(mantissa, hn::BitCast(du, hn::Set(kDD, 1.0))));
  for (int bit = 0; bit < 7; ++bit) power = hn::Mul(power, power);
  VD result = hn::Add(hn::Mul(exponent_of(rho_squared), hn::Set(kDD, 128.0)), exponent_of(power));
  result = hn::IfThenElse(hn::Gt(rho_squared, hn::Zero(kDD)), result, hn::Set(kDD, kNoTexels));
  const auto infinite = hn::Gt(rho_squared, hn::Set(kDD, 0x1.fffffffffffffp1023));
  return hn::IfThenElse(infinite, hn::Set(kDD, kAllTexels), result);
}

void find_detail(int width, int height, const ChangeLanes& s, const ChangeLanes& t, std::size_t count,
                 LaneIntegers& lambda_q8) {
  constexpr hn::Rebind<float, DD> df;
  constexpr hn::Rebind<std::int32_t, DD> di;
  const VD w = hn::Set(kDD, width), h = hn::Set(kDD, height);
  for (std::size_t i = 0; i < count; i += hn::Lanes(kDD)) {
    const auto square = [&](const float* ds, const float* dt) HWY_ATTR {
      const VD u = hn::Mul(hn::PromoteTo(kDD, hn::LoadU(df, ds + i)), w);
      const VD v = hn::Mul(hn::PromoteTo(kDD, hn::LoadU(df, dt + i)), h);
      return hn::Add(hn::Mul(u, u), hn::Mul(v, v));
    };
    const VD lambda = detail(larger_square(square(s.dx, t.dx), square(s.dy, t.dy)));
    hn::StoreU(hn::DemoteTo(di, lambda), di, lambda_q8.data() + i);
  }
}

void choose_levels(const LevelRules& rules, const LaneIntegers& lambda_q8, std::size_t count, LevelLanes& to) {
  const LevelChoice near = choose_level(rules.min_filter, rules.mag_filter, kNoTexels, rules.last_level);
  const bool two =
      rules.min_filter == MinFilter::nearest_mipmap_linear || rules.min_filter == MinFilter::linear_mipmap_linear;
  const bool mipmaps = uses_mipmaps(rules.min_filter);
  const VI zero = hn::Zero(kDI), last = hn::Set(kDI, rules.last_level);
  const VI switch_point = hn::Set(kDI, magnification_ends_q8(rules.min_filter, rules.mag_filter));
  const VI near_linear = hn::Set(kDI, near.linear ? -1 : 0),
           far_linear = hn::Set(kDI, is_linear(rules.min_filter) ? -1 : 0);
  VI any_next = zero, all_linear = hn::Set(kDI, -1);
  for (std::size_t i = 0; i < count; i += hn::Lanes(kDI)) {
    const VI lambda = hn::LoadU(kDI, lambda_q8.data() + i);
    const M is_far = hn::Gt(lambda, switch_point);
    VI level = zero, next = zero;
    if (two) {
      level = hn::Min(hn::ShiftRight<8>(lambda), last);
      next = hn::ShiftRightSame(hn::And(lambda, hn::Set(kDI, 0xFF)), 8 - rules.filter.weight_bits);
      next = hn::IfThenElseZero(hn::And(is_far, hn::Lt(level, last)), next);
    } else if (mipmaps) {
      // ceil(lambda + 1/2) - 1: halves go to the finer level.
      const VI whole = hn::ShiftRight<8>(hn::Add(hn::Max(lambda, hn::Set(kDI, 128)), hn::Set(kDI, 127)));
      level = hn::Min(whole, last);
    }
    level = hn::IfThenElseZero(is_far, level);
    const VI linear = hn::IfThenElse(is_far, far_linear, near_linear);
    hn::StoreU(level, kDI, to.level.data() + i);
    hn::StoreU(next, kDI, to.next.data() + i);
    hn::StoreU(linear, kDI, to.linear.data() + i);
    any_next = hn::Or(any_next, next);
    all_linear = hn::And(all_linear, linear);
  }
  to.has_next = !hn::AllTrue(kDI, hn::Eq(any_next, zero));
  to.all_linear = hn::AllTrue(kDI, hn::Eq(all_linear, hn::Set(kDI, -1)));
}

// Places on the texture of a vector of fragments.
struct Places {
  VI face;
  VF s, t;
};

HWY_INLINE VU gather_words(const WordLevels& texture, VI offset) {
  return hn::GatherIndex(kDU, reinterpret_cast<const std::uint32_t*>(texture.first), offset);
}

// A level of each fragment.
struct Level {
  Axis across, up;
  VI begin, stride;

  // The same one of all fragments, of a texture with one face.
  HWY_INLINE Level(const WordLevels& texture, int level)
      : across(side(hn::Set(kDI, texture.width >> level)), texture.wrap_s),
        up(side(hn::Set(kDI, texture.height >> level)), texture.wrap_t),
        begin(hn::Set(kDI, texture.begin[static_cast<std::size_t>(level)])),
        stride(hn::Set(kDI, texture.stride[static_cast<std::size_t>(level)])) {}

  HWY_INLINE Level(const WordLevels& texture, VI face, VI level)
      : across(side(hn::Shr(hn::Set(kDI, texture.width), level)), texture.wrap_s),
        up(side(hn::Shr(hn::Set(kDI, texture.height), level)), texture.wrap_t),
        begin(hn::GatherIndex(kDI, texture.begin.data(), hn::Add(hn::ShiftLeft<4>(face), level))),
        stride(hn::GatherIndex(kDI, texture.stride.data(), level)) {
    static_assert(WordLevels::kRoom == 1 << 4);
  }

  // Level 0 of other faces, whose sides and rows are alike; `step` is face_step().
  [[nodiscard]] HWY_INLINE Level of_faces(const WordLevels& texture, VI face, std::int32_t step) const {
    Level other = *this;
    other.begin = step > 0 ? hn::Add(begin, hn::Mul(face, hn::Set(kDI, step)))
                           : hn::GatherIndex(kDI, texture.begin.data(), hn::ShiftLeft<4>(face));
    return other;
  }

 private:
  static HWY_INLINE VI side(VI texels) { return hn::Max(texels, hn::Set(kDI, 1)); }
};

// The taps of one level. Where `linear` is 0, all are the nearest texel. `kOnFace`: places are on faces of a cube map.
template <bool kAllLinear, bool kOnFace = false, class Rules>
HWY_INLINE WordTaps read_taps(const WordLevels& texture, const Rules& rules, const Places& at, const Level& level,
                              VI linear) {
  VI right, above, u, v;
  VI left = texels_along<kOnFace>(level.across, at.s, rules, right, u);
  VI low = texels_along<kOnFace>(level.up, at.t, rules, above, v);
  if (!kAllLinear) {
    const M blends = hn::Ne(linear, hn::Zero(kDI));
    const auto choose = [&](VI& near, VI& second, VI& weight, VI nearest) HWY_ATTR {
      near = hn::IfThenElse(blends, near, nearest);
      second = hn::IfThenElse(blends, second, nearest);
      weight = hn::IfThenElseZero(blends, weight);
    };
    choose(left, right, u, texel_along(level.across, at.s));
    choose(low, above, v, texel_along(level.up, at.t));
  }
  const VI low_row = hn::Add(level.begin, hn::Mul(low, level.stride));
  const VI high_row = hn::Add(level.begin, hn::Mul(above, level.stride));
  WordTaps taps{gather_words(texture, hn::Add(low_row, left)),
                gather_words(texture, hn::Add(low_row, right)),
                gather_words(texture, hn::Add(high_row, left)),
                gather_words(texture, hn::Add(high_row, right)),
                hn::BitCast(kDU, u),
                hn::BitCast(kDU, v)};
  if (HWY_UNLIKELY(texture.flip != 0)) {
    for (VU* const word : {&taps.low_left, &taps.low_right, &taps.high_left, &taps.high_right}) {
      *word = hn::Xor(*word, hn::Set(kDU, texture.flip));
    }
  }
  return taps;
}

// The words of fragments from i on, whose levels are `levels`.
template <class Sum, bool kAllLinear, class Rules>
HWY_INLINE VU filter_vector(const WordLevels& texture, const Rules& rules, const Places& places,
                            const LevelLanes& levels, std::size_t i) {
  const int bits = rules.weight_bits;
  const VI level = hn::LoadU(kDI, levels.level.data() + i);
  const VI linear = kAllLinear ? level : hn::LoadU(kDI, levels.linear.data() + i);
  const std::int32_t first = levels.level[i];
  const bool is_one = !texture.cube && hn::AllTrue(kDI, hn::Eq(level, hn::Set(kDI, first)));
  const auto sum_of = [&](const Level& of)
                          HWY_ATTR { return Sum(read_taps<kAllLinear>(texture, rules, places, of, linear), bits); };
  Sum sum = is_one ? sum_of(Level(texture, first)) : sum_of(Level(texture, places.face, level));
  if (levels.has_next) {
    const VI last = hn::Set(kDI, texture.count - 1), coarser = hn::Min(hn::Add(level, hn::Set(kDI, 1)), last);
    const Sum more = is_one ? sum_of(Level(texture, std::min(first + 1, texture.count - 1)))
                            : sum_of(Level(texture, places.face, coarser));
    sum.blend(more, hn::BitCast(kDU, hn::LoadU(kDI, levels.next.data() + i)), bits);
  }
  return hn::Xor(sum.words(bits, levels.has_next), hn::Set(kDU, texture.flip));
}

template <class Sum, bool kAllLinear, class Rules>
HWY_INLINE void filter_levels(const WordLevels& texture, const Rules& rules, const std::array<const float*, 3>& at,
                              const LevelLanes& levels, std::size_t count, LaneWords& to) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(kDF)) {
    Places places;
    places.face = load_place(texture.cube, at, i, places.s, places.t);
    hn::StoreU(filter_vector<Sum, kAllLinear>(texture, rules, places, levels, i), kDU, to.data() + i);
  }
}

// Words from level 0 of one face to that of the next, if it is the same for all faces of a cube map; else 0.
HWY_INLINE std::int32_t face_step(const WordLevels& texture) {
  const std::int32_t step = texture.begin[WordLevels::kRoom] - texture.begin[0];
  bool is_same = texture.cube && step > 0;
  for (std::size_t face = 2; face < 6 && is_same; ++face) {
    const std::size_t at = face * WordLevels::kRoom;
    is_same = texture.begin[at] - texture.begin[at - WordLevels::kRoom] == step;
  }
  return is_same ? step : 0;
}

// Fragments that all read the same levels: those of the first, or level 0 linearly without `levels`.
template <class Sum, bool kAllLinear, class Rules>
HWY_INLINE void filter_same(const WordLevels& texture, const Rules& rules, const std::array<const float*, 3>& at,
                            const LevelLanes* levels, std::size_t count, LaneWords& to) {
  const int bits = rules.weight_bits;
  const int level = levels == nullptr ? 0 : levels->level[0];
  const bool has_next = levels != nullptr && levels->has_next;
  const VI linear = hn::Zero(kDI);  // read where not kAllLinear
  const VU next = hn::Set(kDU, has_next ? static_cast<std::uint32_t>(levels->next[0]) : 0);
  const Level fine(texture, level), coarse(texture, std::min(level + 1, texture.count - 1));
  const std::int32_t step = face_step(texture);
  for (std::size_t i = 0; i < count; i += hn::Lanes(kDF)) {
    Places places;
    places.face = load_place(texture.cube, at, i, places.s, places.t);
    // Written out twice: the compiler does not inline a lambda here.
    Sum sum(texture.cube
                ? read_taps<kAllLinear, true>(texture, rules, places, fine.of_faces(texture, places.face, step), linear)
                : read_taps<kAllLinear>(texture, rules, places, fine, linear),
            bits);
    if (has_next) sum.blend(Sum(read_taps<kAllLinear>(texture, rules, places, coarse, linear), bits), next, bits);
    hn::StoreU(hn::Xor(sum.words(bits, has_next), hn::Set(kDU, texture.flip)), kDU, to.data() + i);
  }
}

template <class Sum, bool kAllLinear, class Rules>
HWY_INLINE void filter_all(const WordLevels& texture, const Rules& rules, const std::array<const float*, 3>& at,
                           const LevelLanes* levels, std::size_t count, LaneWords& to) {
  if (levels == nullptr || levels->are_same) {
    filter_same<Sum, kAllLinear>(texture, rules, at, levels, count, to);
  } else {
    filter_levels<Sum, kAllLinear>(texture, rules, at, *levels, count, to);
  }
}

template <class Sum, class Rules>
HWY_INLINE void filter_by(const WordLevels& texture, const Rules& rules, const std::array<const float*, 3>& at,
                          const LevelLanes* levels, std::size_t count, LaneWords& to) {
  if (levels == nullptr || levels->all_linear) {
    filter_all<Sum, true>(texture, rules, at, levels, count, to);
  } else {
    filter_all<Sum, false>(texture, rules, at, levels, count, to);
  }
}

// The same of a texture that filters_border.
HWY_INLINE WordTaps read_bordered_taps(const WordLevels& texture, const FilterRules& rules, const Places& at,
                                       const Level& level, VI linear) {
  const M blends = hn::Ne(linear, hn::Zero(kDI));
  const bool all_blend = hn::AllTrue(kDI, blends);
  const auto texels_of = [&](const Axis& axis, VF s) HWY_ATTR {
    BorderedTexels texels = bordered_texels_along(axis, s, rules, texture.border_texels);
    if (all_blend) return texels;
    const VI nearest = texture.border_texels ? stored_texel_along(axis, s) : texel_along(axis, s);
    const VI outside = texture.border_texels ? hn::Zero(kDI) : reads_border(axis, s);
    texels.weight = hn::IfThenElseZero(blends, texels.weight);
    for (VI* const texel : {&texels.first, &texels.second}) *texel = hn::IfThenElse(blends, *texel, nearest);
    for (VI* const is : {&texels.outside_first, &texels.outside_second}) *is = hn::IfThenElse(blends, *is, outside);
    return texels;
  };
  const BorderedTexels x = texels_of(level.across, at.s), y = texels_of(level.up, at.t);
  const VU border = hn::Set(kDU, texture.border), flip = hn::Set(kDU, texture.flip);
  const auto word = [&](VI column, VI row, VI beside, VI above) HWY_ATTR {
    const VI place = hn::Add(hn::Add(level.begin, hn::Mul(row, level.stride)), column);
    const M is_outside = hn::Ne(hn::Or(beside, above), hn::Zero(kDI));
    return hn::Xor(hn::IfThenElse(hn::RebindMask(kDU, is_outside), border, gather_words(texture, place)), flip);
  };
  return {word(x.first, y.first, x.outside_first, y.outside_first),
          word(x.second, y.first, x.outside_second, y.outside_first),
          word(x.first, y.second, x.outside_first, y.outside_second),
          word(x.second, y.second, x.outside_second, y.outside_second),
          hn::BitCast(kDU, x.weight),
          hn::BitCast(kDU, y.weight)};
}

template <class Sum>
HWY_NOINLINE void filter_bordered(const WordLevels& texture, const FilterRules& rules,
                                  const std::array<const float*, 3>& at, const LevelLanes* levels, std::size_t count,
                                  LaneWords& to) {
  const int bits = rules.weight_bits;
  const bool has_next = levels != nullptr && levels->has_next, is_one = levels == nullptr && !texture.cube;
  const VI coarsest = hn::Set(kDI, texture.count - 1);
  VI level = hn::Zero(kDI), linear = hn::Set(kDI, -1);
  Level fine(texture, 0);
  for (std::size_t i = 0; i < count; i += hn::Lanes(kDF)) {
    Places places;
    places.face = load_place(texture.cube, at, i, places.s, places.t);
    const std::size_t chosen = levels != nullptr && levels->are_same ? 0 : i;
    if (levels != nullptr) {
      level = hn::LoadU(kDI, levels->level.data() + chosen);
      linear = hn::LoadU(kDI, levels->linear.data() + chosen);
    }
    if (!is_one) fine = Level(texture, places.face, level);
    Sum sum(read_bordered_taps(texture, rules, places, fine, linear), bits);
    if (has_next) {
      const Level coarse(texture, places.face, hn::Min(hn::Add(level, hn::Set(kDI, 1)), coarsest));
      sum.blend(Sum(read_bordered_taps(texture, rules, places, coarse, linear), bits),
                hn::BitCast(kDU, hn::LoadU(kDI, levels->next.data() + chosen)), bits);
    }
    hn::StoreU(hn::Xor(sum.words(bits, has_next), hn::Set(kDU, texture.flip)), kDU, to.data() + i);
  }
}

void filter_words(const WordLevels& texture, const FilterRules& rules, const std::array<const float*, 3>& at,
                  const LevelLanes* levels, std::size_t count, LaneWords& to) {
  if (HWY_UNLIKELY(filters_border(texture))) {
    return rules.rounds_each_blend ? filter_bordered<SumEach>(texture, rules, at, levels, count, to)
                                   : filter_bordered<SumOnce>(texture, rules, at, levels, count, to);
  }
#if HWY_TARGET != HWY_SCALAR
  if (rules.rounds_each_blend && rules.cuts_weights && rules.weight_bits == CutBytes::weight_bits) {
    return filter_by<SumEachByte>(texture, CutBytes{}, at, levels, count, to);
  }
#endif
  if (rules.rounds_each_blend) {  // rule 26
    filter_by<SumEach>(texture, rules, at, levels, count, to);
  } else {
    filter_by<SumOnce>(texture, rules, at, levels, count, to);
  }
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(find_detail);
HWY_EXPORT(choose_levels);
HWY_EXPORT(filter_words);

void find_detail(int width, int height, const ChangeLanes& s, const ChangeLanes& t, std::size_t count,
                 LaneIntegers& lambda_q8) {
  HWY_DYNAMIC_DISPATCH(find_detail)(width, height, s, t, count, lambda_q8);
}

void choose_levels(const LevelRules& rules, const LaneIntegers& lambda_q8, std::size_t count, LevelLanes& to) {
  HWY_DYNAMIC_DISPATCH(choose_levels)(rules, lambda_q8, count, to);
}

void filter_words(const WordLevels& texture, const FilterRules& rules, const std::array<const float*, 3>& at,
                  const LevelLanes* levels, std::size_t count, LaneWords& to) {
  HWY_DYNAMIC_DISPATCH(filter_words)(texture, rules, at, levels, count, to);
}

}  // namespace ninebit
#endif
