// Sums of products of any sign that fit into 16 bits, and programs whose registers begin without negative codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

// The final combiner shows spare1: the judge also runs programs that compute its positive part alone.

// Judges a state with every pair of codes in [0, one] in primary and secondary.
void judge_all_pairs(const CombinerState& state, const HardwareProfile& profile) {
  const int one = profile.one, third = (one + 3) / 3;
  std::vector<RegisterFile> fragments;
  // The values of a fragment's three channels are a third of the codes apart.
  for (int x = 0; x <= one; x += kSlowBuild ? 5 : 1) {
    for (int y = 0; y < third; ++y) {
      RegisterFile& registers = fragments.emplace_back();
      registers[Register::primary] = codes(x, x, x, x);
      registers[Register::secondary] = codes(y, y + third, std::min(y + 2 * third, one), y);
    }
  }
  judged(state, profile, fragments);
}

std::string compiled(const CombinerState& state, const HardwareProfile& profile) {
  return BatchProgram(compile(state, profile).value(), {.registers = true}).describe();
}

TEST(SignedSums, EveryPairOfCodes) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  // A product less one half, and a sum of two products by constants.
  const Portion product{rgb_of(Register::primary), rgb_of(Register::secondary, InputMapping::unsigned_invert), kZero,
                        kZero, ab_to(Register::spare1, Scale::none, Bias::by_negative_one_half)};
  const Portion sum{rgb_of(Register::primary), rgb_of(Register::constant0),
                    rgb_of(Register::secondary, InputMapping::signed_negate), rgb_of(Register::constant1),
                    sum_to(Register::spare1)};
  for (const HardwareProfile& profile : profiles_and_rivals()) {
    for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four}) {
      for (const Portion& portion : {product, sum}) {
        if (scale == Scale::by_four && portion.out.bias != Bias::none) continue;
        CombinerState state = rgb_stage(portion);
        state.general[0].rgb.out.scale = scale;
        state.constant0 = color_of(60, 1, 40, 0);
        state.constant1 = color_of(50, 68, 3, 0);
        state.final_combiner = final_of(Register::spare1);
        judge_all_pairs(state, profile);
        if (profile.one == 255 && profile.narrowing_point == NarrowingPoint::after_scale) {
          EXPECT_NE(compiled(state, profile).find("s16:"), std::string::npos) << profile.name;
        }
        if (HasFailure()) return;
      }
    }
  }
}

// Random programs whose registers begin in [0, one], compiled with and without that knowledge, on every target.
TEST(BatchInputs, RegistersThatAreNotNegative) {
  Lanes lanes;
  int shorter = 0;
  constexpr std::uint64_t kPrograms = kSlowBuild ? 100 : 2000;
  for (std::uint64_t index = 0; index < kPrograms; ++index) {
    Random random(0xB17E5, index);
    const HardwareProfile profile = random_profile(random);
    const Program program = normalize(random_state(random, profile), profile);
    std::vector<RegisterFile> fragments(64);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      fragments[i] = random_registers(random, profile);
      for (Rgba9& value : fragments[i].value) {
        for (s9& code : value) code = std::max(code, s9{0});
      }
      put(*lanes.registers, i, fragments[i]);
    }
    std::vector<Rgba9> expected;
    for (const RegisterFile& registers : fragments) expected.push_back(evaluate(program, registers));
    const BatchProgram any(program), bytes(program, {}, {}, BatchInputs::not_negative);
    shorter += bytes.describe().size() < any.describe().size() ? 1 : 0;
    lanes.expect_on_every_target(bytes, fragments.size(), profile, [&] {
      int wrong = 0;
      for (std::size_t i = 0; i < fragments.size(); ++i) wrong += lane_of(*lanes.out, i) != expected[i] ? 1 : 0;
      return wrong;
    });
    ASSERT_FALSE(HasFailure()) << index;
  }
  EXPECT_GT(shorter, static_cast<int>(kPrograms / 2));
}

// A mapping that one product reads is part of it. Operations that differ in their planes alone come together.
TEST(BatchProgram, MapsWhereItMultiplies) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary, InputMapping::half_bias_normal),
                 rgb_of(Register::secondary, InputMapping::unsigned_invert), kZero, kZero, ab_to(Register::spare0)});
  state.final_combiner = final_of(Register::spare0);
  const std::string text =
      BatchProgram(compile(state, profiles::geforce2).value(), {}, {}, BatchInputs::not_negative).describe();
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "t0 = clamp(s16:truncate(((-1*secondary_color.r + 255)*(1*primary_color.r + -128)) / 255), 0, 127)");
  EXPECT_LT(text.find("secondary_color.b"), text.find("out.r"));
}

// A line with the factor -1 that two products read is part of both; one with the factor 2 has a plane.
TEST(BatchProgram, ShortLinesArePartOfSeveralProducts) {
  const CombinerInput inverted = rgb_of(Register::primary, InputMapping::unsigned_invert);
  CombinerState state = rgb_stage({inverted,
                                   rgb_of(Register::secondary),
                                   inverted,
                                   rgb_of(Register::fog),
                                   {.ab = Register::spare0, .cd = Register::secondary, .sum = Register::discard}});
  Portion& rgb = state.general[0].rgb;
  state.final_combiner = final_of(Register::spare0);
  state.final_combiner.d = rgb_of(Register::spare0_plus_secondary);
  const auto text = [&] {
    return BatchProgram(compile(state, profiles::geforce2).value(), {.color = {true, false, false, false}}, {},
                        BatchInputs::not_negative)
        .describe();
  };
  const auto lines = [&] {
    const std::string all = text();
    return std::count(all.begin(), all.end(), '\n');
  };
  EXPECT_EQ(lines(), 3) << text();
  rgb.a.mapping = rgb.c.mapping = InputMapping::expand_normal;
  EXPECT_EQ(lines(), 4) << text();
  EXPECT_TRUE(text().starts_with("t0 = 2*primary_color.r + -255\n")) << text();
}

// Both choices of the mux lose their negative parts before it, because the final combiner takes none.
TEST(BatchProgram, PositivePartsMoveToWhereValuesComeFrom) {
  CombinerState state = silent_state(2);
  state.general[0].rgb = {rgb_of(Register::primary),
                          rgb_of(Register::secondary, InputMapping::half_bias_normal),
                          rgb_of(Register::fog),
                          rgb_of(Register::texture0, InputMapping::half_bias_normal),
                          {.ab = Register::spare0, .cd = Register::spare1, .sum = Register::discard}};
  state.general[1].rgb = {rgb_of(Register::spare0, InputMapping::signed_identity), kOne,
                          rgb_of(Register::spare1, InputMapping::signed_identity), kOne, mux_to(Register::spare0)};
  state.final_combiner = final_of(Register::spare0);
  const BatchOutputs red{.color = {true, false, false, false}};
  const std::string text =
      BatchProgram(compile(state, profiles::geforce2).value(), red, {}, BatchInputs::not_negative).describe();
  EXPECT_EQ(text,
            "t0 = clamp(s16:truncate((primary_color.r*(1*secondary_color.r + -128)) / 255), 0, 127)\n"
            "t1 = clamp(s16:truncate((fog.r*(1*texture0.r + -128)) / 255), 0, 127)\n"
            "t1 = (spare0.a >= 128 ? t1 : t0)\n"
            "out.r = 1*t1\n");
}

}  // namespace
}  // namespace ninebit::test
