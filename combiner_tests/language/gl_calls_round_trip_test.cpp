// Printed calls give the state again; broken texts give faults and never a state that GL would not hold.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "combiner_tests/combiner/random_state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_calls.h"

namespace ninebit {
namespace {

using test::Random;

// A state that GL calls can reach: what a profile lacks has its default.
CombinerState reachable_state(Random& random, const HardwareProfile& profile) {
  CombinerState state = test::random_state(random, profile);
  const auto stages = static_cast<std::size_t>(profile.general_combiners.value);
  for (std::size_t i = 0; i < state.general.size(); ++i) {
    if (i >= stages) state.general[i] = GeneralCombiner{};
    if (!profile.per_stage_constants) state.general[i].constant0 = state.general[i].constant1 = ColorF{};
    if (random.one_in(4)) state.general[i] = GeneralCombiner{};
  }
  return state;
}

TEST(GlCallsRoundTrip, GivesTheStateAgain) {
  constexpr std::uint64_t kSeed = 20010607;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    Random random(kSeed, i);
    const HardwareProfile profile = test::random_profile(random);
    const CombinerState state = reachable_state(random, profile);
    ASSERT_TRUE(validate(state, profile).empty()) << "seed " << kSeed << " case " << i;
    const std::string text = print_gl_calls(state);
    const auto back = parse_gl_calls({text, "printed"}, profile);
    ASSERT_TRUE(back) << "seed " << kSeed << " case " << i << "\n" << back.faults.front().text() << "\n" << text;
    ASSERT_TRUE(*back.value == state) << "seed " << kSeed << " case " << i << "\n" << text;
    ASSERT_EQ(print_gl_calls(*back.value), text);
  }
}

TEST(GlCallsRoundTrip, BrokenTextsEndInAStateOrInFaults) {
  using namespace std::string_view_literals;
  constexpr std::uint64_t kSeed = 7;
  constexpr std::string_view kBytes = "(){}[],;=+-&*#/\"'\\.0x1eEfGL_NV \n\t\0\x80\xFF"sv;
  Random start(kSeed);
  const CombinerState state = reachable_state(start, profiles::nv2a);
  const std::string whole =
      "GLfloat c[4] = {0.5f, 1, 0x0, 1e-3};\nglCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c);\n" +
      print_gl_calls(state);
  int states = 0, refused = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    Random random(kSeed, i);
    // Whole lines, so that some of the edited texts remain valid.
    const std::size_t from =
        whole.find('\n', static_cast<std::size_t>(random.below(static_cast<int>(whole.size())))) + 1;
    std::string text = random.one_in(2) ? whole.substr(0, from) : whole.substr(from, whole.find('\n', from) + 1 - from);
    for (int edits = 1 + random.below(4); edits > 0 && !text.empty(); --edits) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
      const char byte = random.one_in(4)
                            ? static_cast<char>(random.below(256))
                            : kBytes[static_cast<std::size_t>(random.below(static_cast<int>(kBytes.size())))];
      switch (random.below(3)) {
        case 0:
          text[at] = byte;
          break;
        case 1:
          text.insert(at, 1, byte);
          break;
        default:
          text.erase(at, 1 + static_cast<std::size_t>(random.below(8)));
      }
    }
    const auto result = parse_gl_calls({text, ""}, profiles::nv2a);
    ASSERT_NE(result.value.has_value(), !result.faults.empty());
    ASSERT_LE(result.faults.size(), kMaxTextFaults);
    if (result) {
      ASSERT_TRUE(validate(*result.value, profiles::nv2a).empty()) << "case " << i << "\n" << text;
    }
    for (std::size_t f = 1; f < result.faults.size(); ++f) {
      const TextFault &a = result.faults[f - 1], &b = result.faults[f];
      ASSERT_TRUE(a.line < b.line || (a.line == b.line && a.column <= b.column)) << "case " << i;
    }
    (result ? states : refused) += 1;
  }
  EXPECT_GT(states, 100);
  EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace ninebit
