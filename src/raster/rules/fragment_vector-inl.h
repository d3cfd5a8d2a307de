// The fragment rules for a vector of fragments, on every SIMD target.
#if defined(NINEBIT_RASTER_RULES_FRAGMENT_VECTOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_RULES_FRAGMENT_VECTOR_INL_H_
#undef NINEBIT_RASTER_RULES_FRAGMENT_VECTOR_INL_H_
#else
#define NINEBIT_RASTER_RULES_FRAGMENT_VECTOR_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/texture.h"
#include "src/raster/rules/color_masks.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The value domain: vectors. D is a tag of 32-bit integers.
template <class D>
struct VectorValues {
  using DF = hn::Rebind<float, D>;
  using V = hn::Vec<D>;
  using F = hn::Vec<DF>;
  using FM = hn::Mask<DF>;

  static HWY_INLINE V set(int v) { return hn::Set(D(), v); }
  static HWY_INLINE F set(float v) { return hn::Set(DF(), v); }
  template <class T>
  static HWY_INLINE T add(T a, T b) {
    return hn::Add(a, b);
  }
  template <class T>
  static HWY_INLINE T sub(T a, T b) {
    return hn::Sub(a, b);
  }
  static HWY_INLINE V min_of(V a, V b) { return hn::Min(a, b); }
  static HWY_INLINE V max_of(V a, V b) { return hn::Max(a, b); }
  static HWY_INLINE V shift_left(V v, int bits) { return hn::ShiftLeftSame(v, bits); }
  static HWY_INLINE V shift_right(V v, int bits) { return hn::ShiftRightSame(v, bits); }
  static HWY_INLINE V bits_and(V a, V b) { return hn::And(a, b); }
  static HWY_INLINE V bits_or(V a, V b) { return hn::Or(a, b); }
  static HWY_INLINE V bits_and_not(V without, V v) { return hn::AndNot(without, v); }
  static HWY_INLINE F mul(F a, F b) { return hn::Mul(a, b); }
  static HWY_INLINE F div(F a, F b) { return hn::Div(a, b); }
  static HWY_INLINE F negated(F v) { return hn::Neg(v); }
  static HWY_INLINE F abs_of(F v) { return hn::Abs(v); }
  static HWY_INLINE F floor_of(F v) { return hn::Floor(v); }
  static HWY_INLINE FM less(F a, F b) { return hn::Lt(a, b); }
  static HWY_INLINE FM equal(F a, F b) { return hn::Eq(a, b); }
  static HWY_INLINE FM greater_equal(F a, F b) { return hn::Ge(a, b); }
  static HWY_INLINE FM less_equal(F a, F b) { return hn::Le(a, b); }
  static HWY_INLINE FM all(FM a, FM b) { return hn::And(a, b); }
  static HWY_INLINE FM any(FM a, FM b) { return hn::Or(a, b); }
  static HWY_INLINE FM without(FM no, FM yes) { return hn::AndNot(no, yes); }
  static HWY_INLINE F select(FM choice, F yes, F no) { return hn::IfThenElse(choice, yes, no); }
  static HWY_INLINE V number_where(FM choice, int yes, V no) {
    return hn::IfThenElse(hn::RebindMask(D(), choice), set(yes), no);
  }
  static HWY_INLINE F where(FM choice, F yes) { return hn::IfThenElseZero(choice, yes); }
  static HWY_INLINE V where(FM choice, V yes) { return hn::IfThenElseZero(hn::RebindMask(D(), choice), yes); }
};

#define NINEBIT_RULE HWY_INLINE
#include "src/raster/rules/fragment_rules.inl"
#undef NINEBIT_RULE

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
