// Gathers for a vector of receivers at a time. Compiled for every SIMD target; the target is chosen at run time.
#include <cstdint>

#include "src/numerics/simd_targets.h"
#include "src/shadow/reflective/gather_pattern.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/shadow/reflective/gather.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, Receivers::kCapacity>;
using VF = hn::Vec<DF>;
using DI = hn::RebindToSigned<DF>;
using VI = hn::Vec<DI>;
constexpr DF kDF;
constexpr DI kDI;

struct Vec3 {
  VF x, y, z;
};

HWY_INLINE Vec3 load(const std::array<Receivers::Lane, 3>& lanes, std::size_t first) {
  return {hn::LoadU(kDF, lanes[0].data() + first), hn::LoadU(kDF, lanes[1].data() + first),
          hn::LoadU(kDF, lanes[2].data() + first)};
}

HWY_INLINE Vec3 fetch(const float* base, VI index) {
  return {hn::GatherIndex(kDF, base, index), hn::GatherIndex(kDF, base + 1, index),
          hn::GatherIndex(kDF, base + 2, index)};
}

HWY_INLINE VF dot(const Vec3& a, const Vec3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

void gather_light(const PixelLights& lights, const GatherPattern& pattern, float kernel, std::size_t count,
                  Receivers& receivers) {
  const float* const values = lights.values.data();
  const VF zero = hn::Zero(kDF), size = hn::Set(kDF, static_cast<float>(lights.size)), radius = hn::Set(kDF, kernel);
  const VF smallest = hn::Set(kDF, kSmallestSquare);
  const VI row = hn::Set(kDI, lights.size), stride = hn::Set(kDI, static_cast<std::int32_t>(PixelLights::kStride));
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kDF)) {
    const Vec3 position = load(receivers.position, lane), normal = load(receivers.normal, lane);
    const VF s = hn::LoadU(kDF, receivers.s.data() + lane), t = hn::LoadU(kDF, receivers.t.data() + lane);
    const VF cosine = hn::LoadU(kDF, receivers.cosine.data() + lane);
    const VF sine = hn::LoadU(kDF, receivers.sine.data() + lane);
    Vec3 sum{zero, zero, zero};
    for (std::size_t i = 0; i < pattern.x.size(); ++i) {
      const VF x = hn::Set(kDF, pattern.x[i]), y = hn::Set(kDF, pattern.y[i]);
      const VF offset_x = hn::Sub(hn::Mul(cosine, x), hn::Mul(sine, y));
      const VF offset_y = hn::Add(hn::Mul(sine, x), hn::Mul(cosine, y));
      const VF u = hn::Add(s, hn::Mul(offset_x, radius)), v = hn::Add(t, hn::Mul(offset_y, radius));
      const auto inside = hn::And(hn::And(hn::Ge(u, zero), hn::Lt(u, size)), hn::And(hn::Ge(v, zero), hn::Lt(v, size)));
      if (hn::AllFalse(kDF, inside)) continue;
      const VI texel = hn::Add(hn::Mul(hn::ConvertTo(kDI, hn::IfThenElseZero(inside, v)), row),
                               hn::ConvertTo(kDI, hn::IfThenElseZero(inside, u)));
      const VI index = hn::Mul(texel, stride);
      const Vec3 at = fetch(values, index), facing = fetch(values + 3, index);
      const Vec3 away{hn::Sub(position.x, at.x), hn::Sub(position.y, at.y), hn::Sub(position.z, at.z)};
      const VF leaving = dot(facing, away), arriving = hn::Neg(dot(normal, away)), square = dot(away, away);
      const auto reached =
          hn::And(hn::And(hn::Gt(leaving, zero), hn::Gt(arriving, zero)), hn::And(inside, hn::Ge(square, smallest)));
      if (hn::AllFalse(kDF, reached)) continue;
      const VF weight = pattern.weight.empty() ? hn::Mul(offset_x, offset_x) : hn::Set(kDF, pattern.weight[i]);
      const VF share = hn::Div(hn::Mul(leaving, arriving), hn::Mul(square, square));
      const VF factor = hn::IfThenElseZero(reached, hn::Mul(weight, share));
      const Vec3 flux = fetch(values + 6, index);
      sum = {hn::Add(sum.x, hn::Mul(factor, flux.x)), hn::Add(sum.y, hn::Mul(factor, flux.y)),
             hn::Add(sum.z, hn::Mul(factor, flux.z))};
    }
    hn::StoreU(sum.x, kDF, receivers.irradiance[0].data() + lane);
    hn::StoreU(sum.y, kDF, receivers.irradiance[1].data() + lane);
    hn::StoreU(sum.z, kDF, receivers.irradiance[2].data() + lane);
  }
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(gather_light);

void gather(const PixelLights& lights, const GatherPattern& pattern, float kernel, std::size_t count,
            Receivers& receivers) {
  HWY_DYNAMIC_DISPATCH(gather_light)(lights, pattern, kernel, count, receivers);
}

}  // namespace ninebit
#endif
