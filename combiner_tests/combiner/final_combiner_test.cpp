// The final combiner's inputs, and the registers before the first general combiner.
#include <gtest/gtest.h>

#include "combiner_tests/combiner/support.h"

namespace ninebit::test {
namespace {

RegisterFile sample_registers() {
  RegisterFile r;
  r[Register::fog] = codes(100, 110, 120, 51);
  r[Register::primary] = codes(10, 20, 30, 40);
  r[Register::secondary] = codes(50, 60, 70, 80);
  r[Register::spare0] = codes(1, 2, 3, 4);
  return r;
}

TEST(FinalCombiner, ReadsEveryRegisterByComponentOrItsAlpha) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    CombinerState state = silent_state(1);
    state.constant0 = color_of(200, 201, 202, 203);
    state.constant1 = color_of(210, 211, 212, 213);
    const int last = static_cast<int>(Register::texture0) + profile.texture_units;
    for (int i = 0; i < last; ++i) {
      const auto reg = static_cast<Register>(i);
      RegisterFile r;
      r[reg] = codes(5, 6, 7, 8);
      const Rgba9 value = reg == Register::zero        ? codes(0, 0, 0, 0)
                          : reg == Register::constant0 ? codes(200, 201, 202, 203)
                          : reg == Register::constant1 ? codes(210, 211, 212, 213)
                                                       : codes(5, 6, 7, 8);
      state.final_combiner = final_of(reg);
      EXPECT_EQ(judged(state, profile, r).color, value) << name_of(reg);
      state.final_combiner.d = alpha_of(reg);
      state.final_combiner.g = blue_of(reg);
      EXPECT_EQ(judged(state, profile, r).color, codes(value[3], value[3], value[3], value[2])) << name_of(reg);
    }
  }
}

TEST(FinalCombiner, FogBlendsByItsAlpha) {
  // f = 51 / 255 = 1/5 of primary and 4/5 of the fog colour.
  CombinerState state = silent_state(1);
  state.final_combiner.a = alpha_of(Register::fog);
  state.final_combiner.b = rgb_of(Register::primary);
  state.final_combiner.c = rgb_of(Register::fog);
  EXPECT_EQ(judged(state, profiles::geforce2, sample_registers()).color, codes(82, 92, 102, 4));
  state.final_combiner.a.mapping = InputMapping::unsigned_invert;
  EXPECT_EQ(judged(state, profiles::geforce2, sample_registers()).color, codes(28, 38, 48, 4));
}

TEST(FinalCombiner, ComputedRegistersWorkInEveryVariableThatMayReadThem) {
  CombinerState state = silent_state(1);
  FinalCombiner& f = state.final_combiner;
  f.e = rgb_of(Register::primary, InputMapping::unsigned_invert);
  f.f = rgb_of(Register::secondary);
  // E·F = R(245 · 50 / 255), R(235 · 60 / 255), R(225 · 70 / 255) = 48, 55, 62; the sum is 51, 62, 73.
  f.d = rgb_of(Register::e_times_f);
  EXPECT_EQ(judged(state, profiles::nv2a, sample_registers()).color, codes(48, 55, 62, 4));
  f.d = rgb_of(Register::e_times_f, InputMapping::unsigned_invert);
  EXPECT_EQ(judged(state, profiles::nv2a, sample_registers()).color, codes(207, 200, 193, 4));
  f.d = kZero;
  f.a = rgb_of(Register::e_times_f);
  f.b = kOne;
  EXPECT_EQ(judged(state, profiles::nv2a, sample_registers()).color, codes(48, 55, 62, 4));
  f.a = kOne;
  f.b = rgb_of(Register::spare0_plus_secondary);
  EXPECT_EQ(judged(state, profiles::nv2a, sample_registers()).color, codes(51, 62, 73, 4));
  f.a = kZero;
  f.c = rgb_of(Register::spare0_plus_secondary);
  EXPECT_EQ(judged(state, profiles::nv2a, sample_registers()).color, codes(51, 62, 73, 4));
  f.c = rgb_of(Register::e_times_f);
  f.d = rgb_of(Register::spare0_plus_secondary);
  EXPECT_EQ(judged(state, profiles::nv2a, sample_registers()).color, codes(99, 117, 135, 4));
}

TEST(FinalCombiner, AlphaIsGWithItsMapping) {
  CombinerState state = silent_state(1);
  for (const int v : {-255, -1, 0, 1, 127, 128, 254, 255}) {
    RegisterFile r;
    r[Register::spare1] = codes(0, 0, v, v);
    const int positive = v < 0 ? 0 : v;
    state.final_combiner.g = alpha_of(Register::spare1);
    EXPECT_EQ(judged(state, profiles::geforce2, r).color[kAlpha], positive);
    state.final_combiner.g = blue_of(Register::spare1, InputMapping::unsigned_invert);
    EXPECT_EQ(judged(state, profiles::geforce2, r).color[kAlpha], 255 - positive);
  }
}

}  // namespace
}  // namespace ninebit::test
