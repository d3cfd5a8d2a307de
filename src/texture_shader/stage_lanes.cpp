#include "src/texture_shader/stage_lanes.h"

#include <cmath>

#include "src/numerics/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/texture_shader/stage_lanes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::stage_lanes::HWY_NAMESPACE {

#define NINEBIT_STAGE_RULE HWY_INLINE
#include "src/texture_shader/stage_rules.inl"
#undef NINEBIT_STAGE_RULE

void divide(const float* a, const float* b, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = a[i] / b[i];
}

template <StageByte kHow>
HWY_INLINE void bytes_by(NegativeNumber negative, const float* from, std::size_t count, s9* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<s9>(stage_byte<kHow>(byte_number(negative, from[i])));
}

void bytes_of(const StageChoices& choices, const float* from, std::size_t count, s9* to) {
  const NegativeNumber negative = choices.negative;
  if (choices.byte == StageByte::nearest) return bytes_by<StageByte::nearest>(negative, from, count, to);
  bytes_by<StageByte::twelve_bits>(negative, from, count, to);
}

void offset(const float* at, const OffsetBy& by, std::size_t count, float* to) {
  const s9 *const ds = by.ds, *const dt = by.dt;
  const float by_ds = by.by_ds, by_dt = by.by_dt;
  for (std::size_t i = 0; i < count; ++i) to[i] = offset_coordinate(at[i], by_ds, ds[i], by_dt, dt[i]);
}

template <StageByte kHow>
HWY_INLINE void scale_by(NegativeNumber negative, const s9* luminance, float scale, float bias, std::size_t count,
                         s9* texel) {
  for (std::size_t i = 0; i < count; ++i) {
    texel[i] = static_cast<s9>(scaled_byte<kHow>(negative, texel[i], luminance[i], scale, bias));
  }
}

void scale(const StageChoices& choices, const s9* luminance, float scale, float bias, std::size_t count, s9* texel) {
  const NegativeNumber negative = choices.negative;
  if (choices.byte == StageByte::nearest) {
    scale_by<StageByte::nearest>(negative, luminance, scale, bias, count, texel);
  } else {
    scale_by<StageByte::twelve_bits>(negative, luminance, scale, bias, count, texel);
  }
}

template <DotMapping kMapping>
HWY_INLINE void dot_by(DotDivisors divisors, const Three& at, const Texels& texels, std::size_t count, float* to) {
  const float *const s = at[0], *const t = at[1], *const r = at[2];
  const s9 *const red = texels[0], *const green = texels[1], *const blue = texels[2], *const alpha = texels[3];
  for (std::size_t i = 0; i < count; ++i) {
    const StageFactor n = stage_factor<kMapping>(divisors, red[i], green[i], blue[i], alpha[i]);
    to[i] = stage_dot({s[i], t[i], r[i]}, n.number) / n.over;
  }
}

void dot(DotMapping mapping, DotDivisors divisors, const Three& at, const Texels& texels, std::size_t count,
         float* to) {
  switch (mapping) {
    case DotMapping::minus1_to_1_d3d:
      return dot_by<DotMapping::minus1_to_1_d3d>(divisors, at, texels, count, to);
    case DotMapping::minus1_to_1_gl:
      return dot_by<DotMapping::minus1_to_1_gl>(divisors, at, texels, count, to);
    case DotMapping::minus1_to_1:
      return dot_by<DotMapping::minus1_to_1>(divisors, at, texels, count, to);
    case DotMapping::hilo_1:
      return dot_by<DotMapping::hilo_1>(divisors, at, texels, count, to);
    case DotMapping::hilo_hemisphere:
      return dot_by<DotMapping::hilo_hemisphere>(divisors, at, texels, count, to);
    case DotMapping::zero_to_one:
    case DotMapping::hilo_hemisphere_d3d:
    case DotMapping::hilo_hemisphere_gl:
      break;
  }
  dot_by<DotMapping::zero_to_one>(divisors, at, texels, count, to);
}

void dependent(const s9* bytes, float divisor, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>(bytes[i]) / divisor;
}

void reflect(const Three& dots, const Three& eye, std::size_t count, const std::array<float*, 3>& to) {
  const float *const dx = dots[0], *const dy = dots[1], *const dz = dots[2];
  const float *const ex = eye[0], *const ey = eye[1], *const ez = eye[2];
  // One result at a time: compilers make no vectors of a loop with so many arrays that may overlap.
  const auto at = [&](std::size_t i) HWY_ATTR { return reflected_eye({dx[i], dy[i], dz[i]}, {ex[i], ey[i], ez[i]}); };
  float *const x = to[0], *const y = to[1], *const z = to[2];
  for (std::size_t i = 0; i < count; ++i) x[i] = at(i).x;
  for (std::size_t i = 0; i < count; ++i) y[i] = at(i).y;
  for (std::size_t i = 0; i < count; ++i) z[i] = at(i).z;
}

template <CullMode kMode>
HWY_INLINE void cull_by(CullZero zero, const float* at, std::size_t count, std::uint8_t* killed) {
  for (std::size_t i = 0; i < count; ++i) {
    killed[i] = static_cast<std::uint8_t>(killed[i] | (is_killing(kMode, zero, at[i]) ? 1 : 0));
  }
}

void cull(CullMode mode, CullZero zero, const float* at, std::size_t count, std::uint8_t* killed) {
  if (mode == CullMode::kills_negative) return cull_by<CullMode::kills_negative>(zero, at, count, killed);
  cull_by<CullMode::kills_not_negative>(zero, at, count, killed);
}

void convert_yuv(std::size_t count, const std::array<s9*, 3>& color) {
  s9 *const red = color[0], *const green = color[1], *const blue = color[2];
  for (std::size_t i = 0; i < count; ++i) {
    const StageColor rgb = rgb_of_yuv(red[i], green[i], blue[i]);
    red[i] = static_cast<s9>(rgb.red);
    green[i] = static_cast<s9>(rgb.green);
    blue[i] = static_cast<s9>(rgb.blue);
  }
}

}  // namespace ninebit::stage_lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit::stage_lanes {

HWY_EXPORT(divide);
HWY_EXPORT(bytes_of);
HWY_EXPORT(offset);
HWY_EXPORT(scale);
HWY_EXPORT(dot);
HWY_EXPORT(dependent);
HWY_EXPORT(reflect);
HWY_EXPORT(cull);
HWY_EXPORT(convert_yuv);

void divide(const float* a, const float* b, std::size_t count, float* to) {
  HWY_DYNAMIC_DISPATCH(divide)(a, b, count, to);
}
void bytes_of(const StageChoices& choices, const float* from, std::size_t count, s9* to) {
  HWY_DYNAMIC_DISPATCH(bytes_of)(choices, from, count, to);
}
void offset(const float* at, const OffsetBy& by, std::size_t count, float* to) {
  HWY_DYNAMIC_DISPATCH(offset)(at, by, count, to);
}
void scale(const StageChoices& choices, const s9* luminance, float scale, float bias, std::size_t count, s9* texel) {
  HWY_DYNAMIC_DISPATCH(scale)(choices, luminance, scale, bias, count, texel);
}
void dot(DotMapping mapping, DotDivisors divisors, const Three& at, const Texels& texels, std::size_t count,
         float* to) {
  HWY_DYNAMIC_DISPATCH(dot)(mapping, divisors, at, texels, count, to);
}
void dependent(const s9* bytes, float divisor, std::size_t count, float* to) {
  HWY_DYNAMIC_DISPATCH(dependent)(bytes, divisor, count, to);
}
void reflect(const Three& dots, const Three& eye, std::size_t count, const std::array<float*, 3>& to) {
  HWY_DYNAMIC_DISPATCH(reflect)(dots, eye, count, to);
}
void cull(CullMode mode, CullZero zero, const float* at, std::size_t count, std::uint8_t* killed) {
  HWY_DYNAMIC_DISPATCH(cull)(mode, zero, at, count, killed);
}
void convert_yuv(std::size_t count, const std::array<s9*, 3>& color) {
  HWY_DYNAMIC_DISPATCH(convert_yuv)(count, color);
}

}  // namespace ninebit::stage_lanes
#endif
