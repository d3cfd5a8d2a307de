// Printed calls give the state again.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_calls.h"

namespace ninebit {
namespace {

using test::Random;

// A state that GL calls can reach: what a profile lacks has its default.
CombinerState reachable_state(Random& random, const HardwareProfile& profile) {
  CombinerState state = test::random_state(random, profile);
  state.mux_by_lowest_bit = state.color_sum_invert_spare0 = state.color_sum_invert_secondary = false;
  const auto stages = static_cast<std::size_t>(profile.general_combiners.value);
  for (std::size_t i = 0; i < state.general.size(); ++i) {
    PortionOutput& out = state.general[i].rgb.out;
    out.ab_blue_to_alpha = out.cd_blue_to_alpha = false;
    if (i >= stages) state.general[i] = GeneralCombiner{};
    if (!profile.per_stage_constants) state.general[i].constant0 = state.general[i].constant1 = ColorF{};
    if (random.one_in(4)) state.general[i] = GeneralCombiner{};
  }
  return state;
}

TEST(GlCallsRoundTrip, GivesTheStateAgain) {
  constexpr std::uint64_t kSeed = 20010607;
  for (std::uint64_t i = 0; i < (test::kSlowBuild ? 400U : 1500U); ++i) {
    Random random(kSeed, i);
    const HardwareProfile profile = test::random_profile(random);
    const CombinerState state = reachable_state(random, profile);
    ASSERT_TRUE(validate(state, profile).empty()) << "seed " << kSeed << " case " << i;
    const std::string text = print_gl_calls(state, profile).value();
    const auto back = parse_gl_calls({text, "printed"}, profile);
    ASSERT_TRUE(back) << "seed " << kSeed << " case " << i << "\n" << back.faults().front().text() << "\n" << text;
    ASSERT_TRUE(*back == state) << "seed " << kSeed << " case " << i << "\n" << text;
    ASSERT_EQ(print_gl_calls(*back, profile).value(), text);
  }
}

// A GL call that the profile lacks would be refused, and so would the whole text.
TEST(GlCallsRoundTrip, LeavesOutWhatTheProfileLacks) {
  CombinerState state;
  state.general[0].constant1 = {1, 0, 0, 1};
  state.general[1].constant0 = {0, 1, 0, 1};
  state.general[2].rgb.a.reg = Register::spare1;
  ASSERT_TRUE(validate(state, profiles::geforce2).empty());
  const std::string text = print_gl_calls(state, profiles::geforce2).value();
  const auto back = parse_gl_calls({text, "printed"}, profiles::geforce2);
  ASSERT_TRUE(back) << back.faults().front().text();
  EXPECT_EQ(*back, CombinerState{});
  const std::string in_full = print_gl_calls(state, profiles::nv2a).value();
  const auto all = parse_gl_calls({in_full, "printed"}, profiles::nv2a);
  ASSERT_TRUE(all) << all.faults().front().text();
  EXPECT_EQ(*all, state);
}

TEST(GlCallsRoundTrip, SaysWhatOpenGlLacks) {
  CombinerState state;
  state.mux_by_lowest_bit = true;
  EXPECT_TRUE(print_gl_calls(state, profiles::nv2a)) << "no mux looks at the bit";
  state.num_general_combiners = 3;
  state.general[1].rgb.out.mux_sum = state.general[2].alpha.out.mux_sum = true;
  state.general[2].rgb.out.cd = Register::spare1;
  state.general[2].rgb.out.cd_blue_to_alpha = true;
  state.color_sum_invert_spare0 = state.color_sum_invert_secondary = true;
  const auto text = print_gl_calls(state, profiles::nv2a);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().message,
            "OpenGL has no mux by the lowest bit of spare0's alpha (general combiner 1); mux by the lowest bit of "
            "spare0's alpha (general combiner 2); blue-to-alpha output (general combiner 2); "
            "1 - spare0 in the colour sum; 1 - secondary in the colour sum");
}

// Words may set the flags in a stage that is not used; nothing of it is printed then, as no call sets them.
TEST(GlCallsRoundTrip, FlagsThatOpenGlLacksPrintNothingInUnusedStages) {
  CombinerState state;
  const auto plain = print_gl_calls(state, profiles::nv2a);
  state.general[1].rgb.out.ab_blue_to_alpha = state.general[7].rgb.out.cd_blue_to_alpha = true;
  ASSERT_TRUE(plain);
  EXPECT_EQ(print_gl_calls(state, profiles::nv2a).value(), plain.value());
}

}  // namespace
}  // namespace ninebit
