// Sums of products of any sign that fit into 16 bits, and programs whose registers begin without negative codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

// The final combiner shows spare1: the judge also runs programs that compute its positive part alone.

// Judges a state with every pair of codes in [0, one] in primary and secondary.
void judge_all_pairs(const CombinerState& state, const HardwareProfile& profile) {
  const int one = profile.one;
  std::vector<RegisterFile> fragments;
  const auto flush = [&] {
    judged(state, profile, fragments);
    fragments.clear();
  };
  // The values of a fragment's three channels are a third of the codes apart.
  for (int x = 0; x <= one; x += kSlowBuild ? 5 : 1) {
    for (int y = 0; y <= one / 3; ++y) {
      RegisterFile& registers = fragments.emplace_back();
      const int third = one / 3;
      registers[Register::primary] = codes(x, x, x, x);
      registers[Register::secondary] = codes(y, y + third, y + 2 * third, y);
      if (fragments.size() == kBatchSize) flush();
    }
    if (testing::Test::HasFailure()) return;
  }
  if (!fragments.empty()) flush();
}

std::string compiled(const CombinerState& state, const HardwareProfile& profile) {
  return BatchProgram(compile(state, profile).value(), {.registers = true}).describe();
}

TEST(SignedSums, EveryProductOfTwoCodesLessOneHalf) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  for (const HardwareProfile& profile : profiles_and_rivals()) {
    for (const Scale scale : {Scale::none, Scale::by_two}) {
      CombinerState state = silent_state(1);
      Portion& rgb = state.general[0].rgb;
      rgb.a = rgb_of(Register::primary);
      rgb.b = rgb_of(Register::secondary, InputMapping::unsigned_invert);
      rgb.out = {.ab = Register::spare1, .scale = scale, .bias = Bias::by_negative_one_half};
      state.final_combiner = final_of(Register::spare1);
      judge_all_pairs(state, profile);
      if (profile.one == 255 && profile.narrowing_point == NarrowingPoint::after_scale) {
        EXPECT_NE(compiled(state, profile).find("s16:"), std::string::npos) << profile.name;
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(SignedSums, EverySumOfTwoProductsByConstants) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  for (const HardwareProfile& profile : profiles_and_rivals()) {
    for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four}) {
      CombinerState state = silent_state(1);
      state.constant0 = color_of(60, 1, 40, 0);
      state.constant1 = color_of(50, 68, 3, 0);
      Portion& rgb = state.general[0].rgb;
      rgb.a = rgb_of(Register::primary);
      rgb.b = rgb_of(Register::constant0);
      rgb.c = rgb_of(Register::secondary, InputMapping::signed_negate);
      rgb.d = rgb_of(Register::constant1);
      rgb.out = {.sum = Register::spare1, .scale = scale};
      state.final_combiner = final_of(Register::spare1);
      judge_all_pairs(state, profile);
      if (profile.one == 255 && profile.narrowing_point == NarrowingPoint::after_scale) {
        EXPECT_NE(compiled(state, profile).find("s16:"), std::string::npos) << profile.name;
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

// Random programs whose registers begin in [0, one], compiled with and without that knowledge, on every target.
TEST(BatchInputs, RegistersThatAreNotNegative) {
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  int shorter = 0;
  constexpr std::uint64_t kPrograms = kSlowBuild ? 100 : 2000;
  for (std::uint64_t index = 0; index < kPrograms; ++index) {
    Random random(0xB17E5, index);
    const HardwareProfile profile = random_profile(random);
    const Program program = normalize(random_state(random, profile), profile);
    std::vector<RegisterFile> fragments(64);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      fragments[i] = random_registers(random, profile);
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
          s9& code = fragments[i].value[r][c];
          code = static_cast<s9>(std::max<int>(code, 0));
          batch->plane[r][c][i] = code;
        }
      }
    }
    const BatchProgram any(program), bytes(program, {}, {}, BatchInputs::not_negative);
    shorter += bytes.describe().size() < any.describe().size() ? 1 : 0;
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on_target(target);
      bytes.run(*batch, fragments.size(), *out);
      for (std::size_t i = 0; i < fragments.size(); ++i) {
        const Rgba9 expected = evaluate(program, fragments[i]);
        for (std::size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(out->plane[c][i], expected[c]) << index << ' ' << simd_target_name(target) << bytes.describe();
        }
      }
    }
  }
  EXPECT_GT(shorter, static_cast<int>(kPrograms / 2));
}

// A mapping that one product reads is part of it. Operations that differ in their planes alone come together.
TEST(BatchProgram, MapsWhereItMultiplies) {
  CombinerState state = silent_state(1);
  Portion& rgb = state.general[0].rgb;
  rgb.a = rgb_of(Register::primary, InputMapping::half_bias_normal);
  rgb.b = rgb_of(Register::secondary, InputMapping::unsigned_invert);
  rgb.out = {.ab = Register::spare0, .sum = Register::discard};
  state.final_combiner = final_of(Register::spare0);
  const std::string text =
      BatchProgram(compile(state, profiles::geforce2).value(), {}, {}, BatchInputs::not_negative).describe();
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "t0 = clamp(s16:truncate(((-1*secondary_color.r + 255)*(1*primary_color.r + -128)) / 255), 0, 127)");
  EXPECT_LT(text.find("secondary_color.b"), text.find("out.r"));
}

// A line with the factor -1 that two products read is part of both; one with the factor 2 has a plane.
TEST(BatchProgram, ShortLinesArePartOfSeveralProducts) {
  CombinerState state = silent_state(1);
  Portion& rgb = state.general[0].rgb;
  rgb.a = rgb_of(Register::primary, InputMapping::unsigned_invert);
  rgb.b = rgb_of(Register::secondary);
  rgb.c = rgb_of(Register::primary, InputMapping::unsigned_invert);
  rgb.d = rgb_of(Register::fog);
  rgb.out = {.ab = Register::spare0, .cd = Register::secondary, .sum = Register::discard};
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
  Portion& rgb = state.general[0].rgb;
  rgb.a = rgb_of(Register::primary);
  rgb.b = rgb_of(Register::secondary, InputMapping::half_bias_normal);
  rgb.c = rgb_of(Register::fog);
  rgb.d = rgb_of(Register::texture0, InputMapping::half_bias_normal);
  rgb.out = {.ab = Register::spare0, .cd = Register::spare1, .sum = Register::discard};
  state.general[1].rgb = {rgb_of(Register::spare0, InputMapping::signed_identity),
                          kOne,
                          rgb_of(Register::spare1, InputMapping::signed_identity),
                          kOne,
                          {.sum = Register::spare0, .mux_sum = true}};
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
