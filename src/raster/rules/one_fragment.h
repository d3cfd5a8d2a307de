// The fragment rules for one fragment.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/texture.h"
#include "src/raster/rules/color_masks.h"

namespace ninebit::one_fragment {

// The value domain: plain numbers.
struct Numbers {
  using V = std::int32_t;
  using F = float;
  using FM = bool;

  static V set(int v) { return v; }
  static F set(float v) { return v; }
  template <class T>
  static T add(T a, T b) {
    return a + b;
  }
  template <class T>
  static T sub(T a, T b) {
    return a - b;
  }
  static V min_of(V a, V b) { return std::min(a, b); }
  static V max_of(V a, V b) { return std::max(a, b); }
  static V shift_left(V v, int bits) { return v * (1 << bits); }
  static V shift_right(V v, int bits) { return v >> bits; }
  static V bits_and(V a, V b) { return a & b; }
  static V bits_or(V a, V b) { return a | b; }
  static V bits_and_not(V without, V v) { return v & ~without; }
  template <class T>
  static T mul(T a, T b) {
    return a * b;
  }
  static V saturated_sum(V a, V b) { return std::min(a + b, 0xFFFF); }
  static V saturated_difference(V a, V b) { return std::max(a - b, 0); }
  static F div(F a, F b) { return a / b; }
  static F negated(F v) { return -v; }
  static F abs_of(F v) { return std::fabs(v); }
  static F floor_of(F v) { return std::floor(v); }
  static FM less(F a, F b) { return a < b; }
  static FM equal(F a, F b) { return a == b; }
  static FM greater_equal(F a, F b) { return a >= b; }
  static FM less_equal(F a, F b) { return a <= b; }
  static FM all(FM a, FM b) { return a && b; }
  static FM any(FM a, FM b) { return a || b; }
  static FM without(FM no, FM yes) { return yes && !no; }
  static F select(FM choice, F yes, F no) { return choice ? yes : no; }
  static V number_where(FM choice, int yes, V no) { return choice ? yes : no; }
  template <class T>
  static T where(FM choice, T yes) {
    return choice ? yes : T{};
  }
};

#define NINEBIT_RULE inline
#include "src/raster/rules/fragment_rules.inl"
#undef NINEBIT_RULE

}  // namespace ninebit::one_fragment
