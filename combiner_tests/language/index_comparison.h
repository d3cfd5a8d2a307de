// The state that "Index Cube Shadow Mapping in OpenGL using nVidia Register Combiners" sets, and what it begins with.
#pragma once

#include "ninebit/combiner/state.h"

namespace ninebit::test {

constexpr CombinerInput rgb_of(Register reg, InputMapping mapping = InputMapping::unsigned_identity) {
  return {reg, mapping, ComponentUsage::rgb};
}
inline constexpr CombinerInput kOne = rgb_of(Register::zero, InputMapping::unsigned_invert);
inline constexpr CombinerInput kMinusOne = rgb_of(Register::zero, InputMapping::expand_normal);

// General combiners that write nothing, and a final combiner that gives 0.
constexpr CombinerState silent_state(int stages) {
  CombinerState state;
  state.num_general_combiners = stages;
  for (int i = 0; i < stages; ++i) {
    GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    stage.rgb.out = stage.alpha.out = {.sum = Register::discard};
  }
  FinalCombiner& f = state.final_combiner;
  f.a = f.b = f.c = f.d = rgb_of(Register::zero);
  f.g = {Register::zero, InputMapping::unsigned_identity, ComponentUsage::alpha};
  return state;
}

constexpr CombinerState index_comparison() {
  CombinerState state = silent_state(2);
  const CombinerInput spare0 = rgb_of(Register::spare0, InputMapping::signed_identity), zero = rgb_of(Register::zero);
  state.general[0].rgb = {rgb_of(Register::primary),
                          kOne,
                          rgb_of(Register::texture0),
                          kMinusOne,
                          {.sum = Register::spare0, .scale = Scale::by_four}};
  state.general[1].rgb = {
      spare0,
      spare0,
      zero,
      zero,
      {.ab = Register::spare1, .sum = Register::discard, .scale = Scale::by_four, .ab_dot_product = true}};
  state.final_combiner.g = {Register::spare1, InputMapping::unsigned_identity, ComponentUsage::blue};
  return state;
}

}  // namespace ninebit::test
