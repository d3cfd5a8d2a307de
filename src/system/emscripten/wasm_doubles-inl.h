// Vectors of two doubles for WebAssembly, which has them; Highway 1.0's target for it does not. The operations are
// those that this program uses, by Highway's names.
#if defined(NINEBIT_SYSTEM_EMSCRIPTEN_WASM_DOUBLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_SYSTEM_EMSCRIPTEN_WASM_DOUBLES_INL_H_
#undef NINEBIT_SYSTEM_EMSCRIPTEN_WASM_DOUBLES_INL_H_
#else
#define NINEBIT_SYSTEM_EMSCRIPTEN_WASM_DOUBLES_INL_H_
#endif

#include "hwy/highway.h"

#if HWY_TARGET == HWY_WASM && !HWY_HAVE_FLOAT64

HWY_BEFORE_NAMESPACE();
namespace hwy::HWY_NAMESPACE {

using TwoDoubles = Vec128<double, 2>;
using TagOfDoubles = Simd<double, 2, 0>;

HWY_API TwoDoubles Set(TagOfDoubles, double value) {
  return TwoDoubles{wasm_f64x2_splat(value)};
}

HWY_API TwoDoubles operator+(TwoDoubles a, TwoDoubles b) {
  return TwoDoubles{wasm_f64x2_add(a.raw, b.raw)};
}
HWY_API TwoDoubles operator-(TwoDoubles a, TwoDoubles b) {
  return TwoDoubles{wasm_f64x2_sub(a.raw, b.raw)};
}
HWY_API TwoDoubles operator*(TwoDoubles a, TwoDoubles b) {
  return TwoDoubles{wasm_f64x2_mul(a.raw, b.raw)};
}
HWY_API TwoDoubles operator/(TwoDoubles a, TwoDoubles b) {
  return TwoDoubles{wasm_f64x2_div(a.raw, b.raw)};
}
HWY_API TwoDoubles Abs(TwoDoubles v) {
  return TwoDoubles{wasm_f64x2_abs(v.raw)};
}
HWY_API TwoDoubles Sqrt(TwoDoubles v) {
  return TwoDoubles{wasm_f64x2_sqrt(v.raw)};
}
HWY_API TwoDoubles Floor(TwoDoubles v) {
  return TwoDoubles{wasm_f64x2_floor(v.raw)};
}
// The result for a number and a NaN is `b`, as on x86: "pseudo-minimum", whose operands are swapped.
HWY_API TwoDoubles Min(TwoDoubles a, TwoDoubles b) {
  return TwoDoubles{wasm_f64x2_pmin(b.raw, a.raw)};
}
HWY_API TwoDoubles Max(TwoDoubles a, TwoDoubles b) {
  return TwoDoubles{wasm_f64x2_pmax(b.raw, a.raw)};
}

HWY_API Mask128<double, 2> operator==(TwoDoubles a, TwoDoubles b) {
  return Mask128<double, 2>{wasm_f64x2_eq(a.raw, b.raw)};
}
HWY_API Mask128<double, 2> operator>(TwoDoubles a, TwoDoubles b) {
  return Mask128<double, 2>{wasm_f64x2_gt(a.raw, b.raw)};
}
HWY_API Mask128<double, 2> operator<=(TwoDoubles a, TwoDoubles b) {
  return Mask128<double, 2>{wasm_f64x2_le(a.raw, b.raw)};
}

// Toward zero; the values are in range.
HWY_API Vec128<int64_t, 2> ConvertTo(Simd<int64_t, 2, 0>, TwoDoubles v) {
  return Vec128<int64_t, 2>{wasm_i64x2_make(static_cast<int64_t>(wasm_f64x2_extract_lane(v.raw, 0)),
                                            static_cast<int64_t>(wasm_f64x2_extract_lane(v.raw, 1)))};
}
HWY_API Vec128<float, 2> DemoteTo(Simd<float, 2, 0>, TwoDoubles v) {
  return Vec128<float, 2>{wasm_f32x4_demote_f64x2_zero(v.raw)};
}
HWY_API TwoDoubles PromoteTo(TagOfDoubles, Vec128<float, 2> v) {
  return TwoDoubles{wasm_f64x2_promote_low_f32x4(v.raw)};
}

}  // namespace hwy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#endif  // per-target include guard
