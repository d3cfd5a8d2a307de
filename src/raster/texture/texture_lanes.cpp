// Compiled once for every SIMD target and chosen at run time.
#include "src/raster/texture/texture_lanes.h"

#include <cstring>

#include "src/numerics/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/texture/texture_lanes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/raster/texture/texture_axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::Rebind<s9, DI>;
constexpr D16 kD16;

HWY_INLINE void store(VI v, LaneIntegers& to, std::size_t lane) {
  hn::StoreU(v, kDI, to.data() + lane);
}

// Both axes of a level, for NEAREST. kBorders: LaneLevel::has_borders().
template <bool kBorders>
struct NearestAxes {
  Axis across, up;
  bool cube, border_texels;
  VI stride;
  HWY_INLINE explicit NearestAxes(const LaneLevel& level)
      : across(hn::Set(kDI, level.width), level.wrap_s),
        up(hn::Set(kDI, level.height), level.wrap_t),
        cube(level.cube),
        border_texels(level.border_texels),
        stride(hn::Set(kDI, level.stride)) {}
  [[nodiscard]] HWY_INLINE VI offset(VF s, VF t) const {
    return hn::Add(hn::Mul(texel(up, t), stride), texel(across, s));
  }
  // -1 where the border's colour is read, else 0.
  [[nodiscard]] HWY_INLINE VI outside(VF s, VF t) const { return hn::Or(reads_border(across, s), reads_border(up, t)); }

 private:
  [[nodiscard]] HWY_INLINE VI texel(const Axis& axis, VF s) const {
    if (kBorders && border_texels) return stored_texel_along(axis, s);
    return cube ? texel_on_face(axis, s) : texel_along(axis, s);
  }
};

// In this namespace, so that the compiler vectorizes the loop for the target.
HWY_INLINE bool all_like_first(const LaneIntegers& values, std::size_t count) {
  std::int32_t others = 0;
  for (std::size_t i = 0; i < count; ++i) others |= values[i] ^ values[0];
  return others == 0;
}

template <bool kBorders>
HWY_INLINE void find_nearest_of(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t count,
                                NearestLanes& to) {
  const NearestAxes<kBorders> axes(level);
  const bool has_border = kBorders && level.has_border_color();
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    VF s, t;
    store(load_place(level.cube, at, lane, s, t), to.face, lane);
    store(axes.offset(s, t), to.offset, lane);
    if (has_border) store(axes.outside(s, t), to.outside, lane);
  }
  to.one_face = all_like_first(to.face, count);
}

void find_nearest(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t count, NearestLanes& to) {
  level.has_borders() ? find_nearest_of<true>(level, at, count, to) : find_nearest_of<false>(level, at, count, to);
}

template <bool kBorders>
HWY_INLINE void fetch_words_of(const LaneLevel& level, const std::array<const float*, 3>& at, const TexelWords& texels,
                               std::size_t count, std::uint32_t* to) {
  const bool has_border = kBorders && level.has_border_color();
#if HWY_TARGET <= HWY_AVX2  // these have gather instructions
  const NearestAxes<kBorders> axes(level);
  constexpr hn::RebindToUnsigned<DI> du;
  const auto* const words = reinterpret_cast<const std::uint32_t*>(texels.first);
  const VI begin = hn::LoadU(kDI, texels.face_word.data());
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    VF s, t;
    const VI face = load_place(level.cube, at, lane, s, t);
    const VI of_face = hn::TableLookupLanes(begin, hn::IndicesFromVec(kDI, face));
    auto word = hn::GatherIndex(du, words, hn::Add(of_face, axes.offset(s, t)));
    if (has_border) {
      const auto outside = hn::BitCast(du, axes.outside(s, t));
      word = hn::IfVecThenElse(outside, hn::Set(du, texels.border), word);
    }
    hn::StoreU(word, du, to + lane);
  }
#else
  NearestLanes lanes;
  find_nearest_of<kBorders>(level, at, count, lanes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::ptrdiff_t begin = texels.face_word[static_cast<std::size_t>(lanes.face[i])];
    std::memcpy(&to[i], texels.first + 4 * (begin + lanes.offset[i]), 4);
    if (has_border && lanes.outside[i] != 0) to[i] = texels.border;
  }
#endif
}

void fetch_nearest_words(const LaneLevel& level, const std::array<const float*, 3>& at, const TexelWords& texels,
                         std::size_t count, std::uint32_t* to) {
  level.has_borders() ? fetch_words_of<true>(level, at, texels, count, to)
                      : fetch_words_of<false>(level, at, texels, count, to);
}

void find_linear(const LaneLevel& level, const FilterRules& rules, const std::array<const float*, 3>& at,
                 std::size_t count, LinearLanes& to) {
  const Axis across(hn::Set(kDI, level.width), level.wrap_s), up(hn::Set(kDI, level.height), level.wrap_t);
  const VI stride = hn::Set(kDI, level.stride);
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    VF s, t;
    store(load_place(level.cube, at, lane, s, t), to.face, lane);
    VI right, above, u, v;
    const VI left = texels_along(across, s, rules, right, u);
    const VI low = hn::Mul(texels_along(up, t, rules, above, v), stride);
    const VI high = hn::Mul(above, stride);
    store(hn::Add(low, left), to.offset[0], lane);
    store(hn::Add(low, right), to.offset[1], lane);
    store(hn::Add(high, left), to.offset[2], lane);
    store(hn::Add(high, right), to.offset[3], lane);
    store(u, to.u, lane);
    store(v, to.v, lane);
  }
  to.one_face = all_like_first(to.face, count);
}

// The compiler vectorizes these loops for the target.
void apply_key(const WordKey& key, std::size_t count, LaneWords& words, std::uint8_t* killed) {
  const std::uint32_t word = key.word & key.compared, compared = key.compared;
  if (key.operation == ColorKeyOperation::kill) {
    for (std::size_t i = 0; i < count && killed != nullptr; ++i) {
      killed[i] = static_cast<std::uint8_t>(killed[i] | ((words[i] & compared) == word ? 1 : 0));
    }
    return;
  }
  const std::uint32_t kept = key.operation == ColorKeyOperation::alpha ? 0x00FFFFFF : 0;
  for (std::size_t i = 0; i < count; ++i) words[i] &= (words[i] & compared) == word ? kept : ~std::uint32_t{0};
}

void split_words(const LaneWords& words, int byte_shift, std::size_t count, const std::array<s9*, 4>& to) {
  std::size_t lane = 0;
#if HWY_TARGET != HWY_SCALAR  // its words have no halves
  constexpr hn::RepartitionToNarrow<hn::RebindToUnsigned<DI>> d16;
  constexpr hn::RebindToSigned<decltype(d16)> codes;
  constexpr std::size_t kWords = hn::MaxLanes(d16) / 2;
  const auto* const halves = reinterpret_cast<const std::uint16_t*>(words.data());
  for (; lane + 2 * kWords <= count; lane += 2 * kWords) {
    const auto first = hn::LoadU(d16, halves + 2 * lane), second = hn::LoadU(d16, halves + 2 * (lane + kWords));
    const auto low = hn::ConcatEven(d16, second, first), high = hn::ConcatOdd(d16, second, first);
    const auto put = [&](std::size_t byte, hn::Vec<decltype(d16)> v) HWY_ATTR {
      if (to[byte] == nullptr) return;
      if (byte_shift != 0) v = hn::ShiftRightSame(v, byte_shift);
      hn::StoreU(hn::BitCast(codes, v), codes, to[byte] + lane);
    };
    const auto bits = hn::Set(d16, 0xFF);
    put(0, hn::And(low, bits));
    put(1, hn::ShiftRight<8>(low));
    put(2, hn::And(high, bits));
    put(3, hn::ShiftRight<8>(high));
  }
#endif
  for (std::size_t byte = 0; byte < 4; ++byte) {
    for (std::size_t i = lane; i < count && to[byte] != nullptr; ++i) {
      to[byte][i] = static_cast<s9>((words[i] >> (8 * byte) & 0xFF) >> byte_shift);
    }
  }
}

void weigh_linear(const LinearLanes& lanes, const CornerBytes& corner, const FilterRules& rules, std::size_t count,
                  std::array<s9, kBatchSize>& to) {
  const int bits = rules.weight_bits, row_shift = rules.rounds_each_blend ? bits : 0, shift = 2 * bits - row_shift;
  const VI row_half = hn::Set(kDI, rules.rounds_each_blend ? 1 << (bits - 1) : 0);
  const VI half = hn::Set(kDI, 1 << (shift - 1));
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    const VI u = hn::LoadU(kDI, lanes.u.data() + lane), v = hn::LoadU(kDI, lanes.v.data() + lane);
    const auto row = [&](std::size_t left, std::size_t right) HWY_ATTR {
      const VI a = hn::PromoteTo(kDI, hn::LoadU(kD16, corner[left].data() + lane));
      const VI b = hn::PromoteTo(kDI, hn::LoadU(kD16, corner[right].data() + lane));
      const VI sum = hn::Add(hn::ShiftLeftSame(a, bits), hn::Mul(hn::Sub(b, a), u));
      return hn::ShiftRightSame(hn::Add(sum, row_half), row_shift);
    };
    const VI low = row(0, 1), high = row(2, 3);
    const VI sum = hn::Add(hn::ShiftLeftSame(low, bits), hn::Mul(hn::Sub(high, low), v));
    const VI rounded = hn::ShiftRightSame(hn::Add(sum, half), shift);
    hn::StoreU(hn::DemoteTo(kD16, rounded), kD16, to.data() + lane);
  }
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(find_nearest);
HWY_EXPORT(find_linear);
HWY_EXPORT(fetch_nearest_words);
HWY_EXPORT(apply_key);
HWY_EXPORT(split_words);
HWY_EXPORT(weigh_linear);

void find_nearest(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t count, NearestLanes& to) {
  HWY_DYNAMIC_DISPATCH(find_nearest)(level, at, count, to);
}

void find_linear(const LaneLevel& level, const FilterRules& rules, const std::array<const float*, 3>& at,
                 std::size_t count, LinearLanes& to) {
  HWY_DYNAMIC_DISPATCH(find_linear)(level, rules, at, count, to);
}

void fetch_nearest_words(const LaneLevel& level, const std::array<const float*, 3>& at, const TexelWords& texels,
                         std::size_t count, std::uint32_t* to) {
  HWY_DYNAMIC_DISPATCH(fetch_nearest_words)(level, at, texels, count, to);
}

void apply_key(const WordKey& key, std::size_t count, LaneWords& words, std::uint8_t* killed) {
  HWY_DYNAMIC_DISPATCH(apply_key)(key, count, words, killed);
}

void split_words(const LaneWords& words, int byte_shift, std::size_t count, const std::array<s9*, 4>& to) {
  HWY_DYNAMIC_DISPATCH(split_words)(words, byte_shift, count, to);
}

void weigh_linear(const LinearLanes& lanes, const CornerBytes& corner, const FilterRules& rules, std::size_t count,
                  std::array<s9, kBatchSize>& to) {
  HWY_DYNAMIC_DISPATCH(weigh_linear)(lanes, corner, rules, count, to);
}

}  // namespace ninebit
#endif
