// Exact and float arithmetic against the real-number oracles, number by number and step by step. Whole programs, code
// by code, run in differential_test.cpp.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/oracle/real_oracle.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kRealSeed = 0x5EA1;

// Every number that evaluate_real reports of the registers and the colour is the double nearest to the oracle's.
TEST(EvaluateReal, ReportsTheNearestDoubles) {
  std::uint64_t inexact = 0, checked = 0;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 40U : 400U); ++index) {
    Random random(kRealSeed + 1, index);
    const HardwareProfile profile = random_real_profile(random, profiles::ideal);
    const CombinerState state = random_state(random, profile);
    const Program program = normalize(state, profile);
    for (int i = 0; i < 4; ++i) {
      const RegisterFile initial = random_registers(random, profile);
      const oracle::ExactOutcome expected = oracle::run_exact(state, profile, to_oracle(initial));
      const RealEvaluation actual = evaluate_real(program, initial);
      for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_TRUE(oracle::is_nearest_double(expected.color[c], actual.color[c])) << index << ' ' << actual.color[c];
        for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
          const double reported = actual.registers().value[r][c];
          ASSERT_TRUE(oracle::is_nearest_double(expected.registers[r][c], reported))
              << index << ' ' << reported << '\n'
              << describe(state, profile) << describe(initial);
          inexact += reported != static_cast<double>(static_cast<float>(reported)) ? 1U : 0U;
          ++checked;
        }
      }
      const EvaluatedFragment whole = evaluate_fragment(program, initial);
      ASSERT_EQ(actual.codes.registers, whole.registers);
      ASSERT_EQ(actual.codes.color, whole.color);
    }
  }
  EXPECT_GT(inexact * 4, checked);
}

TEST(EvaluateReal, FloatsAreTheOraclesBitForBit) {
  for (std::uint64_t index = 0; index < (kSlowBuild ? 200U : 4000U); ++index) {
    Random random(kRealSeed + 2, index);
    const HardwareProfile profile = random_real_profile(random, profiles::float_shader);
    const CombinerState state = random_state(random, profile);
    const Program program = normalize(state, profile);
    const RegisterFile initial = random_registers(random, profile);
    const oracle::FloatOutcome expected = oracle::run_float(state, profile, to_oracle(initial));
    const RealEvaluation actual = evaluate_real(program, initial, Arithmetic::float32);
    for (std::size_t c = 0; c < 4; ++c) {
      ASSERT_EQ(static_cast<double>(expected.color[c]), actual.color[c]) << index;
      for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
        ASSERT_EQ(static_cast<double>(expected.registers[r][c]), actual.registers().value[r][c]) << index;
      }
    }
  }
}

// Every step of one stage, with numbers that can be followed by hand.
TEST(EvaluateReal, StepsOfOneStage) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary),
                 rgb_of(Register::secondary, InputMapping::expand_normal),
                 kOne,
                 rgb_of(Register::texture0, InputMapping::half_bias_normal),
                 {.ab = Register::spare1, .scale = Scale::by_two, .bias = Bias::by_negative_one_half}});
  state.general[0].alpha = {alpha_of(Register::primary), kOneAlpha, alpha_of(Register::secondary), kOneAlpha,
                            mux_to(Register::spare1)};
  RegisterFile registers;
  registers[Register::primary] = codes(51, 102, 255, 100);
  registers[Register::secondary] = codes(255, 51, 204, 200);
  registers[Register::texture0] = codes(51, 255, 0, 0);
  registers[Register::spare0] = codes(0, 0, 0, 128);
  const RealEvaluation e = evaluate_real(normalize(state, profiles::geforce2), registers);

  ASSERT_EQ(e.stage.size(), 1U);
  EXPECT_EQ(e.before[Register::primary], (RealColor{0.2, 0.4, 1.0, 100.0 / 255.0}));
  EXPECT_TRUE(e.stage[0].takes_cd) << "128/255 is above one half";
  const RealChannel& red = e.stage[0].rgb[0];
  EXPECT_EQ(red.input, (std::array{0.2, 1.0, 1.0, -0.3}));
  EXPECT_EQ(red.ab.wide, 0.2);
  EXPECT_EQ(red.ab.scaled, -0.6);
  EXPECT_EQ(red.ab.written, -0.6);
  EXPECT_EQ(red.cd.wide, -0.3);
  EXPECT_EQ(red.cd.scaled, 0.0) << "discarded";
  EXPECT_EQ(red.third.wide, -0.1);
  EXPECT_EQ(red.third.scaled, -1.2);
  EXPECT_EQ(red.third.written, -1.0);
  const RealChannel& green = e.stage[0].rgb[1];
  EXPECT_EQ(green.input, (std::array{0.4, -0.6, 1.0, 0.5}));
  EXPECT_EQ(green.ab.wide, -0.24);
  EXPECT_EQ(green.third.wide, 0.26);
  EXPECT_EQ(green.third.written, -0.48);
  EXPECT_EQ(e.stage[0].alpha.third.wide, 200.0 / 255.0);
  EXPECT_EQ(e.stage[0].after[Register::spare0], (RealColor{-1.0, -0.48, -0.8, 128.0 / 255.0}));
  EXPECT_EQ(e.registers()[Register::spare1][kAlpha], 200.0 / 255.0);
  // The exact value is rounded to a code only here: -0.48 · 255 = -122.4.
  EXPECT_EQ(e.codes.registers[Register::spare0], codes(-255, -122, -204, 128));
  EXPECT_EQ(e.codes.color, codes(0, 0, 0, 128));
}

TEST(EvaluateReal, StepsOfTheFinalCombiner) {
  CombinerState state = silent_state(1);
  state.color_sum_clamp = false;
  FinalCombiner& f = state.final_combiner;
  f.a = rgb_of(Register::primary);
  f.b = rgb_of(Register::spare0_plus_secondary);
  f.c = rgb_of(Register::e_times_f);
  f.d = rgb_of(Register::texture0);
  f.e = f.f = rgb_of(Register::texture1);
  f.g = blue_of(Register::texture1, InputMapping::unsigned_invert);
  RegisterFile registers;
  registers[Register::primary] = codes(51, 0, 255, 0);
  registers[Register::spare0] = codes(255, -9, 204, 0);
  registers[Register::secondary] = codes(255, 51, 255, 0);
  registers[Register::texture0] = codes(0, 51, 0, 0);
  registers[Register::texture1] = codes(51, 102, 153, 0);
  const RealEvaluation e = evaluate_real(normalize(state, profiles::ideal), registers);
  const RealFinal& last = e.final_combiner;
  EXPECT_EQ(last.color_sum, (RealColor{2.0, 0.2, 1.8, 0.0}));
  EXPECT_EQ(last.e_times_f, (RealColor{0.04, 0.16, 0.36, 0.0}));
  EXPECT_EQ(last.input[0], (RealColor{0.2, 0.0, 1.0, 0.0}));
  EXPECT_EQ(last.input[1], (RealColor{2.0, 0.2, 1.8, 0.0}));
  EXPECT_EQ(last.g, 0.4);
  EXPECT_EQ(last.unclamped, (RealColor{0.432, 0.36, 1.8, 0.4}));
  EXPECT_EQ(e.color, (RealColor{0.432, 0.36, 1.0, 0.4}));
  EXPECT_EQ(e.codes.color, codes(110, 92, 255, 102)) << "110.16, 91.8";
}

// Halves of a code go up, decided exactly: 1/2 of every odd code.
TEST(EvaluateReal, HalvesGoUp) {
  const CombinerState state = rgb_stage({rgb_of(Register::primary, InputMapping::signed_identity), kOne, kZero, kZero,
                                         ab_to(Register::spare0, Scale::by_one_half)});
  std::vector<RegisterFile> fragments;
  for (int code = -255; code <= 255; ++code) fragments.emplace_back()[Register::primary] = codes(code, code, code, 0);
  int code = -255;
  for (const Fragment& exact : judged(state, profiles::ideal, fragments)) {
    const int expected = (code + 1 + 1000) / 2 - 500;
    EXPECT_EQ(exact.registers[Register::spare0], codes(expected, expected, expected, 0)) << code;
    ++code;
  }
}

// Numbers that no double tells from a half of a code: 1/510 -+ 2 / 255^9 or so, by eight stages of products.
TEST(EvaluateReal, DecidesAHairsbreadthFromAHalf) {
  for (const int sign : {-1, 1}) {
    CombinerState state = silent_state(8);
    // spare1 = 1/2 of (1/255), kept; spare0 = (1/255)^8.
    for (int i = 0; i < 7; ++i) {
      state.general[static_cast<std::size_t>(i)].rgb = {rgb_of(Register::spare0), rgb_of(Register::primary),
                                                        rgb_of(Register::texture0), kOne, ab_to(Register::spare0)};
    }
    state.general[0].rgb.out.cd = Register::spare1;
    state.general[7].rgb = {rgb_of(Register::spare1), kOne, rgb_of(Register::spare0), sign > 0 ? kOne : kMinusOne,
                            sum_to(Register::spare0, Scale::by_one_half)};
    state.final_combiner = final_of(Register::spare0);
    RegisterFile registers;
    registers[Register::spare0] = registers[Register::primary] = registers[Register::texture0] = codes(1, 1, 1, 0);
    const Fragment f = judged(state, profiles::ideal, registers);
    EXPECT_EQ(f.color, sign > 0 ? codes(1, 1, 1, 0) : codes(0, 0, 0, 0));
    EXPECT_EQ(evaluate_real(normalize(state, profiles::ideal), registers).color[kRed] > 1.0 / 510.0, false)
        << "a double cannot tell";
  }
}

// Powers of every code, by stages that square and then stages that multiply once more. Around the sixteenth the
// fractions outgrow the whole numbers of the fast way, in numerator, denominator or both.
TEST(EvaluateReal, PowersOfEveryCode) {
  int fractions = 0;
  for (int squares = 0; squares <= 8; ++squares) {
    for (int more = 0; squares + more <= 8; more += 2) {
      if (squares + more == 0) continue;
      CombinerState state = silent_state(squares + more);
      for (int i = 0; i < squares + more; ++i) {
        state.general[static_cast<std::size_t>(i)].rgb = {rgb_of(Register::spare0),
                                                          rgb_of(i < squares ? Register::spare0 : Register::primary),
                                                          kZero, kZero, ab_to(Register::spare0)};
      }
      state.final_combiner = final_of(Register::spare0);
      std::vector<RegisterFile> fragments;
      for (int code = 0; code <= 255; code += kSlowBuild ? 15 : 1) {
        RegisterFile& registers = fragments.emplace_back();
        registers[Register::spare0] = registers[Register::primary] = codes(code, 255 - code, code / 2 + 128, 0);
      }
      for (const Fragment& f : judged(state, profiles::ideal, fragments)) {
        fractions += f.color[0] != 0 && f.color[0] != 255 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(fractions, kSlowBuild ? 50 : 750);
}

TEST(EvaluateReal, LanesPastTheCountAreLeftAlone) {
  const BatchProgram program(normalize(CombinerState{}, profiles::ideal), {.registers = true});
  auto batch = std::make_unique<RegisterBatch>();
  auto out = std::make_unique<OutputBatch>();
  std::memset(static_cast<void*>(batch.get()), 0x11, sizeof(RegisterBatch));
  const RegisterBatch before = *batch;
  program.run(*batch, 0, *out);
  EXPECT_EQ(batch->plane, before.plane);
}

TEST(EvaluateReal, TheTwoHalvesRoundInBetween) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary), kOne, kZero, kZero, ab_to(Register::spare0, Scale::by_one_half)});
  state.final_combiner = final_of(Register::spare0);
  state.final_combiner.d = {};
  state.final_combiner.a = state.final_combiner.b = rgb_of(Register::spare0);
  RegisterFile registers;
  registers[Register::primary] = codes(255, 255, 255, 0);
  for (const HardwareProfile& p : {profiles::ideal, profiles::float_shader}) {
    const Program program = normalize(state, p);
    EXPECT_EQ(evaluate(program, registers), codes(64, 64, 64, 0)) << "255 / 4 = 63.75";
    RegisterFile after = registers;
    evaluate_general(program, after);
    EXPECT_EQ(after[Register::spare0], codes(128, 128, 128, 0));
    EXPECT_EQ(evaluate_final(program, after), codes(64, 64, 64, 0)) << "128 · 128 / 255 = 64.25";
  }
}

}  // namespace
}  // namespace ninebit::test
