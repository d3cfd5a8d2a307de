// How a general combiner reads, combines and writes: portions, outputs, dot products, mux, constants. By every path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "combiner_tests/combiner/support.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kCard = profiles::geforce2;

RegisterFile mixed_registers() {
  RegisterFile r;
  r[Register::fog] = codes(90, 91, 92, 93);
  r[Register::primary] = codes(10, 20, 30, 40);
  r[Register::secondary] = codes(50, 60, 70, 80);
  r[Register::spare0] = codes(100, -110, 120, 130);
  r[Register::spare1] = codes(-140, 150, 160, -170);
  r[Register::texture0] = codes(180, 190, 200, 210);
  r[Register::texture1] = codes(220, 230, 240, 250);
  return r;
}

// A·1 of one register to another, in the RGB portion.
Portion move_rgb(Register from, Register to) {
  return {rgb_of(from, InputMapping::signed_identity), kOne, kZero, kZero, ab_to(to)};
}

Portion move_alpha(Register from, Register to) {
  return of_alpha(move_rgb(from, to));
}

// A·1 and C·1 of two registers.
Portion move_two(Register a, Register c, const PortionOutput& out) {
  return {rgb_of(a), kOne, rgb_of(c), kOne, out};
}

TEST(GeneralCombiner, TheDefaultStateIsColorSumAndFog) {
  RegisterFile r = mixed_registers();
  const Fragment out = judged(CombinerState{}, kCard, r);
  EXPECT_EQ(out.registers[Register::spare0], codes(10, 20, 30, 40)) << "spare0 = primary";
  // f (spare0 + secondary) + (1 - f) fog, f = 93: (93 · 60 + 162 · 90) / 255 = 79.06 and so on.
  EXPECT_EQ(out.color, codes(79, 87, 95, 40));
  // A second default stage computes the same again.
  CombinerState two;
  two.num_general_combiners = 2;
  EXPECT_EQ(judged(two, kCard, r).color, out.color);
}

TEST(GeneralCombiner, DiscardWritesNothing) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    RegisterFile r;
    for (std::size_t i = 0; i < kRegisterCount; ++i) r.value[i] = codes(static_cast<int>(i), -3, 5, -7);
    CombinerState state = silent_state(profile.general_combiners);
    EXPECT_EQ(judged(state, profile, r).registers, r);
  }
}

TEST(GeneralCombiner, EachPortionWritesItsOwnComponents) {
  CombinerState state = rgb_stage(move_rgb(Register::texture0, Register::spare0));
  RegisterFile expected = mixed_registers();
  expected[Register::spare0] = codes(180, 190, 200, 130);
  EXPECT_EQ(judged(state, kCard, mixed_registers()).registers, expected);

  state = silent_state(1);
  state.general[0].alpha = move_alpha(Register::texture0, Register::spare0);
  expected = mixed_registers();
  expected[Register::spare0] = codes(100, -110, 120, 210);
  EXPECT_EQ(judged(state, kCard, mixed_registers()).registers, expected);
}

TEST(GeneralCombiner, EveryWritableRegisterTakesEachOfTheThreeOutputs) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    const int units = profile.texture_units;
    for (int to = static_cast<int>(Register::primary); to < static_cast<int>(Register::texture0) + units; ++to) {
      for (int which = 0; which < 3; ++which) {
        PortionOutput out = sum_to(Register::discard);
        (which == 0 ? out.ab : which == 1 ? out.cd : out.sum) = static_cast<Register>(to);
        const CombinerState state = rgb_stage(move_two(Register::primary, Register::secondary, out));
        RegisterFile expected = mixed_registers();
        const Rgba9 values[3] = {codes(10, 20, 30, 0), codes(50, 60, 70, 0), codes(60, 80, 100, 0)};
        Rgba9& written = expected[static_cast<Register>(to)];
        for (std::size_t c = 0; c < 3; ++c) written[c] = values[which][c];
        EXPECT_EQ(judged(state, profile, mixed_registers()).registers, expected) << to << ' ' << which;
      }
    }
  }
}

TEST(GeneralCombiner, ComponentUsage) {
  const PortionOutput out{.ab = Register::spare0, .cd = Register::spare1, .sum = Register::discard};
  CombinerState state = rgb_stage({alpha_of(Register::primary), kOne, rgb_of(Register::primary), kOneAlpha, out});
  state.general[0].alpha = {blue_of(Register::primary), kOneAlpha, blue_of(Register::fog),
                            blue_of(Register::zero, InputMapping::unsigned_invert), out};
  const RegisterFile after = judged(state, kCard, mixed_registers()).registers;
  EXPECT_EQ(after[Register::spare0], codes(40, 40, 40, 30));
  EXPECT_EQ(after[Register::spare1], codes(10, 20, 30, 92));
}

TEST(GeneralCombiner, AStageSeesWhatTheStageBeforeItWrote) {
  CombinerState state = silent_state(2);
  state.general[0].rgb = move_rgb(Register::texture1, Register::spare1);
  state.general[1].rgb = move_rgb(Register::spare1, Register::primary);
  EXPECT_EQ(judged(state, kCard, mixed_registers()).registers[Register::primary], codes(220, 230, 240, 40));
  // With one stage the second does not run.
  state.num_general_combiners = 1;
  EXPECT_EQ(judged(state, kCard, mixed_registers()).registers[Register::primary], codes(10, 20, 30, 40));
}

TEST(GeneralCombiner, TheSumIsNotClampedBeforeBiasAndScale) {
  CombinerState state =
      rgb_stage(move_two(Register::texture1, Register::texture1,
                         {.ab = Register::spare1, .sum = Register::spare0, .scale = Scale::by_one_half}));
  Portion& rgb = state.general[0].rgb;
  const RegisterFile after = judged(state, profiles::nv2a, mixed_registers()).registers;
  EXPECT_EQ(after[Register::spare0], codes(220, 230, 240, 130)) << "(x + x) / 2";
  EXPECT_EQ(after[Register::spare1], codes(110, 115, 120, -170)) << "the scale is every output's";
  rgb.out.scale = Scale::none;
  rgb.out.bias = Bias::by_negative_one_half;
  EXPECT_EQ(judged(state, profiles::nv2a, mixed_registers()).registers[Register::spare0], codes(255, 255, 255, 130));
  // 2 · 128 - 128 = 128: clamped first it would be 127.
  RegisterFile r;
  r[Register::texture1] = codes(128, 150, 191, 0);
  EXPECT_EQ(judged(state, kCard, r).registers[Register::spare0], codes(128, 172, 254, 0));
}

TEST(GeneralCombiner, NegativeAndPositiveProductsCancelBeforeTheClamp) {
  const CombinerState state =
      rgb_stage({rgb_of(Register::texture1),
                 kOne,
                 rgb_of(Register::texture0),
                 kMinusOne,
                 {.ab = Register::spare0, .cd = Register::spare1, .sum = Register::primary, .scale = Scale::by_four}});
  const RegisterFile after = judged(state, kCard, mixed_registers()).registers;
  EXPECT_EQ(after[Register::primary], codes(160, 160, 160, 40)) << "4 (220 - 180), from the unclamped products";
  EXPECT_EQ(after[Register::spare0], codes(255, 255, 255, 130));
  EXPECT_EQ(after[Register::spare1], codes(-255, -255, -255, -170));
}

// The pieces of a stage with both dot products: (1, 1/2, 0) and (-1, 1, 1/5) against ones.
CombinerState dot_state(bool ab, bool cd) {
  return rgb_stage({rgb_of(Register::texture0, InputMapping::signed_identity),
                    kOne,
                    rgb_of(Register::texture1, InputMapping::signed_identity),
                    kOne,
                    {.ab = Register::primary,
                     .cd = Register::secondary,
                     .sum = Register::spare1,
                     .ab_dot_product = ab,
                     .cd_dot_product = cd}});
}

RegisterFile dot_registers() {
  RegisterFile r;
  r[Register::texture0] = codes(100, 50, 0, 0);
  r[Register::texture1] = codes(-90, 30, 20, 0);
  return r;
}

TEST(GeneralCombiner, DotProductsGoToAllThreeComponentsAndIntoTheSum) {
  struct Row {
    bool ab, cd;  // are dot products
    Rgba9 primary, secondary, spare1;
  };
  for (const Row& row : {Row{false, false, codes(100, 50, 0, 0), codes(-90, 30, 20, 0), codes(10, 80, 20, 0)},
                         Row{true, false, codes(150, 150, 150, 0), codes(-90, 30, 20, 0), codes(60, 180, 170, 0)},
                         Row{false, true, codes(100, 50, 0, 0), codes(-40, -40, -40, 0), codes(60, 10, -40, 0)},
                         Row{true, true, codes(150, 150, 150, 0), codes(-40, -40, -40, 0), codes(110, 110, 110, 0)}}) {
    SCOPED_TRACE(std::string(row.ab ? "AB " : "") + (row.cd ? "CD" : "") + " as dot products");
    const RegisterFile out = judged(dot_state(row.ab, row.cd), kCard, dot_registers()).registers;
    EXPECT_EQ(out[Register::primary], row.primary);
    EXPECT_EQ(out[Register::secondary], row.secondary);
    EXPECT_EQ(out[Register::spare1], row.spare1);
  }
}

TEST(GeneralCombiner, TheMuxTakesDotProducts) {
  for (const int select : {0, 200}) {
    CombinerState state = dot_state(true, true);
    state.general[0].rgb.out.mux_sum = true;
    RegisterFile r = dot_registers();
    r[Register::spare0][kAlpha] = static_cast<s9>(select);
    const int expected = select < 128 ? 150 : -40;
    EXPECT_EQ(judged(state, kCard, r).registers[Register::spare1], codes(expected, expected, expected, 0));
  }
}

TEST(GeneralCombiner, TheMuxReadsSpare0AlphaAsItEnteredTheStage) {
  CombinerState state = silent_state(2);
  // Stage 0 writes a new spare0 alpha and muxes by the old one; stage 1 muxes by the new one.
  state.general[0].alpha = move_alpha(Register::primary, Register::spare0);
  for (std::size_t i = 0; i < 2; ++i) {
    state.general[i].rgb =
        move_two(Register::texture0, Register::texture1, mux_to(i == 0 ? Register::spare1 : Register::secondary));
  }
  RegisterFile r = mixed_registers();
  r[Register::spare0][kAlpha] = 255;
  const RegisterFile after = judged(state, kCard, r).registers;
  EXPECT_EQ(after[Register::spare1], codes(220, 230, 240, -170)) << "255 picks CD";
  EXPECT_EQ(after[Register::secondary], codes(180, 190, 200, 80)) << "primary's 40 picks AB";
}

TEST(GeneralCombiner, TheAlphaPortionMuxesToo) {
  for (const int select : {127, 128}) {
    CombinerState state = silent_state(1);
    state.general[0].alpha = of_alpha(move_two(Register::texture0, Register::texture1, mux_to(Register::spare0)));
    RegisterFile r = mixed_registers();
    r[Register::spare0][kAlpha] = static_cast<s9>(select);
    EXPECT_EQ(judged(state, kCard, r).registers[Register::spare0][kAlpha], select == 127 ? 210 : 250);
  }
}

TEST(GeneralCombiner, PerStageConstantsAreTheStagesAndTheFinalCombinerUsesTheGlobalOnes) {
  CombinerState state = silent_state(2);
  state.constant0 = color_of(1, 2, 3, 4);
  state.constant1 = color_of(5, 6, 7, 8);
  state.general[0].constant0 = color_of(11, 12, 13, 14);
  state.general[1].constant1 = color_of(21, 22, 23, 24);
  state.general[0].rgb = move_rgb(Register::constant0, Register::spare0);
  state.general[0].alpha = move_alpha(Register::constant0, Register::spare0);
  state.general[1].rgb = move_rgb(Register::constant1, Register::spare1);
  state.general[1].alpha = move_alpha(Register::constant1, Register::spare1);
  state.final_combiner = final_of(Register::constant1);
  state.per_stage_constants = true;
  Fragment out = judged(state, profiles::nv2a, mixed_registers());
  EXPECT_EQ(out.registers[Register::spare0], codes(11, 12, 13, 14));
  EXPECT_EQ(out.registers[Register::spare1], codes(21, 22, 23, 24));
  EXPECT_EQ(out.color, codes(5, 6, 7, 8));
  state.per_stage_constants = false;
  out = judged(state, profiles::nv2a, mixed_registers());
  EXPECT_EQ(out.registers[Register::spare0], codes(1, 2, 3, 4));
  EXPECT_EQ(out.registers[Register::spare1], codes(5, 6, 7, 8));
  EXPECT_EQ(out.color, codes(5, 6, 7, 8));
}

TEST(GeneralCombiner, AllEightStagesRunInOrder) {
  // Each stage adds its own constant to spare0: 1 + 2 + … + 8.
  CombinerState state = silent_state(8);
  state.per_stage_constants = true;
  for (int i = 0; i < 8; ++i) {
    GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    stage.constant0 = color_of(i + 1, 0, 0, 0);
    stage.rgb = move_two(Register::spare0, Register::constant0, sum_to(Register::spare0));
    stage.rgb.a.mapping = i == 7 ? InputMapping::signed_negate : InputMapping::signed_identity;
  }
  EXPECT_EQ(judged(state, profiles::nv2a, RegisterFile{}).registers[Register::spare0], codes(-28 + 8, 0, 0, 0));
}

TEST(GeneralCombiner, ConstantsAreRoundedToBytes) {
  CombinerState state = silent_state(1);
  state.constant0 = {0.5F, 1.5F / 255.0F + 1e-6F, 1.5F / 255.0F - 1e-6F, 1.0F};
  state.constant1 = {-1.0F, 2.0F, 0.25F, 0.0F};
  state.final_combiner = final_of(Register::constant0);
  EXPECT_EQ(judged(state, kCard, RegisterFile{}).color, codes(128, 2, 1, 255));
  EXPECT_EQ(judged(state, profiles::geforce256_8bit, RegisterFile{}).color, codes(64, 1, 0, 127));
  state.final_combiner = final_of(Register::constant1);
  EXPECT_EQ(judged(state, kCard, RegisterFile{}).color, codes(0, 255, 64, 0));
}

// Rule 23: what is written in blue, with bias, scale and clamp, is written to the same register's alpha.
TEST(GeneralCombiner, BlueToAlphaOfEveryOutputAndOption) {
  const HardwareProfile& p = profiles::nv2a;
  for (const auto& [scale, bias] : kScaleBias) {
    for (int flags = 0; flags < 16; ++flags) {
      const bool ab = (flags & 1) != 0, cd = (flags & 2) != 0, ab_dot = (flags & 4) != 0, cd_dot = (flags & 8) != 0;
      const CombinerInput fog = rgb_of(Register::fog, InputMapping::signed_identity);
      const CombinerState state = rgb_stage({rgb_of(Register::primary, InputMapping::signed_identity),
                                             fog,
                                             rgb_of(Register::secondary, InputMapping::signed_identity),
                                             fog,
                                             {.ab = Register::spare0,
                                              .cd = Register::spare1,
                                              .sum = Register::texture2,
                                              .scale = scale,
                                              .bias = bias,
                                              .ab_dot_product = ab_dot,
                                              .cd_dot_product = cd_dot,
                                              .ab_blue_to_alpha = ab,
                                              .cd_blue_to_alpha = cd}});
      RegisterFile registers;
      registers[Register::primary] = codes(10, -20, 30, 40);
      registers[Register::secondary] = codes(-50, 160, -70, 80);
      registers[Register::fog] = codes(255, 100, 200, 0);
      for (const Register r : {Register::spare0, Register::spare1, Register::texture2})
        registers[r] = codes(1, 2, 3, 4);
      const RegisterFile after = judged(state, p, registers).registers;
      EXPECT_EQ(after[Register::spare0][kAlpha], ab ? after[Register::spare0][kBlue] : 4) << flags;
      EXPECT_EQ(after[Register::spare1][kAlpha], cd ? after[Register::spare1][kBlue] : 4) << flags;
      EXPECT_EQ(after[Register::texture2][kAlpha], 4) << "the sum's blue stays blue";
    }
  }
}

// The mux of the next stage sees the blue; that of the same stage does not (rule 12).
TEST(GeneralCombiner, BlueToAlphaComesAfterAllReads) {
  CombinerState state = silent_state(2);
  for (const std::size_t i : {0U, 1U}) {
    state.general[i].rgb = move_two(Register::primary, Register::secondary,
                                    {.ab = i == 0 ? Register::spare0 : Register::discard,
                                     .sum = i == 0 ? Register::spare1 : Register::texture3,
                                     .mux_sum = true,
                                     .ab_blue_to_alpha = i == 0});
  }
  RegisterFile registers;
  registers[Register::primary] = codes(1, 2, 200, 0);
  registers[Register::secondary] = codes(7, 8, 9, 0);
  const RegisterFile after = judged(state, profiles::nv2a, registers).registers;
  EXPECT_EQ(after[Register::spare1], codes(1, 2, 200, 0)) << "spare0's alpha was 0: AB";
  EXPECT_EQ(after[Register::texture3], codes(7, 8, 9, 0)) << "and is 200 then: CD";
}

// Whichever of its outputs it is.
TEST(GeneralCombiner, TheAlphaPortionHasTheLastWordOnBlueToAlpha) {
  for (Register PortionOutput::*const alpha_output : {&PortionOutput::ab, &PortionOutput::cd, &PortionOutput::sum}) {
    CombinerState state = rgb_stage(move_two(Register::primary, Register::primary,
                                             {.ab = Register::spare0,
                                              .cd = Register::spare1,
                                              .sum = Register::discard,
                                              .ab_blue_to_alpha = true,
                                              .cd_blue_to_alpha = true}));
    Portion& alpha = state.general[0].alpha;
    alpha = of_alpha(move_two(Register::primary, Register::primary, sum_to(Register::discard)));
    if (alpha_output != &PortionOutput::cd) alpha.d = kZeroAlpha;
    alpha.out.*alpha_output = Register::spare0;
    RegisterFile registers;
    registers[Register::primary] = codes(1, 2, 3, 40);
    const RegisterFile after = judged(state, profiles::nv2a, registers).registers;
    EXPECT_EQ(after[Register::spare0], codes(1, 2, 3, 40));
    EXPECT_EQ(after[Register::spare1], codes(1, 2, 3, 3));
  }
}

}  // namespace
}  // namespace ninebit::test
