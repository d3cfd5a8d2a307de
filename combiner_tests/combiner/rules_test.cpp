// The numbered rules of docs/numerics.md, one test each, by every path. Rules 15 and 17 to 21 are not the combiners'.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "ninebit/combiner/initial_registers.h"

namespace ninebit::test {
namespace {

// Primary through A·1 of stage 0 with this output option, to spare1, in both portions (alpha likewise).
CombinerState option_state(Scale scale, Bias bias, InputMapping mapping = InputMapping::signed_identity) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary, mapping), kOne, kZero, kZero, ab_to(Register::spare1, scale, bias)});
  state.general[0].alpha = of_alpha(state.general[0].rgb);
  return state;
}

RegisterFile with(Register r, const Rgba9& value) {
  RegisterFile registers;
  registers[r] = value;
  return registers;
}

// Fragments whose components are all one value.
std::vector<RegisterFile> grey(int low, int high) {
  std::vector<RegisterFile> fragments;
  for (int v = low; v <= high; ++v) fragments.push_back(with(Register::primary, codes(v, v, v, v)));
  return fragments;
}

// The option's results for values in [low, high]; all four components of each must agree.
std::vector<int> options_of(const HardwareProfile& profile, Scale scale, Bias bias, int low, int high) {
  std::vector<int> results;
  for (const Fragment& fragment : judged(option_state(scale, bias), profile, grey(low, high))) {
    const Rgba9& out = fragment.registers[Register::spare1];
    EXPECT_EQ(out, codes(out[0], out[0], out[0], out[0]));
    results.push_back(out[0]);
  }
  return results;
}

int option_of(const HardwareProfile& profile, Scale scale, Bias bias, int value) {
  return options_of(profile, scale, bias, value, value)[0];
}

TEST(Rule, R1_AByteTimesOneIsItself) {
  CombinerState state = option_state(Scale::none, Bias::none);
  state.final_combiner = final_of(Register::spare1);
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::geforce2_early_truncation, profiles::nv2a}) {
    std::vector<RegisterFile> fragments;
    for (int byte = 0; byte < 256; ++byte) {
      const auto b = static_cast<std::uint8_t>(byte);
      fragments.push_back(initial_registers(profile, {.primary = {b, b, b, b}}));
    }
    int byte = 0;
    for (const Fragment& out : judged(state, profile, fragments)) {
      ASSERT_EQ(out.color, codes(byte, byte, byte, byte)) << profile.name;
      ++byte;
    }
  }
}

TEST(Rule, R2_InvertIs255MinusThePositivePart) {
  CombinerState state = option_state(Scale::none, Bias::none, InputMapping::unsigned_invert);
  state.final_combiner.d = rgb_of(Register::primary, InputMapping::unsigned_invert);
  state.final_combiner.g = alpha_of(Register::primary, InputMapping::unsigned_invert);
  int v = -255;
  for (const Fragment& out : judged(state, profiles::nv2a, grey(-255, 255))) {
    const int expected = 255 - std::max(v++, 0);
    ASSERT_EQ(out.registers[Register::spare1], codes(expected, expected, expected, expected));
    ASSERT_EQ(out.color, codes(expected, expected, expected, expected));
  }
}

TEST(Rule, R3_BiasComesBeforeScale) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    int v = -255;
    for (const int option : options_of(profile, Scale::by_two, Bias::by_negative_one_half, -255, 255)) {
      ASSERT_EQ(option, std::clamp((v - 128) * 2, -255, 255)) << v;
      ++v;
    }
    EXPECT_EQ(option_of(profile, Scale::by_two, Bias::by_negative_one_half, 25), -206) << "not 2 * 25 - 128";
  }
}

TEST(Rule, R4_OneHalfIs128) {
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    EXPECT_EQ(option_of(profile, Scale::none, Bias::by_negative_one_half, 255), 127);
    EXPECT_EQ(option_of(profile, Scale::by_two, Bias::by_negative_one_half, 255), 254);
    EXPECT_EQ(option_of(profile, Scale::none, Bias::by_negative_one_half, 0), -128);
    EXPECT_EQ(option_of(profile, Scale::none, Bias::by_negative_one_half, 128), 0);
  }
  EXPECT_EQ(option_of(profiles::geforce256_8bit, Scale::none, Bias::by_negative_one_half, 127), 63);
}

TEST(Rule, R5_OneHalfOfAValue) {
  const std::vector<std::array<int, 3>> points{{25, 13, 12},    {63, 32, 31},    {255, 128, 127},   {1, 1, 0},
                                               {2, 1, 1},       {0, 0, 0},       {-1, 0, 0},        {-2, -1, -1},
                                               {-25, -12, -12}, {-63, -31, -31}, {-255, -127, -127}};
  for (const auto& [value, nv2a, geforce2] : points) {
    EXPECT_EQ(option_of(profiles::nv2a, Scale::by_one_half, Bias::none, value), nv2a) << value;
    EXPECT_EQ(option_of(profiles::geforce2, Scale::by_one_half, Bias::none, value), geforce2) << value;
    EXPECT_EQ(option_of(profiles::geforce2_early_truncation, Scale::by_one_half, Bias::none, value), geforce2);
  }
}

TEST(Rule, R6_TwiceAndFourTimesAreExactAndSaturate) {
  for (const HardwareProfile& profile : integer_profiles()) {
    for (const auto& [scale, factor] : {std::pair{Scale::by_two, 2}, {Scale::by_four, 4}}) {
      int v = profile.lowest;
      for (const int option : options_of(profile, scale, Bias::none, profile.lowest, profile.one)) {
        ASSERT_EQ(option, std::clamp(factor * v, profile.lowest_output.value, profile.one.value)) << v;
        ++v;
      }
    }
  }
  EXPECT_EQ(option_of(profiles::nv2a, Scale::by_two, Bias::none, 25), 50);
  EXPECT_EQ(option_of(profiles::nv2a, Scale::by_four, Bias::none, 63), 252);
}

// primary² with a scale.
int square_of(const HardwareProfile& profile, Scale scale, int value) {
  const CombinerInput primary = rgb_of(Register::primary, InputMapping::signed_identity);
  const CombinerState state = rgb_stage({primary, primary, kZero, kZero, ab_to(Register::spare1, scale)});
  return judged(state, profile, with(Register::primary, codes(value, 0, 0, 0))).registers[Register::spare1][kRed];
}

TEST(Rule, R7_ScalingComesBeforeTheLowBitsAreDropped) {
  EXPECT_EQ(square_of(profiles::geforce2, Scale::by_four, 8), 1) << "4 * 64 / 255 = 256 / 255";
  EXPECT_EQ(square_of(profiles::geforce2_early_truncation, Scale::by_four, 8), 0) << "64 / 255 first";
  EXPECT_EQ(square_of(profiles::geforce2, Scale::by_two, 8), 0);
  EXPECT_EQ(square_of(profiles::geforce2_early_truncation, Scale::by_four, 16), 4);
  EXPECT_EQ(square_of(profiles::geforce2_early_truncation, Scale::by_four, 22), 4) << "484 / 255 = 1.9";
  EXPECT_EQ(square_of(profiles::geforce2, Scale::by_four, 22), 7) << "1936 / 255 = 7.6";
}

TEST(Rule, R8_TheGeforce2Truncates) {
  EXPECT_EQ(square_of(profiles::geforce2, Scale::none, 15), 0) << "225 / 255";
  EXPECT_EQ(square_of(profiles::geforce2, Scale::none, 16), 1) << "256 / 255";
  EXPECT_EQ(square_of(profiles::nv2a, Scale::none, 11), 0) << "121 / 255";
  EXPECT_EQ(square_of(profiles::nv2a, Scale::none, 12), 1) << "144 / 255 is nearer to 1";
  const CombinerState state =
      rgb_stage({rgb_of(Register::primary, InputMapping::signed_identity),
                 rgb_of(Register::secondary, InputMapping::signed_identity), kZero, kZero, ab_to(Register::spare1)});
  RegisterFile registers = with(Register::primary, codes(-2, 2, -2, 0));
  registers[Register::secondary] = codes(127, 127, 128, 0);
  EXPECT_EQ(judged(state, profiles::geforce2, registers).registers[Register::spare1], codes(0, 0, -1, 0));
  EXPECT_EQ(judged(state, profiles::nv2a, registers).registers[Register::spare1], codes(-1, 1, -1, 0));
}

TEST(Rule, R9_TheFinalCombinerRoundsToNearest) {
  CombinerState state = silent_state(1);
  state.final_combiner.a = rgb_of(Register::primary);
  state.final_combiner.b = rgb_of(Register::secondary);
  state.final_combiner.c = rgb_of(Register::texture0);
  RegisterFile registers = with(Register::primary, codes(127, 2, 51, 0));
  registers[Register::secondary] = codes(1, 64, 166, 0);
  registers[Register::texture0] = codes(1, 0, 0, 0);
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    // 255 / 255; 128 / 255 = 0.502, truncated 0; 8466 / 255 = 33.2.
    EXPECT_EQ(judged(state, profile, registers).color, codes(1, 1, 33, 0));
  }
}

TEST(Rule, R10_ETimesF) {
  CombinerState state = silent_state(1);
  state.final_combiner.d = rgb_of(Register::e_times_f);
  state.final_combiner.e = rgb_of(Register::primary);
  state.final_combiner.f = rgb_of(Register::secondary);
  RegisterFile registers = with(Register::primary, codes(255, 191, 127, 0));
  registers[Register::secondary] = codes(127, 127, 127, 0);
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    EXPECT_EQ(judged(state, profile, registers).color, codes(127, 95, 63, 0));
  }
}

TEST(Rule, R11_TheMuxTakesCdFromOneHalfOn) {
  const CombinerState state =
      rgb_stage({rgb_of(Register::primary), kOne, rgb_of(Register::secondary), kOne, mux_to(Register::texture0)});
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    for (const auto& [alpha, picks_cd] : std::vector<std::pair<int, bool>>{{0x00, false},
                                                                           {0x7F, false},
                                                                           {0x80, true},
                                                                           {0x81, true},
                                                                           {0x82, true},
                                                                           {0xFF, true},
                                                                           {-1, false},
                                                                           {-128, false},
                                                                           {-255, false}}) {
      RegisterFile registers = with(Register::primary, codes(255, 0, 0, 0));
      registers[Register::secondary] = codes(0, 0, 255, 0);
      registers[Register::spare0] = codes(0, 0, 0, alpha);
      const Rgba9 expected = picks_cd ? codes(0, 0, 255, 0) : codes(255, 0, 0, 0);
      EXPECT_EQ(judged(state, profile, registers).registers[Register::texture0], expected) << alpha;
    }
  }
}

TEST(Rule, R12_AStageReadsAllBeforeItWrites) {
  // Red, green and blue swap spare0 and spare1; alpha takes the old blues.
  CombinerState state = rgb_stage({rgb_of(Register::spare0),
                                   kOne,
                                   rgb_of(Register::spare1),
                                   kOne,
                                   {.ab = Register::spare1, .cd = Register::spare0, .sum = Register::discard}});
  state.general[0].alpha = {blue_of(Register::spare0),
                            kOneAlpha,
                            blue_of(Register::spare1),
                            kOneAlpha,
                            {.ab = Register::spare0, .cd = Register::spare1, .sum = Register::discard}};
  for (const HardwareProfile& profile : integer_profiles()) {
    RegisterFile registers = with(Register::spare0, codes(1, 2, 3, 100));
    registers[Register::spare1] = codes(11, 12, 13, 101);
    const RegisterFile after = judged(state, profile, registers).registers;
    EXPECT_EQ(after[Register::spare0], codes(11, 12, 13, 3));
    EXPECT_EQ(after[Register::spare1], codes(1, 2, 3, 13));
  }
}

TEST(Rule, R13_TheColorSumReaches510WithoutTheClamp) {
  CombinerState state = silent_state(1);
  state.constant0 = color_of(127, 127, 127, 0);
  state.final_combiner.a = rgb_of(Register::constant0);
  state.final_combiner.b = rgb_of(Register::spare0_plus_secondary);
  RegisterFile registers = with(Register::spare0, codes(255, 200, -50, 0));
  registers[Register::secondary] = codes(255, 100, 100, 0);
  for (const HardwareProfile& profile : {profiles::geforce2, profiles::nv2a}) {
    state.color_sum_clamp = false;
    EXPECT_EQ(judged(state, profile, registers).color, codes(254, 149, 50, 0));
    state.color_sum_clamp = true;
    EXPECT_EQ(judged(state, profile, registers).color, codes(127, 127, 50, 0));
  }
  // The inverse of a sum above one is zero, not negative: it takes nothing from A·B.
  state.color_sum_clamp = false;
  state.final_combiner = final_of(Register::zero);
  state.final_combiner.a = kOne;
  state.final_combiner.b = rgb_of(Register::texture0);
  state.final_combiner.d = rgb_of(Register::spare0_plus_secondary, InputMapping::unsigned_invert);
  registers[Register::texture0] = codes(10, 10, 10, 0);
  EXPECT_EQ(judged(state, profiles::nv2a, registers).color, codes(10, 10, 165, 0));
}

TEST(Rule, R14_TheFinalCombinerClampsItsInputsAndItsOutput) {
  CombinerState state = silent_state(1);
  state.final_combiner = final_of(Register::primary);
  for (const HardwareProfile& profile : integer_profiles()) {
    const int one = profile.one;
    EXPECT_EQ(judged(state, profile, with(Register::primary, codes(-1, profile.lowest, 5, -7))).color,
              codes(0, 0, 5, 0));
    // A·B + (1 - A)·C of ones is one; D adds to it.
    CombinerState sum = state;
    sum.final_combiner.b = sum.final_combiner.c = rgb_of(Register::secondary);
    RegisterFile registers = with(Register::primary, codes(1, 0, one, one));
    registers[Register::secondary] = codes(one, one - 3, 9, 0);
    EXPECT_EQ(judged(sum, profile, registers).color, codes(one, one - 3, one, one));
  }
}

TEST(Rule, R16_AnUnboundTextureReadsBlackWithAlphaOne) {
  for (const HardwareProfile& profile : integer_profiles()) {
    const RegisterFile registers = initial_registers(profile, {});
    for (int unit = 0; unit < 4; ++unit) {
      EXPECT_EQ(registers[texture_register(unit)], codes(0, 0, 0, profile.one));
    }
  }
}

}  // namespace
}  // namespace ninebit::test
