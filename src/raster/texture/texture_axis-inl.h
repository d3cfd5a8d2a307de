// Wrap modes along the axes of texture levels (texture_wrap.h) and places on cube-map faces, in vectors.
#if defined(NINEBIT_RASTER_TEXTURE_TEXTURE_AXIS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_TEXTURE_TEXTURE_AXIS_INL_H_
#undef NINEBIT_RASTER_TEXTURE_TEXTURE_AXIS_INL_H_
#else
#define NINEBIT_RASTER_TEXTURE_TEXTURE_AXIS_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "ninebit/raster/sampler.h"
#include "src/raster/rules/fragment_vector-inl.h"
#include "src/raster/texture/texture_wrap.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<float>;
using VF = hn::Vec<DF>;
using DI = hn::RebindToSigned<DF>;
using VI = hn::Vec<DI>;
constexpr DF kDF;
constexpr DI kDI;

HWY_INLINE VF set(float v) {
  return hn::Set(kDF, v);
}

// One axis of a level, which may be another one in each lane. A side is a power of two: floats divide and multiply by
// it exactly.
struct Axis {
  VF size, inverse;  // of the side
  VI last;
  Wrap wrap;
  HWY_INLINE Axis(VI side, Wrap mode)
      : size(hn::ConvertTo(kDF, side)),
        inverse(hn::BitCast(kDF, hn::Sub(hn::Set(kDI, 2 * (127 << 23)), hn::BitCast(kDI, size)))),  // by exponents
        last(hn::Sub(side, hn::Set(kDI, 1))),
        wrap(mode) {}
};

HWY_INLINE VI whole_texel(const Axis& axis, VF u) {
  return hn::Min(hn::ConvertTo(kDI, u), axis.last);
}

// s in the modes that repeat, 0 from 2^24 on: there floats are even integers, where a texture begins. NaN and infinity
// count as such integers.
HWY_INLINE VF near_enough(VF s) {
  return hn::IfThenElseZero(hn::Lt(hn::Abs(s), set(0x1p24F)), s);
}

// u - n × floor(u / n), n being a power of two; u is not a negative fraction.
HWY_INLINE VF remainder(VF u, VF n, VF inverse) {
  return hn::Sub(u, hn::Mul(hn::Floor(hn::Mul(u, inverse)), n));
}

// s in texels, mirrored at 0 as at every other integer: from 0 to the side.
HWY_INLINE VF mirrored(const Axis& axis, VF s) {
  const VF twice = hn::Add(axis.size, axis.size);
  const VF phase = remainder(hn::Mul(hn::Abs(near_enough(s)), axis.size), twice, hn::Mul(axis.inverse, set(0.5F)));
  return hn::Min(phase, hn::Sub(twice, phase));
}

// s in texels, from 0 to the side.
HWY_INLINE VF clamped(const Axis& axis, VF s) {
  s = hn::IfThenElseZero(hn::Gt(s, hn::Zero(kDF)), s);  // NaN is not greater
  return hn::Mul(hn::Min(s, set(1.0F)), axis.size);
}

// True if whole_bits() may be called. Otherwise wrap the float first.
HWY_INLINE bool have_whole_bits(VF v) {
  return hn::AllTrue(kDF, hn::Lt(hn::Abs(v), set(0x1p22F - 256.0F)));
}

// The lowest 22 bits of whole + more; the others mean nothing. Whole numbers wrap in them: a side has at most 2^14
// texels, in steps of weights 2^22. Faster than a conversion, which also handles
// numbers that do not fit.
HWY_INLINE VI whole_bits(VF whole, int more) {
  return hn::BitCast(kDI, hn::Add(whole, set(0x1.8p23F + static_cast<float>(more))));
}

// nearest_texel; no step rounds a float. The modes that clamp differ only in the border, which reads_border() finds.
HWY_INLINE VI texel_along(const Axis& axis, VF s) {
  if (axis.wrap == Wrap::repeat) {
    const VF texels = hn::Mul(s, axis.size);
    if (HWY_LIKELY(have_whole_bits(texels))) return hn::And(whole_bits(hn::Floor(texels), 0), axis.last);
    const VF u = hn::Floor(hn::Mul(near_enough(s), axis.size));
    return hn::ConvertTo(kDI, remainder(u, axis.size, axis.inverse));
  }
  return whole_texel(axis, axis.wrap == Wrap::mirrored_repeat ? mirrored(axis, s) : clamped(axis, s));
}

// -1 where nearest_texel is the border, else 0: NaN counts as 0, which is a texel's.
HWY_INLINE VI reads_border(const Axis& axis, VF s) {
  if (axis.wrap != Wrap::clamp_to_border) return hn::Zero(kDI);
  const auto outside = hn::Or(hn::Lt(s, hn::Zero(kDF)), hn::Ge(s, set(1.0F)));
  return hn::VecFromMask(kDI, hn::RebindMask(kDI, outside));
}

// bordered_texels for NEAREST: the texel of an image that holds a border, of twice the axis's side.
HWY_INLINE VI stored_texel_along(const Axis& axis, VF s) {
  constexpr float kBorder = kStoredBorder;
  const VI first = hn::Set(kDI, kStoredBorder);
  if (axis.wrap != Wrap::clamp_to_border) return hn::Add(texel_along(axis, s), first);
  s = hn::IfThenElseZero(hn::Eq(s, s), s);
  const VF last = hn::Sub(hn::Add(axis.size, axis.size), set(kBorder + 1.0F));
  const VF texel = hn::Min(hn::Max(hn::Floor(hn::Mul(s, axis.size)), set(-kBorder)), last);
  return hn::Add(hn::ConvertTo(kDI, texel), first);
}

// texel_along for 0 <= s <= 1, where the modes differ only at 1.
HWY_INLINE VI texel_on_face(const Axis& axis, VF s) {
  const VI texel = hn::ConvertTo(kDI, hn::Mul(s, axis.size));
  return axis.wrap == Wrap::repeat ? hn::And(texel, axis.last) : hn::Min(texel, axis.last);
}

// The rules of most profiles, known to the compiler: weights of 8 bits, cut.
struct CutBytes {
  static constexpr int weight_bits = 8;
  static constexpr bool cuts_weights = true;
};

// linear_texels for all modes but Wrap::clamp: returns the first texel, sets the second and its weight. `Rules` has
// members of FilterRules. `kOnFace`: 0 <= s <= 1.
template <bool kOnFace = false, class Rules>
HWY_INLINE VI texels_along(const Axis& axis, VF s, const Rules& rules, VI& second, VI& weight) {
  const int bits = rules.weight_bits;
  const float one = static_cast<float>(1 << bits);
  if (axis.wrap == Wrap::repeat && rules.cuts_weights) {
    const VF steps = hn::Mul(s, hn::Mul(axis.size, set(one)));
    if (HWY_LIKELY(have_whole_bits(steps))) {
      const VI fixed = whole_bits(hn::Floor(steps), -(1 << bits) / 2);
      const VI first = hn::ShiftRightSame(fixed, bits);
      weight = hn::And(fixed, hn::Set(kDI, (1 << bits) - 1));
      second = hn::And(hn::Sub(first, hn::Set(kDI, -1)), axis.last);  // adds 1; -1 needs no constant from memory
      return hn::And(first, axis.last);
    }
  }
  VF u;
  if (axis.wrap == Wrap::repeat) {
    u = hn::Mul(near_enough(s), axis.size);
  } else {
    u = kOnFace ? hn::Mul(s, axis.size) : axis.wrap == Wrap::mirrored_repeat ? mirrored(axis, s) : clamped(axis, s);
    u = hn::Min(hn::Max(u, set(0.5F)), hn::Sub(axis.size, set(0.5F)));
  }
  // Cuts to a step of the weights, or rounds to one, halves up. For fractions below 0 the difference may round, but not
  // to less than a half.
  u = hn::Mul(u, set(one));
  const VF down = hn::Floor(u);
  VF step = down;
  if (!rules.cuts_weights) {
    step = hn::Add(down, hn::IfThenElseZero(hn::Ge(hn::Sub(u, down), set(0.5F)), set(1.0F)));
  }
  if (axis.wrap == Wrap::repeat) {
    step = remainder(step, hn::Mul(axis.size, set(one)), hn::Mul(axis.inverse, set(1.0F / one)));
  }
  const VI fixed = hn::Sub(hn::ConvertTo(kDI, step), hn::Set(kDI, (1 << bits) / 2));
  const VI first = hn::ShiftRightSame(fixed, bits);
  const VI next = hn::Add(first, hn::Set(kDI, 1));
  weight = hn::And(fixed, hn::Set(kDI, (1 << bits) - 1));
  second = axis.wrap == Wrap::repeat ? hn::And(next, axis.last) : hn::Min(next, axis.last);
  return hn::And(first, axis.last);  // `first` is -1 at least, and only where it repeats
}

// Two neighbours of a filter that may read a border.
struct BorderedTexels {
  VI first, second;  // places in the image
  VI weight;
  VI outside_first, outside_second;  // -1 where it is the border's colour, else 0
};

// linear_texels, or with border texels bordered_texels, of a side without them.
template <class Rules>
HWY_INLINE BorderedTexels bordered_texels_along(const Axis& axis, VF s, const Rules& rules, bool border_texels) {
  const VI zero = hn::Zero(kDI), one = hn::Set(kDI, 1), moved = hn::Set(kDI, border_texels ? kStoredBorder : 0);
  BorderedTexels at{zero, zero, zero, zero, zero};
  if (axis.wrap != Wrap::clamp && axis.wrap != Wrap::clamp_to_border) {
    at.first = hn::Add(texels_along(axis, s, rules, at.second, at.weight), moved);
    at.second = hn::Add(at.second, moved);
    return at;
  }
  // As in texels_along; to the side, one texel beyond it, or beyond the border of the image.
  const bool reads_image = border_texels && axis.wrap == Wrap::clamp_to_border;
  const float reach = reads_image ? 2.0F * kStoredBorder : axis.wrap == Wrap::clamp ? 0.0F : 1.0F;
  const VF side = reads_image ? hn::Add(axis.size, axis.size) : axis.size;
  const VF u = hn::Mul(hn::IfThenElseZero(hn::Eq(s, s), s), axis.size);
  const int bits = rules.weight_bits;
  const VF steps =
      hn::Mul(hn::Min(hn::Max(u, set(-reach)), hn::Add(side, set(reach))), set(static_cast<float>(1 << bits)));
  VF step = hn::Floor(steps);
  if (!rules.cuts_weights) {
    step = hn::Add(step, hn::IfThenElseZero(hn::Ge(hn::Sub(steps, step), set(0.5F)), set(1.0F)));
  }
  const VI fixed = hn::Sub(hn::ConvertTo(kDI, step), hn::Set(kDI, (1 << bits) / 2));
  at.weight = hn::And(fixed, hn::Set(kDI, (1 << bits) - 1));
  at.first = hn::ShiftRightSame(fixed, bits);
  at.second = hn::Add(at.first, one);
  if (reads_image) {
    const VI last = hn::Add(hn::Add(axis.last, axis.last), one);
    for (VI* const texel : {&at.first, &at.second}) *texel = hn::Min(hn::Max(hn::Add(*texel, moved), zero), last);
    return at;
  }
  const auto outside = [&](VI texel) HWY_ATTR {
    return hn::VecFromMask(kDI, hn::Or(hn::Lt(texel, zero), hn::Gt(texel, axis.last)));
  };
  at.outside_first = outside(at.first);
  at.outside_second = outside(at.second);
  for (VI* const texel : {&at.first, &at.second}) *texel = hn::Add(hn::Min(hn::Max(*texel, zero), axis.last), moved);
  return at;
}

// Loads the coordinates of the next fragments: returns the face's number, sets the place on the face.
HWY_INLINE VI load_place(bool cube, const std::array<const float*, 3>& at, std::size_t lane, VF& s, VF& t) {
  s = hn::LoadU(kDF, at[0] + lane);
  t = hn::LoadU(kDF, at[1] + lane);
  if (!cube) return hn::Zero(kDI);
  const auto place = cube_place(VectorValues<DI>(), s, t, hn::LoadU(kDF, at[2] + lane));
  s = place.s;
  t = place.t;
  return place.face;
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
