// How programs compile to vector operations: what is folded, what is left out, and that nothing of it shows in a code.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

std::string compiled(const CombinerState& state, const HardwareProfile& profile = profiles::geforce2,
                     const BatchOutputs& outputs = {}) {
  return BatchProgram(compile(state, profile).value(), outputs).describe();
}

TEST(BatchProgram, TheArticlesProgramIsFourOperations) {
  const BatchOutputs alpha{.color = {false, false, false, true}};
  EXPECT_EQ(compiled(index_comparison(), profiles::geforce2, alpha),
            "t0 = clamp(4*max(primary_color.r, 0) + -4*max(texture0.r, 0), -255, 255)\n"
            "t1 = clamp(4*max(primary_color.g, 0) + -4*max(texture0.g, 0), -255, 255)\n"
            "t2 = clamp(4*max(primary_color.b, 0) + -4*max(texture0.b, 0), -255, 255)\n"
            "out.a = clamp(u16:truncate((t0*t0 + t1*t1 + t2*t2)*4 / 255), 0, 255)\n");
}

TEST(BatchProgram, ReadsWhatTheWantedOutputsNeed) {
  const Program program = compile(index_comparison(), profiles::geforce2).value();
  const BatchProgram alpha(program, {.color = {false, false, false, true}});
  const BatchProgram red(program, {.color = {true, false, false, false}});
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (int c = 0; c < 4; ++c) {
      const auto reg = static_cast<Register>(r);
      const bool compared = c != kAlpha && (reg == Register::primary || reg == Register::texture0);
      EXPECT_EQ(alpha.reads().contains(reg, c), compared) << name_of(reg) << c;
      EXPECT_FALSE(red.reads().contains(reg, c)) << "red is 0";
    }
  }
  EXPECT_EQ(red.describe(), "out.r = 0\n");
}

// One stage that leaves A·B of two inputs in spare0's red, which is wanted.
std::string product_of(const CombinerInput& a, const CombinerInput& b, Scale scale = Scale::none,
                       const HardwareProfile& profile = profiles::geforce2) {
  CombinerState state = rgb_stage({a, b, kZero, kZero, ab_to(Register::spare0, scale)});
  state.final_combiner = final_of(Register::spare0);
  return compiled(state, profile, {.color = {true, false, false, false}});
}

TEST(BatchProgram, TakesTheNarrowestOperation) {
  const CombinerInput positive = rgb_of(Register::primary), any = rgb_of(Register::fog, InputMapping::signed_identity);
  EXPECT_EQ(product_of(positive, kOne), "out.r = 1*max(primary_color.r, 0)\n");
  EXPECT_EQ(product_of(positive, kZero), "out.r = 0\n");
  EXPECT_EQ(product_of(positive, kMinusOne), "out.r = 0\n") << "what is never positive is black";
  EXPECT_EQ(product_of(any, kOne), "out.r = 1*max(fog.r, 0)\n");
  EXPECT_EQ(product_of(positive, positive, Scale::by_four),
            "out.r = clamp(u16:truncate((max(primary_color.r, 0)*max(primary_color.r, 0))*4 / 255), 0, 255)\n");
  EXPECT_EQ(product_of(any, any), "out.r = u16:truncate((fog.r*fog.r) / 255)\n") << "a square is not negative";
  EXPECT_EQ(product_of(positive, any),
            "t0 = clamp(s16:truncate((max(primary_color.r, 0)*fog.r) / 255), 0, 255)\nout.r = 1*t0\n");
  EXPECT_EQ(product_of(positive, any, Scale::by_one_half),
            "t0 = clamp(s32:truncate((fog.r*max(primary_color.r, 0)) / 510), 0, 127)\nout.r = 1*t0\n");
  EXPECT_EQ(product_of(positive, any, Scale::none, profiles::geforce256_8bit),
            "t0 = clamp(s32:truncate((fog.r*max(primary_color.r, 0)) / 127), 0, 127)\nout.r = 1*t0\n");
}

TEST(BatchProgram, AMuxByTheLowestBitIsOneChoice) {
  HardwareProfile symmetric = profiles::nv2a;  // whose registers are copied without a clamp
  symmetric.lowest.value = symmetric.lowest_output;
  CombinerState state = silent_state(2);
  state.mux_by_lowest_bit = true;
  state.general[1].rgb = {rgb_of(Register::primary, InputMapping::signed_identity), kOne,
                          rgb_of(Register::fog, InputMapping::signed_identity), kOne, mux_to(Register::spare1)};
  state.final_combiner = final_of(Register::spare1);
  const BatchOutputs red{.color = {true, false, false, false}};
  EXPECT_EQ(compiled(state, symmetric, red),
            "t0 = (odd(max(spare0.a, 0)) ? fog.r : primary_color.r)\nout.r = 1*max(t0, 0)\n");
  // Where spare0's alpha can be one code only, nothing is chosen.
  state.general[0].alpha = {alpha_of(Register::constant0, InputMapping::signed_negate), kOneAlpha, kZeroAlpha,
                            kZeroAlpha, ab_to(Register::spare0)};
  for (const int code : {0, 128, 129}) {
    state.constant0 = color_of(0, 0, 0, code);
    EXPECT_EQ(compiled(state, symmetric, red), "out.r = 1*max(primary_color.r, 0)\n") << -code;
  }
  state.general[0].alpha.a.mapping = InputMapping::signed_identity;
  EXPECT_EQ(compiled(state, symmetric, red), "out.r = 1*max(fog.r, 0)\n") << 129;
}

TEST(BatchProgram, BlueToAlphaIsNoOperation) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary), rgb_of(Register::fog), kZero, kZero, ab_to(Register::spare1)});
  state.general[0].rgb.out.ab_blue_to_alpha = true;
  state.final_combiner = final_of(Register::spare1);
  const BatchOutputs blue{.color = {false, false, true, false}}, alpha{.color = {false, false, false, true}};
  const std::string one = compiled(state, profiles::nv2a, blue), other = compiled(state, profiles::nv2a, alpha);
  EXPECT_EQ(one.substr(0, 8), "out.b = ");
  EXPECT_EQ(other.substr(0, 8), "out.a = ");
  EXPECT_EQ(one.substr(8), other.substr(8));
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 1);
}

TEST(BatchProgram, EqualOperationsRunOnce) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary), rgb_of(Register::secondary), kZero, kZero, ab_to(Register::spare0)});
  state.general[0].rgb.out.ab_dot_product = true;
  state.final_combiner = final_of(Register::spare0);
  EXPECT_EQ(compiled(state, profiles::geforce2, {.color = {true, true, true, false}}),
            "out.r = clamp(u16:truncate((max(primary_color.r, 0)*max(secondary_color.r, 0) + "
            "max(primary_color.g, 0)*max(secondary_color.g, 0) + "
            "max(primary_color.b, 0)*max(secondary_color.b, 0)) / 255), 0, 255)\n"
            "out.g = out.r\nout.b = out.r\n");
}

// Terms of one register are joined where they are alike; a value and its positive part are not.
TEST(BatchProgram, SumsOfTermsOfOneRegister) {
  const HardwareProfile& profile = profiles::geforce2;
  std::vector<RegisterFile> fragments;
  for (int code = -255; code <= 255; ++code) fragments.emplace_back()[Register::primary] = codes(code, code, code, 0);
  for (const InputMapping mapping : kInputMappings) {
    for (const CombinerInput& sign : {kOne, kMinusOne}) {
      judged(rgb_stage({rgb_of(Register::primary, InputMapping::signed_identity), kOne,
                        rgb_of(Register::primary, mapping), sign, sum_to(Register::spare0)}),
             profile, fragments);
    }
  }
  CombinerState state =
      rgb_stage({rgb_of(Register::primary), kOne, rgb_of(Register::primary), kMinusOne, sum_to(Register::spare0)});
  state.final_combiner = final_of(Register::spare0);
  EXPECT_EQ(compiled(state, profile, {.color = {true, false, false, false}}), "out.r = 0\n");
}

// Registers that exchange their contents, and colours that are registers: nothing is overwritten before it is read.
TEST(BatchProgram, RegistersThatChangePlaces) {
  CombinerState state = rgb_stage({rgb_of(Register::spare0, InputMapping::signed_identity),
                                   kOne,
                                   rgb_of(Register::spare1, InputMapping::signed_identity),
                                   kOne,
                                   {.ab = Register::spare1, .cd = Register::spare0, .sum = Register::discard}});
  state.final_combiner = final_of(Register::spare0);
  RegisterFile registers;
  registers[Register::spare0] = codes(-7, 8, 9, 10);
  registers[Register::spare1] = codes(11, 12, -13, 14);
  const Fragment after = judged(state, profiles::geforce2, registers);
  EXPECT_EQ(after.registers[Register::spare0], codes(11, 12, -13, 10));
  EXPECT_EQ(after.registers[Register::spare1], codes(-7, 8, 9, 14));
  EXPECT_EQ(after.color, codes(11, 12, 0, 10));
}

// Stages 0 to 3 map each texture in four ways, stages 4 to 7 multiply the same mapped values otherwise: all of them
// wait at once, more than the first cache would hold with 512 lanes.
TEST(BatchProgram, ManyTemporaries) {
  const HardwareProfile& profile = profiles::nv2a;
  CombinerState state = silent_state(8);
  const std::array<Register, 8> to{Register::primary,  Register::secondary, Register::spare0,   Register::spare1,
                                   Register::texture0, Register::texture1,  Register::texture2, Register::texture3};
  for (std::size_t i = 0; i < 8; ++i) {
    for (Portion* const portion : {&state.general[i].rgb, &state.general[i].alpha}) {
      const ComponentUsage usage = portion == &state.general[i].rgb ? ComponentUsage::rgb : ComponentUsage::alpha;
      const auto texture = [&](InputMapping mapping) { return CombinerInput{to[4 + i % 4], mapping, usage}; };
      portion->a = texture(InputMapping::expand_normal);
      portion->b = texture(i < 4 ? InputMapping::half_bias_normal : InputMapping::half_bias_negate);
      portion->c = texture(InputMapping::expand_negate);
      portion->d = texture(i < 4 ? InputMapping::half_bias_negate : InputMapping::half_bias_normal);
      portion->out.sum = to[i];
    }
  }
  state.final_combiner = final_of(Register::spare0);
  const Program program = compile(state, profile).value();
  EXPECT_NE(BatchProgram(program, {.registers = true}).describe().find("t64 = "), std::string::npos)
      << "64 of 512 lanes are 64 KiB";
  Random random(0x7E3905);
  std::vector<RegisterFile> fragments(kBatchSize);
  for (RegisterFile& registers : fragments) registers = random_registers(random, profile);
  judged(state, profile, fragments);
}

TEST(BatchProgram, ConstantsThatVaryComeFromTheBatch) {
  Lanes lanes;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 40 : 400); ++index) {
    Random random(0xC0457, index);
    const HardwareProfile profile = random_profile(random);
    Program program = normalize(random_state(random, profile), profile);
    ComponentSet varying;
    for (const Register reg : {Register::constant0, Register::constant1}) {
      for (int c = 0; c < 4; ++c) {
        if (random.one_in(2)) varying.add(reg, c);
      }
    }
    constexpr std::size_t kCount = 40;
    std::vector<RegisterFile> initial(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      initial[i] = random_registers(random, profile);
      put(*lanes.registers, i, initial[i]);
    }
    BatchProgram(program, {}, varying).run(*lanes.registers, kCount, *lanes.out);
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto replace = [&](Register reg, Rgba9& constant) {
        for (int c = 0; c < 4; ++c) {
          const auto at = static_cast<std::size_t>(c);
          if (varying.contains(reg, c)) constant[at] = initial[i][reg][at];
        }
      };
      for (ProgramStage& stage : program.general) {
        replace(Register::constant0, stage.constant0);
        replace(Register::constant1, stage.constant1);
      }
      replace(Register::constant0, program.constant0);
      replace(Register::constant1, program.constant1);
      ASSERT_EQ(lane_of(*lanes.out, i), evaluate(program, initial[i])) << index << ' ' << i;
    }
  }
}

TEST(BatchProgram, RealNumbersHaveNoOperations) {
  const BatchProgram program(normalize(CombinerState{}, profiles::ideal));
  EXPECT_EQ(program.describe(), "");
  EXPECT_TRUE(program.reads().contains(Register::primary, kRed));
  EXPECT_FALSE(program.reads().contains(Register::constant0, kRed));
}

}  // namespace
}  // namespace ninebit::test
