// Cube-map faces and the rules of texture_wrap.h over vectors of float lanes, compiled once for every SIMD target and
// chosen at run time.
#include "src/raster/texture/texture_lanes.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/texture/texture_lanes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/raster/rules/fragment_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<float>;
using VF = hn::Vec<DF>;
using DI = hn::RebindToSigned<DF>;
using VI = hn::Vec<DI>;
using D16 = hn::Rebind<s9, DI>;
constexpr DF kDF;
constexpr DI kDI;
constexpr D16 kD16;

HWY_INLINE VF set(float v) {
  return hn::Set(kDF, v);
}

// One axis of a level. A side is a power of two: floats divide and multiply by it exactly.
struct Axis {
  float size;
  std::int32_t last;
  Wrap wrap;
};

HWY_INLINE VI whole_texel(const Axis& axis, VF u) {
  return hn::Min(hn::ConvertTo(kDI, u), hn::Set(kDI, axis.last));
}

// s in the modes that repeat, 0 from 2^24 on: there floats are even integers, where a texture begins. NaN and infinity
// count as such integers.
HWY_INLINE VF near_enough(VF s) {
  return hn::IfThenElseZero(hn::Lt(hn::Abs(s), set(0x1p24F)), s);
}

// u - n × floor(u / n), n being a power of two; u is not a negative fraction.
HWY_INLINE VF remainder(VF u, float n) {
  return hn::Sub(u, hn::Mul(hn::Floor(hn::Mul(u, set(1.0F / n))), set(n)));
}

// s in texels, mirrored at 0 as at every other integer: from 0 to the side.
HWY_INLINE VF mirrored(const Axis& axis, VF s) {
  const VF phase = remainder(hn::Mul(hn::Abs(near_enough(s)), set(axis.size)), 2.0F * axis.size);
  return hn::Min(phase, hn::Sub(set(2.0F * axis.size), phase));
}

// s in texels, from 0 to the side.
HWY_INLINE VF clamped(const Axis& axis, VF s) {
  s = hn::IfThenElseZero(hn::Gt(s, hn::Zero(kDF)), s);  // NaN is not greater
  return hn::Mul(hn::Min(s, set(1.0F)), set(axis.size));
}

// nearest_texel; no step rounds a float. The modes that clamp differ only in the border, which NEAREST never reads.
HWY_INLINE VI texel_along(const Axis& axis, VF s) {
  if (axis.wrap == Wrap::repeat) {
    const VF u = hn::Floor(hn::Mul(near_enough(s), set(axis.size)));
    return hn::ConvertTo(kDI, remainder(u, axis.size));
  }
  return whole_texel(axis, axis.wrap == Wrap::mirrored_repeat ? mirrored(axis, s) : clamped(axis, s));
}

// The same for 0 <= s <= 1, where the modes differ only at 1.
HWY_INLINE VI texel_on_face(const Axis& axis, VF s) {
  const VI texel = hn::ConvertTo(kDI, hn::Mul(s, set(axis.size)));
  const VI last = hn::Set(kDI, axis.last);
  return axis.wrap == Wrap::repeat ? hn::And(texel, last) : hn::Min(texel, last);
}

// linear_texels for all modes but Wrap::clamp: returns the first texel, sets the second and its weight.
HWY_INLINE VI texels_along(const Axis& axis, VF s, int bits, VI& second, VI& weight) {
  const float one = static_cast<float>(1 << bits);
  VF u;
  if (axis.wrap == Wrap::repeat) {
    u = hn::Mul(near_enough(s), set(axis.size));
  } else {
    u = axis.wrap == Wrap::mirrored_repeat ? mirrored(axis, s) : clamped(axis, s);
    u = hn::Min(hn::Max(u, set(0.5F)), set(axis.size - 0.5F));
  }
  // Rounds to a step of the weights, halves up. For fractions below 0 the difference may round, but not to less than
  // a half.
  u = hn::Mul(u, set(one));
  const VF down = hn::Floor(u);
  VF step = hn::Add(down, hn::IfThenElseZero(hn::Ge(hn::Sub(u, down), set(0.5F)), set(1.0F)));
  if (axis.wrap == Wrap::repeat) step = remainder(step, axis.size * one);
  const VI fixed = hn::Sub(hn::ConvertTo(kDI, step), hn::Set(kDI, (1 << bits) / 2));
  const VI first = hn::ShiftRightSame(fixed, bits);
  const VI last = hn::Set(kDI, axis.last), next = hn::Add(first, hn::Set(kDI, 1));
  weight = hn::And(fixed, hn::Set(kDI, (1 << bits) - 1));
  second = axis.wrap == Wrap::repeat ? hn::And(next, last) : hn::Min(next, last);
  return hn::And(first, last);  // `first` is -1 at least, and only where it repeats
}

HWY_INLINE void store(VI v, LaneIntegers& to, std::size_t lane) {
  hn::StoreU(v, kDI, to.data() + lane);
}

// Loads the coordinates of the next fragments: returns the face's number, sets the place on the face.
HWY_INLINE VI load_place(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t lane, VF& s,
                         VF& t) {
  s = hn::LoadU(kDF, at[0] + lane);
  t = hn::LoadU(kDF, at[1] + lane);
  if (!level.cube) return hn::Zero(kDI);
  const auto place = cube_place(VectorValues<DI>(), s, t, hn::LoadU(kDF, at[2] + lane));
  s = place.s;
  t = place.t;
  return place.face;
}

// Both axes of a level, for NEAREST.
struct NearestAxes {
  Axis across, up;
  bool cube;
  VI stride;
  HWY_INLINE explicit NearestAxes(const LaneLevel& level)
      : across{static_cast<float>(level.width), level.width - 1, level.wrap_s},
        up{static_cast<float>(level.height), level.height - 1, level.wrap_t},
        cube(level.cube),
        stride(hn::Set(kDI, level.stride)) {}
  [[nodiscard]] HWY_INLINE VI offset(VF s, VF t) const {
    const VI x = cube ? texel_on_face(across, s) : texel_along(across, s);
    const VI y = cube ? texel_on_face(up, t) : texel_along(up, t);
    return hn::Add(hn::Mul(y, stride), x);
  }
};

// In this namespace, so that the compiler vectorizes the loop for the target.
HWY_INLINE bool all_like_first(const LaneIntegers& values, std::size_t count) {
  std::int32_t others = 0;
  for (std::size_t i = 0; i < count; ++i) others |= values[i] ^ values[0];
  return others == 0;
}

void find_nearest(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t count, NearestLanes& to) {
  const NearestAxes axes(level);
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    VF s, t;
    store(load_place(level, at, lane, s, t), to.face, lane);
    store(axes.offset(s, t), to.offset, lane);
  }
  to.one_face = all_like_first(to.face, count);
}

void fetch_nearest_words(const LaneLevel& level, const std::array<const float*, 3>& at, const TexelWords& texels,
                         std::size_t count, std::uint32_t* to) {
#if HWY_TARGET <= HWY_AVX2  // these have gather instructions
  const NearestAxes axes(level);
  constexpr hn::RebindToUnsigned<DI> du;
  const auto* const words = reinterpret_cast<const std::uint32_t*>(texels.first);
  const VI begin = hn::LoadU(kDI, texels.face_word.data());
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    VF s, t;
    const VI face = load_place(level, at, lane, s, t);
    const VI of_face = hn::TableLookupLanes(begin, hn::IndicesFromVec(kDI, face));
    hn::StoreU(hn::GatherIndex(du, words, hn::Add(of_face, axes.offset(s, t))), du, to + lane);
  }
#else
  NearestLanes lanes;
  HWY_NAMESPACE::find_nearest(level, at, count, lanes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::ptrdiff_t begin = texels.face_word[static_cast<std::size_t>(lanes.face[i])];
    std::memcpy(&to[i], texels.first + 4 * (begin + lanes.offset[i]), 4);
  }
#endif
}

void find_linear(const LaneLevel& level, int weight_bits, const std::array<const float*, 3>& at, std::size_t count,
                 LinearLanes& to) {
  const Axis across{static_cast<float>(level.width), level.width - 1, level.wrap_s};
  const Axis up{static_cast<float>(level.height), level.height - 1, level.wrap_t};
  const VI stride = hn::Set(kDI, level.stride);
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    VF s, t;
    store(load_place(level, at, lane, s, t), to.face, lane);
    VI right, above, u, v;
    const VI left = texels_along(across, s, weight_bits, right, u);
    const VI low = hn::Mul(texels_along(up, t, weight_bits, above, v), stride);
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

void split_words(const LaneWords& words, int byte, std::size_t count, s9* to) {
  std::size_t lane = 0;
  for (; lane + hn::Lanes(kDF) <= count; lane += hn::Lanes(kDF)) {
    const VI word = hn::BitCast(kDI, hn::LoadU(hn::RebindToUnsigned<DI>(), words.data() + lane));
    const VI value = hn::And(hn::ShiftRightSame(word, 8 * byte), hn::Set(kDI, 0xFF));
    hn::StoreU(hn::DemoteTo(kD16, value), kD16, to + lane);
  }
  for (; lane < count; ++lane) to[lane] = static_cast<s9>(words[lane] >> (8 * byte) & 0xFF);
}

void weigh_linear(const LinearLanes& lanes, const CornerBytes& corner, int weight_bits, std::size_t count,
                  std::array<s9, kBatchSize>& to) {
  const VI half = hn::Set(kDI, 1 << (2 * weight_bits - 1));
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    const VI u = hn::LoadU(kDI, lanes.u.data() + lane), v = hn::LoadU(kDI, lanes.v.data() + lane);
    const auto between = [&](std::size_t left, std::size_t right) HWY_ATTR {
      const VI a = hn::PromoteTo(kDI, hn::LoadU(kD16, corner[left].data() + lane));
      const VI b = hn::PromoteTo(kDI, hn::LoadU(kD16, corner[right].data() + lane));
      return hn::Add(hn::ShiftLeftSame(a, weight_bits), hn::Mul(hn::Sub(b, a), u));
    };
    const VI low = between(0, 1), high = between(2, 3);
    const VI sum = hn::Add(hn::ShiftLeftSame(low, weight_bits), hn::Mul(hn::Sub(high, low), v));
    const VI rounded = hn::ShiftRightSame(hn::Add(sum, half), 2 * weight_bits);
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
HWY_EXPORT(split_words);
HWY_EXPORT(weigh_linear);

void find_nearest(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t count, NearestLanes& to) {
  HWY_DYNAMIC_DISPATCH(find_nearest)(level, at, count, to);
}

void find_linear(const LaneLevel& level, int weight_bits, const std::array<const float*, 3>& at, std::size_t count,
                 LinearLanes& to) {
  HWY_DYNAMIC_DISPATCH(find_linear)(level, weight_bits, at, count, to);
}

void fetch_nearest_words(const LaneLevel& level, const std::array<const float*, 3>& at, const TexelWords& texels,
                         std::size_t count, std::uint32_t* to) {
  HWY_DYNAMIC_DISPATCH(fetch_nearest_words)(level, at, texels, count, to);
}

void split_words(const LaneWords& words, int byte, std::size_t count, s9* to) {
  HWY_DYNAMIC_DISPATCH(split_words)(words, byte, count, to);
}

void weigh_linear(const LinearLanes& lanes, const CornerBytes& corner, int weight_bits, std::size_t count,
                  std::array<s9, kBatchSize>& to) {
  HWY_DYNAMIC_DISPATCH(weigh_linear)(lanes, corner, weight_bits, count, to);
}

}  // namespace ninebit
#endif
