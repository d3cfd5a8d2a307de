// Random states to register words and back.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/register_words.h"
#include "ninebit/numerics/codes.h"

namespace ninebit::test {
namespace {

ColorF byte_exact(const ColorF& color) {
  ColorF exact{};
  for (std::size_t i = 0; i < 4; ++i) exact[i] = static_cast<float>(byte_of_color(color[i])) / 255.0F;
  return exact;
}

bool has_mux(const CombinerState& state) {
  for (int i = 0; i < state.num_general_combiners; ++i) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    for (const PortionOutput& out : {stage.rgb.out, stage.alpha.out}) {
      if (out.mux_sum && out.sum != Register::discard) return true;
    }
  }
  return false;
}

// The part of a state that the chip's words can hold; general combiners that the profile does not have are not written.
CombinerState held_by(ChipClass chip, const HardwareProfile& profile, CombinerState state) {
  state.constant0 = byte_exact(state.constant0);
  state.constant1 = byte_exact(state.constant1);
  state.mux_by_lowest_bit = state.mux_by_lowest_bit && has_mux(state);
  const auto stages =
      static_cast<std::size_t>(std::min(chip == ChipClass::nv10 ? 2 : 8, profile.general_combiners.value));
  for (std::size_t i = 0; i < state.general.size(); ++i) {
    GeneralCombiner& stage = state.general[i];
    if (i >= stages) stage = {};
    stage.constant0 = state.per_stage_constants ? byte_exact(stage.constant0) : ColorF{};
    stage.constant1 = state.per_stage_constants ? byte_exact(stage.constant1) : ColorF{};
  }
  return state;
}

void expect_round_trips(ChipClass chip, const HardwareProfile& profile, std::uint64_t seed) {
  constexpr int kStates = 5000;
  int several_stages = 0, by_lowest_bit = 0;
  for (int i = 0; i < kStates; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const CombinerState state = random_state(random, profile);
    const auto printed = print_register_words(state, chip, profile);
    ASSERT_TRUE(printed.ok()) << "state " << i << ": " << printed.error().message;
    const auto parsed = parse_register_words({printed.value(), "printed"}, chip, profile);
    ASSERT_TRUE(parsed) << "state " << i << '\n' << parsed.faults().front().text() << '\n' << printed.value();
    ASSERT_EQ(*parsed, held_by(chip, profile, state)) << "state " << i << '\n' << printed.value();
    ASSERT_EQ(normalize(*parsed, profile), normalize(state, profile)) << "state " << i;
    ASSERT_EQ(print_register_words(*parsed, chip, profile).value(), printed.value()) << "state " << i;
    by_lowest_bit += parsed->mux_by_lowest_bit ? 1 : 0;
    several_stages += state.num_general_combiners > 1 ? 1 : 0;
  }
  EXPECT_GT(several_stages, kStates / 4);
  EXPECT_EQ(by_lowest_bit > kStates / 8, profile.mux_by_lowest_bit.value) << by_lowest_bit;
}

TEST(RegisterWordsRoundTrip, Nv10OfAGeForce2) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  expect_round_trips(ChipClass::nv10, profiles::geforce2, 11);
}

TEST(RegisterWordsRoundTrip, Nv20OfAnNv2a) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  expect_round_trips(ChipClass::nv20, profiles::nv2a, 12);
}

TEST(RegisterWordsRoundTrip, Nv20OfAGeForce2) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  expect_round_trips(ChipClass::nv20, profiles::geforce2, 13);
}

TEST(RegisterWordsRoundTrip, OfCombinersThatTheProfileLacksNothingIsWritten) {
  CombinerState state;
  state.general[2].alpha.out = {.scale = Scale::by_four, .bias = Bias::by_negative_one_half};  // no chip has it
  const auto printed = print_register_words(state, ChipClass::nv20, profiles::geforce2);
  ASSERT_TRUE(printed) << printed.error().message;
  const auto parsed = parse_register_words({*printed, "printed"}, ChipClass::nv20, profiles::geforce2);
  ASSERT_TRUE(parsed) << parsed.faults().front().text();
  EXPECT_EQ(*parsed, CombinerState{});
}

TEST(RegisterWordsRoundTrip, Nv10OfWhatFitsOfAnNv2aProgram) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  CombinerState state;
  for (int i = 0; i < 5000; ++i) {
    Random random(14, static_cast<std::uint64_t>(i));
    state = random_state(random, profiles::geforce2);
    // Stages past the second are no obstacle while they are not in use.
    state.general[5] = random_state(random, profiles::nv2a).general[5];
    state.mux_by_lowest_bit = random.one_in(2);
    const auto printed = print_register_words(state, ChipClass::nv10, profiles::nv2a);
    ASSERT_TRUE(printed.ok()) << printed.error().message;
    const auto parsed = parse_register_words({printed.value(), ""}, ChipClass::nv10, profiles::nv2a);
    ASSERT_TRUE(parsed) << parsed.faults().front().text();
    ASSERT_EQ(normalize(*parsed, profiles::nv2a), normalize(state, profiles::nv2a));
  }
}

}  // namespace
}  // namespace ninebit::test
