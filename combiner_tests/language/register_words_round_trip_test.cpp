// Random states to register words and back, and random damage to their text.
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

// One random edit: a byte changed, put in or taken out, or a line doubled.
void damage(std::string& text, Random& random) {
  constexpr std::string_view kBytes = "0123456789abcdefxX=[]()_ \t\r\n#/RCINOUTALPHGB{}\",:\x01\x80\xff";
  const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size()) + 1));
  const char byte =
      random.one_in(20) ? '\0' : kBytes[static_cast<std::size_t>(random.below(static_cast<int>(kBytes.size())))];
  switch (random.below(4)) {
    case 0:
      text.insert(at, 1, byte);
      break;
    case 1:
      if (at < text.size()) text.erase(at, 1 + static_cast<std::size_t>(random.below(3)));
      break;
    case 2: {
      const std::size_t end = text.find('\n', at);
      if (end != std::string::npos && random.one_in(8)) text.insert(at, text.substr(at, end - at + 1));
      break;
    }
    default:
      if (at < text.size()) text[at] = byte;
  }
}

TEST(RegisterWordsRoundTrip, DamagedTextsAreRefusedOrMeanAValidState) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "the fuzzers do this with the same sanitizers";
  int accepted = 0, refused = 0;
  std::string text;
  for (int i = 0; i < 20'000; ++i) {
    Random random(15, static_cast<std::uint64_t>(i));
    const ChipClass chip = i % 2 == 0 ? ChipClass::nv10 : ChipClass::nv20;
    const HardwareProfile& profile = chip == ChipClass::nv10 ? profiles::geforce2 : profiles::nv2a;
    if (i % 8 < 2) text = print_register_words(random_state(random, profile), chip, profile).value();
    damage(text, random);
    const auto parsed = parse_register_words({text, "damaged"}, chip, profile);
    ASSERT_NE(parsed.ok(), !parsed.faults().empty()) << "case " << i;
    ASSERT_LE(parsed.faults().size(), kMaxTextFaults);
    for (const TextFault& fault : parsed.faults()) {
      ASSERT_GE(fault.line, 1);
      ASSERT_GE(fault.column, 1);
      ASSERT_FALSE(fault.message.empty());
    }
    if (parsed) {
      ASSERT_TRUE(validate(*parsed, profile).empty()) << "case " << i;
      const auto again = print_register_words(*parsed, chip, profile);
      ASSERT_TRUE(again.ok()) << again.error().message;
      const auto reparsed = parse_register_words({again.value(), ""}, chip, profile);
      ASSERT_TRUE(reparsed);
      ASSERT_EQ(normalize(*reparsed, profile), normalize(*parsed, profile)) << "case " << i;
    }
    ++(parsed ? accepted : refused);
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace ninebit::test
