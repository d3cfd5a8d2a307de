// compile and normalize: equal programs for states that differ in what nothing uses, and only for those.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

// Both products to registers of their own, nothing else.
CombinerState products_state() {
  CombinerState state = silent_state(2);
  state.general[0].rgb = {rgb_of(Register::primary), rgb_of(Register::secondary), rgb_of(Register::texture0),
                          rgb_of(Register::texture1), ab_to(Register::spare0)};
  return state;
}

void expect_equal(const CombinerState& x, const CombinerState& y, const char* what) {
  EXPECT_NE(x, y) << what;
  EXPECT_EQ(normalize(x, profiles::nv2a), normalize(y, profiles::nv2a)) << what;
}

void expect_different(const CombinerState& x, const CombinerState& y, const char* what) {
  EXPECT_NE(x, y) << what;
  EXPECT_NE(normalize(x, profiles::nv2a), normalize(y, profiles::nv2a)) << what;
}

TEST(Program, InputsOfAProductThatIsNotUsedDoNotMatter) {
  CombinerState state = products_state();
  CombinerState other = state;
  other.general[0].rgb.c = rgb_of(Register::spare1, InputMapping::expand_normal);
  other.general[0].rgb.d = alpha_of(Register::fog);
  other.general[0].rgb.out.cd_dot_product = true;
  expect_equal(state, other, "CD goes nowhere");
  state.general[0].rgb.out.cd = other.general[0].rgb.out.cd = Register::spare1;
  expect_different(state, other, "CD is written");
  state.general[0].rgb.out.cd = other.general[0].rgb.out.cd = Register::discard;
  state.general[0].rgb.out.sum = other.general[0].rgb.out.sum = Register::spare1;
  expect_different(state, other, "CD is in the sum");
}

TEST(Program, AbLikewise) {
  CombinerState state = products_state();
  state.general[0].rgb.out.ab = Register::discard;
  state.general[0].rgb.out.cd = Register::spare0;
  CombinerState other = state;
  other.general[0].rgb.a = rgb_of(Register::spare1);
  other.general[0].rgb.out.ab_dot_product = true;
  expect_equal(state, other, "AB goes nowhere");
  state.general[0].rgb.out.sum = other.general[0].rgb.out.sum = Register::spare1;
  expect_different(state, other, "AB is in the sum");
}

TEST(Program, FlagsWithoutEffectDoNotMatter) {
  const CombinerState state = products_state();
  CombinerState other = state;
  other.general[0].rgb.out.mux_sum = true;
  expect_equal(state, other, "no third output");
  other = state;
  other.general[1].alpha.out.scale = Scale::by_four;
  expect_equal(state, other, "scale of a portion that writes nothing");
  other = state;
  other.general[0].rgb.out.scale = Scale::by_four;
  expect_different(state, other, "scale of a portion that writes");
  other = state;
  other.general[0].rgb.out.bias = Bias::by_negative_one_half;
  expect_different(state, other, "bias of a portion that writes");
  other = state;
  other.color_sum_clamp = false;
  expect_equal(state, other, "nothing reads the colour sum");
  CombinerState sum = state;
  sum.final_combiner.d = rgb_of(Register::spare0_plus_secondary);
  other = sum;
  other.color_sum_clamp = false;
  expect_different(sum, other, "the colour sum is read");
}

TEST(Program, TheMuxesBitMattersOnlyWhereThereIsAMux) {
  CombinerState state = products_state();
  CombinerState other = state;
  other.mux_by_lowest_bit = true;
  expect_equal(state, other, "no mux at all");
  for (CombinerState* s : {&state, &other}) {
    s->general[0].alpha.out.mux_sum = true;  // whose third output is discarded
    s->general[2].rgb.out = {.sum = Register::spare0, .mux_sum = true};
  }
  expect_equal(state, other, "none in use");
  for (CombinerState* s : {&state, &other}) s->general[1].alpha.out = {.sum = Register::spare0, .mux_sum = true};
  expect_different(state, other, "the second stage has one");
  EXPECT_FALSE(normalize(other, profiles::nv2a).general[0].mux_by_lowest_bit);
  EXPECT_TRUE(normalize(other, profiles::nv2a).general[1].mux_by_lowest_bit);
}

TEST(Program, BlueToAlphaMattersOnlyWhereItIsWritten) {
  CombinerState state = products_state();
  CombinerState other = state;
  other.general[0].rgb.out.cd_blue_to_alpha = true;
  expect_equal(state, other, "CD goes nowhere");
  other = state;
  other.general[0].rgb.out.ab_blue_to_alpha = true;
  expect_different(state, other, "AB goes to spare0");
  for (CombinerState* s : {&state, &other}) s->general[0].alpha.out.cd = Register::spare0;
  expect_equal(state, other, "the alpha portion writes spare0's alpha");
}

TEST(Program, InvertsMatterOnlyIfTheColorSumIsRead) {
  for (bool CombinerState::*const invert :
       {&CombinerState::color_sum_invert_spare0, &CombinerState::color_sum_invert_secondary}) {
    CombinerState state = products_state();
    CombinerState other = state;
    other.*invert = true;
    expect_equal(state, other, "nothing reads the colour sum");
    state.final_combiner.d = other.final_combiner.d = rgb_of(Register::spare0_plus_secondary);
    expect_different(state, other, "the colour sum is read");
  }
}

TEST(Program, EAndFMatterOnlyIfTheirProductIsRead) {
  CombinerState state = products_state();
  CombinerState other = state;
  other.final_combiner.e = rgb_of(Register::primary);
  other.final_combiner.f = rgb_of(Register::constant0);
  other.constant0 = color_of(1, 2, 3, 4);
  expect_equal(state, other, "E·F is not read");
  state.final_combiner.d = other.final_combiner.d = rgb_of(Register::e_times_f);
  expect_different(state, other, "E·F is read");
}

TEST(Program, ConstantsMatterOnlyWhereTheyAreRead) {
  CombinerState state = products_state();
  CombinerState other = state;
  other.constant0 = other.constant1 = color_of(9, 8, 7, 6);
  other.general[0].constant1 = color_of(5, 5, 5, 5);
  other.per_stage_constants = true;
  expect_equal(state, other, "no constant is read");
  state.general[0].rgb.a = other.general[0].rgb.a = rgb_of(Register::constant1);
  expect_different(state, other, "stage 0 reads constant 1");
  state = other;
  other.constant1 = color_of(1, 1, 1, 1);
  expect_equal(state, other, "the stage has its own");
  other.general[0].constant0 = color_of(1, 1, 1, 1);
  expect_equal(state, other, "stage 0 reads constant 1 alone");
  state.final_combiner.g = other.final_combiner.g = alpha_of(Register::constant1);
  expect_different(state, other, "the final combiner reads the global one");
}

TEST(Program, ConstantsAreComparedAsCodes) {
  CombinerState state = products_state();
  state.general[0].rgb.a = rgb_of(Register::constant0);
  CombinerState other = state;
  state.constant0[0] = 0.5F;
  other.constant0[0] = 0.501F;
  expect_equal(state, other, "both are 128");
  other.constant0[0] = 0.51F;
  expect_different(state, other, "130");
}

TEST(Program, PerStageConstantsEqualToTheGlobalOnesDoNotMatter) {
  CombinerState state = products_state();
  state.general[0].rgb.a = rgb_of(Register::constant0);
  state.constant0 = state.general[0].constant0 = color_of(3, 4, 5, 6);
  CombinerState other = state;
  other.per_stage_constants = true;
  expect_equal(state, other, "the same colour by either way");
}

TEST(Program, StagesPastTheLastDoNotMatter) {
  const CombinerState state = products_state();
  CombinerState other = state;
  other.general[2] = state.general[0];
  other.general[7].alpha = default_portion(PortionName::alpha);
  expect_equal(state, other, "stages 2 and 7 do not run");
  other = state;
  other.num_general_combiners = 3;
  EXPECT_NE(normalize(state, profiles::nv2a), normalize(other, profiles::nv2a));
}

TEST(Program, ProfilesDiffer) {
  const CombinerState state = products_state();
  EXPECT_NE(normalize(state, profiles::geforce2), normalize(state, profiles::geforce2_early_truncation));
  EXPECT_NE(normalize(state, profiles::geforce2), normalize(state, profiles::nv2a));
}

// Soundness, at random: states whose programs are equal compute the same, by the oracle, which knows no programs.
TEST(Program, EqualProgramsMeanEqualResults) {
  int equal = 0;
  int different_results = 0;
  const std::uint64_t cases = kSlowBuild ? 5000 : 40000;
  for (std::uint64_t index = 0; index < cases; ++index) {
    Random random(0x50F7, index);
    const HardwareProfile profile = random_profile(random);
    const CombinerState state = random_state(random, profile);
    // One random thing is replaced by that of another state.
    const CombinerState donor = random_state(random, profile);
    CombinerState other = state;
    const auto i = static_cast<std::size_t>(random.below(state.num_general_combiners));
    Portion& portion = random.one_in(2) ? other.general[i].rgb : other.general[i].alpha;
    const Portion& from = &portion == &other.general[i].rgb ? donor.general[i].rgb : donor.general[i].alpha;
    switch (random.below(15)) {
      case 0:
        portion.a = from.a;
        break;
      case 1:
        portion.b = from.b;
        break;
      case 2:
        portion.c = from.c;
        break;
      case 3:
        portion.d = from.d;
        break;
      case 4:
        portion.out.mux_sum = !portion.out.mux_sum;
        break;
      case 5:
        portion.out.ab_dot_product = from.out.ab_dot_product;
        break;
      case 6:
        portion.out.cd_dot_product = from.out.cd_dot_product;
        break;
      case 7:
        other.color_sum_clamp = !other.color_sum_clamp;
        break;
      case 8:
        other.constant0 = donor.constant0;
        break;
      case 9:
        other.general[i].constant1 = donor.general[i].constant1;
        break;
      case 10:
        other.mux_by_lowest_bit = profile.mux_by_lowest_bit && !other.mux_by_lowest_bit;
        break;
      case 11:
        other.general[i].rgb.out.ab_blue_to_alpha = donor.general[i].rgb.out.ab_blue_to_alpha;
        other.general[i].rgb.out.cd_blue_to_alpha = donor.general[i].rgb.out.cd_blue_to_alpha;
        break;
      case 12:
        other.color_sum_invert_spare0 = donor.color_sum_invert_spare0;
        other.color_sum_invert_secondary = donor.color_sum_invert_secondary;
        break;
      case 13:
        other.final_combiner.e = donor.final_combiner.e;
        break;
      default:
        other.final_combiner.f = donor.final_combiner.f;
        break;
    }
    if (other == state) continue;
    const bool same_program = normalize(state, profile) == normalize(other, profile);
    equal += same_program ? 1 : 0;
    // Of different programs one fragment says whether they differ.
    for (int fragment = 0; fragment < (same_program ? 8 : 1); ++fragment) {
      const oracle::Registers registers = to_oracle(random_registers(random, profile));
      const oracle::Outcome one = oracle::run(state, profile, registers);
      const oracle::Outcome two = oracle::run(other, profile, registers);
      const bool same = one.color == two.color && one.registers == two.registers;
      if (same_program) {
        ASSERT_TRUE(same) << "case " << index << '\n' << describe(state, profile) << describe(other, profile);
      }
      different_results += same ? 0 : 1;
    }
  }
  EXPECT_GT(equal, static_cast<int>(cases / 8)) << "too few equal programs: the test would prove little";
  EXPECT_GT(different_results, static_cast<int>(cases / 16)) << "the changes hardly ever mattered";
}

}  // namespace
}  // namespace ninebit::test
