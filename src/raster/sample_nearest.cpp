// NEAREST on textures of bytes: the rules of cube_face.h and texture_wrap.h over vectors of float lanes, compiled once
// for every SIMD target and chosen at run time; then byte by byte what they select.
#include "src/raster/sample_nearest.h"

#include <algorithm>
#include <variant>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/sample_nearest.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

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
HWY_INLINE VI face_number(CubeFace face) {
  return hn::Set(kDI, static_cast<std::int32_t>(face));
}

// One axis of a level. A side is a power of two, by which floats divide and multiply exactly.
struct Axis {
  float size;
  std::int32_t last;
  Wrap wrap;
};

HWY_INLINE VI whole_texel(const Axis& axis, VF u) {
  return hn::Min(hn::ConvertTo(kDI, u), hn::Set(kDI, axis.last));
}

// nearest_texel, in floats: no operation here rounds.
HWY_INLINE VI texel_along(const Axis& axis, VF s) {
  const VF size = set(axis.size);
  // Clamping modes differ in the border, which NEAREST never reads.
  if (axis.wrap == Wrap::clamp || axis.wrap == Wrap::clamp_to_edge) {
    s = hn::IfThenElseZero(hn::Gt(s, hn::Zero(kDF)), s);  // NaN is not greater
    return whole_texel(axis, hn::Mul(hn::Min(s, set(1.0F)), size));
  }
  // From here on floats are even integers, where a texture begins; NaN and infinity count as one.
  s = hn::IfThenElseZero(hn::Lt(hn::Abs(s), set(0x1p24F)), s);
  if (axis.wrap == Wrap::repeat) {
    const VF u = hn::Floor(hn::Mul(s, size));
    return hn::ConvertTo(kDI, hn::Sub(u, hn::Mul(hn::Floor(hn::Mul(u, set(1.0F / axis.size))), size)));
  }
  const VF period = set(2.0F * axis.size);
  const VF u = hn::Mul(hn::Abs(s), size);  // mirrored at 0 as at every other integer
  const VF phase = hn::Sub(u, hn::Mul(hn::Floor(hn::Mul(u, set(0.5F / axis.size))), period));
  return whole_texel(axis, hn::Min(phase, hn::Sub(period, phase)));
}

// The same for 0 <= s <= 1, where the modes differ at 1 alone.
HWY_INLINE VI texel_on_face(const Axis& axis, VF s) {
  const VI texel = hn::ConvertTo(kDI, hn::Mul(s, set(axis.size)));
  const VI last = hn::Set(kDI, axis.last);
  return axis.wrap == Wrap::repeat ? hn::And(texel, last) : hn::Min(texel, last);
}

// cube_coordinate_inline: the face's number, and the place on it.
HWY_INLINE VI cube_coordinates(VF rx, VF ry, VF rz, VF& to_s, VF& to_t) {
  const VF zero = hn::Zero(kDF);
  const VF ax = hn::Abs(rx), ay = hn::Abs(ry), az = hn::Abs(rz);
  const auto not_x = hn::Or(hn::Gt(ay, ax), hn::Gt(az, ax));
  const auto is_z = hn::And(not_x, hn::Gt(az, ay));
  const auto is_y = hn::AndNot(is_z, not_x);
  const VF major = hn::IfThenElse(is_z, rz, hn::IfThenElse(is_y, ry, rx));
  const VF ma = hn::Abs(major);
  const auto negative = hn::Lt(major, zero);
  // Each of sc and tc is a component, whose sign some faces turn.
  const VF sc_positive = hn::IfThenElse(not_x, rx, hn::Neg(rz));
  const VF sc = hn::IfThenElse(hn::AndNot(is_y, negative), hn::Neg(sc_positive), sc_positive);
  const VF tc_positive = hn::IfThenElse(is_y, rz, hn::Neg(ry));
  const VF tc = hn::IfThenElse(hn::And(is_y, negative), hn::Neg(tc_positive), tc_positive);
  const VF one = set(1.0F), half = set(0.5F);
  const VF s = hn::Mul(hn::Add(hn::Div(sc, ma), one), half);
  const VF t = hn::Mul(hn::Add(hn::Div(tc, ma), one), half);
  const auto within = [&](VF v) HWY_ATTR {  // infinity over infinity is NaN, which fails both comparisons
    return hn::IfThenElseZero(hn::And(hn::Ge(v, zero), hn::Le(v, one)), v);
  };
  const auto is_number = hn::And(hn::And(hn::Eq(rx, rx), hn::Eq(ry, ry)), hn::Eq(rz, rz));
  const auto is_zero = hn::Eq(ma, zero);
  const VI positive_face =
      hn::IfThenElse(hn::RebindMask(kDI, is_z), face_number(CubeFace::positive_z),
                     hn::IfThenElse(hn::RebindMask(kDI, is_y), face_number(CubeFace::positive_y), hn::Zero(kDI)));
  const VI face = hn::Add(positive_face, hn::IfThenElseZero(hn::RebindMask(kDI, negative), hn::Set(kDI, 1)));
  to_s = hn::IfThenElseZero(is_number, hn::IfThenElse(is_zero, half, within(s)));
  to_t = hn::IfThenElseZero(is_number, hn::IfThenElse(is_zero, half, within(t)));
  return hn::IfThenElseZero(hn::RebindMask(kDI, is_number), face);
}

HWY_NOINLINE void find_in_lanes(const NearestLevel& level, const std::array<const float*, 3>& at, std::size_t count,
                                std::size_t first, NearestTexels& to) {
  const Axis across{static_cast<float>(level.width), level.width - 1, level.wrap_s};
  const Axis up{static_cast<float>(level.height), level.height - 1, level.wrap_t};
  const VI stride = hn::Set(kDI, level.stride);
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    VF s = hn::LoadU(kDF, at[0] + lane), t = hn::LoadU(kDF, at[1] + lane);
    VI x, y;
    if (level.cube) {
      const VI face = cube_coordinates(s, t, hn::LoadU(kDF, at[2] + lane), s, t);
      hn::StoreU(face, kDI, to.face.data() + first + lane);
      x = texel_on_face(across, s);
      y = texel_on_face(up, t);
    } else {
      x = texel_along(across, s);
      y = texel_along(up, t);
    }
    hn::StoreU(hn::Add(hn::Mul(y, stride), x), kDI, to.offset.data() + first + lane);
  }
}

// Here, so that the compiler makes it a loop of the target's lanes.
HWY_NOINLINE bool all_like_first(const std::int32_t* values, std::size_t count) {
  std::int32_t others = 0;
  for (std::size_t i = 0; i < count; ++i) others |= values[i] ^ values[0];
  return others == 0;
}

// Fewer fragments than there are lanes: what follows their coordinates is not ours to read.
HWY_NOINLINE void find_rest(const NearestLevel& level, const std::array<const float*, 3>& at, std::size_t count,
                            std::size_t first, NearestTexels& to) {
  alignas(64) float rest[3][hn::MaxLanes(kDF)] = {};
  for (std::size_t k = 0; k < (level.cube ? 3U : 2U); ++k) std::copy_n(at[k] + first, count, rest[k]);
  find_in_lanes(level, {rest[0], rest[1], rest[2]}, count, first, to);
}

void find_texels(const NearestLevel& level, const std::array<const float*, 3>& at, std::size_t count,
                 NearestTexels& to) {
  const std::size_t whole = count / hn::Lanes(kDF) * hn::Lanes(kDF);
  find_in_lanes(level, at, whole, 0, to);
  if (whole < count) find_rest(level, at, count - whole, whole, to);
  if (!level.cube) std::fill_n(to.face.begin(), count, 0);
  to.one_face = !level.cube || all_like_first(to.face.data(), count);
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {
namespace {

HWY_EXPORT(find_texels);

using BytePlane = Plane<const std::uint8_t>;

// How offsets count where planes have rows of several lengths: y in the upper half.
constexpr std::int32_t kUpperHalf = 0x10000;

// One component of every fragment's texel. Loads of single bytes: gathers are no faster, nor may they read beyond a
// plane; an interleaved copy of the texture takes as long as it saves in a frame.
void fetch(const std::array<BytePlane, 6>& faces, bool places, const NearestTexels& texels, std::size_t count, s9* to) {
  const auto face = [&](std::size_t i) { return static_cast<std::size_t>(texels.face[i]); };
  if (!places) {
    for (std::size_t i = 0; i < count; ++i) {
      to[i] = faces[face(i)].at(texels.offset[i] % kUpperHalf, texels.offset[i] / kUpperHalf);
    }
  } else if (texels.one_face) {
    const std::uint8_t* const plane = faces[face(0)].data;
    for (std::size_t i = 0; i < count; ++i) to[i] = plane[texels.offset[i]];
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = faces[face(i)].data[texels.offset[i]];
  }
}

}  // namespace

void find_nearest_texels(const NearestLevel& level, const std::array<const float*, 3>& at, std::size_t count,
                         NearestTexels& to) {
  HWY_DYNAMIC_DISPATCH(find_texels)(level, at, count, to);
}

void TextureSampler::sample_nearest(const TextureCoordinates& at, std::size_t first, std::size_t count,
                                    const std::array<s9*, 4>& codes) const {
  constexpr std::ptrdiff_t kLongestRow = 0x1FFFF;  // kMaxSurfaceSize times this is less than 2^31
  const std::array<bool, 4> stored = stored_components(texture_->format);
  std::array<std::array<BytePlane, 6>, 4> planes{};  // of the components that are stored
  for (std::size_t f = 0; f < texture_->face_count(); ++f) {
    const auto& of_face = *std::get_if<std::array<BytePlane, 4>>(&texture_->faces[f][0].planes);
    for (std::size_t k = 0; k < 4; ++k) planes[k][f] = of_face[k];
  }
  const std::ptrdiff_t stride = planes[stored[0] ? 0 : 3][0].stride;
  bool alike = stride >= -kLongestRow && stride <= kLongestRow;
  for (std::size_t f = 0; f < texture_->face_count(); ++f) {
    for (std::size_t k = 0; k < 4; ++k) alike = alike && (!stored[k] || planes[k][f].stride == stride);
  }
  const TextureImage& base = texture_->faces[0][0];
  const NearestLevel level{.cube = cube_,
                           .width = base.width,
                           .height = base.height,
                           .wrap_s = sampler_.wrap_s,
                           .wrap_t = sampler_.wrap_t,
                           .stride = alike ? static_cast<std::int32_t>(stride) : kUpperHalf};
  NearestTexels texels;
  find_nearest_texels(level, {at.value[0] + first, at.value[1] + first, cube_ ? at.value[2] + first : nullptr}, count,
                      texels);
  for (std::size_t out = 0; out < 4; ++out) {
    s9* const to = codes[out] + first;
    const auto twin =
        static_cast<std::size_t>(std::find(source_.begin(), source_.end(), source_[out]) - source_.begin());
    if (source_[out] < 0) {
      std::fill_n(to, count, constant_[out]);
    } else if (twin < out) {
      std::copy_n(codes[twin] + first, count, to);
    } else {
      fetch(planes[static_cast<std::size_t>(source_[out])], alike, texels, count, to);
      if (byte_shift_ == 0) continue;
      for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<s9>(to[i] >> byte_shift_);
    }
  }
}

}  // namespace ninebit
#endif
