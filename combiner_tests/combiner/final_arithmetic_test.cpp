// Every input of the final combiner's arithmetic, by the reference, the oracle, the SIMD targets and plain formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

// A·B + (255 - A)·C to the nearest code; 255 is odd, so that there is no tie.
int nearest_255(int wide) {
  return (2 * wide + 255) / 510;
}

// A·B + (one - A)·C, which is never negative, as a code; one is odd, so that there is no tie.
int blended(const HardwareProfile& p, int a, int b, int c) {
  const int wide = a * b + (p.one - a) * c;
  return p.final_narrowing == Narrowing::toward_zero ? wide / p.one : (2 * wide + p.one) / (2 * p.one);
}

// The integer profiles, and geforce2 with the rival of rule 9.
std::vector<HardwareProfile> profiles_and_truncation() {
  std::vector<HardwareProfile> all = integer_profiles();
  all.push_back(profiles::geforce2);
  all.back().name = "geforce2, truncating final combiner";
  all.back().final_narrowing.value = Narrowing::toward_zero;
  return all;
}

// All values of A, B and C: 2^24 with nine-bit codes. By the reference and on every SIMD target.
TEST(FinalArithmetic, EveryBlendOfThreeValues) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  CombinerState state = silent_state(1);
  state.final_combiner.a = rgb_of(Register::primary);
  state.final_combiner.b = rgb_of(Register::secondary);
  state.final_combiner.c = rgb_of(Register::texture0);
  Lanes lanes;
  std::array<std::array<int, 256>, 3> expected{};
  for (const HardwareProfile& p : profiles_and_truncation()) {
    const Datapath d = datapath_of(p);
    const BatchProgram program(compile(state, p).value());
    const int one = p.one;
    const auto values = static_cast<std::size_t>(one + 1);
    // Three values of A at once, one a channel. A sanitizer gets every fifteenth.
    for (int a = 0; a <= one; a += kSlowBuild ? 15 : 3) {
      for (int b = 0; b <= one; ++b) {
        int wrong = 0;
        for (int channel = 0; channel < 3; ++channel) {
          const int value = std::min(a + channel, one);
          std::fill_n((*lanes.registers)(Register::primary, channel), values, static_cast<s9>(value));
          std::fill_n((*lanes.registers)(Register::secondary, channel), values, static_cast<s9>(b));
          for (int c = 0; c <= one; ++c) {
            (*lanes.registers)(Register::texture0, channel)[c] = static_cast<s9>(c);
            int& code = expected[static_cast<std::size_t>(channel)][static_cast<std::size_t>(c)];
            code = blended(p, value, b, c);
            wrong |= reference::final_rgb(d, value, b, c, 0) ^ code;
          }
        }
        ASSERT_EQ(wrong, 0) << p.name << ": the reference, " << a << ' ' << b;
        lanes.expect_on_every_target(program, values, p, [&] {
          for (std::size_t channel = 0; channel < 3; ++channel) {
            for (std::size_t c = 0; c < values; ++c) wrong |= lanes.out->plane[channel][c] ^ expected[channel][c];
          }
          return wrong;
        });
        if (HasFatalFailure()) return;
      }
    }
  }
}

// All pairs of register values from `low` on, run through the whole state by every path: x in all components of one
// register, a third of all y in each component of another.
template <class Expected>
void for_all_pairs(const CombinerState& state, const HardwareProfile& p, Register first, Register second, int low,
                   const Expected& expected) {
  const int one = p.one, step = kSlowBuild ? 17 : 1, third = (one - low + 3) / 3;
  const auto y = [&](int i, int component) { return std::min(low + i + component * third, one); };
  std::vector<RegisterFile> fragments;
  for (int x = low; x <= one; x += x >= one - step ? 1 : step) {
    for (int i = 0; i < third; ++i) {
      RegisterFile& registers = fragments.emplace_back();
      registers[first] = codes(x, x, x, 0);
      registers[second] = codes(y(i, 0), y(i, 1), y(i, 2), 0);
    }
  }
  const std::vector<Fragment> results = judged(state, p, fragments);
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int a = fragments[i][first][c], b = fragments[i][second][c];
      ASSERT_EQ(results[i].color[c], expected(a, b)) << p.name << ' ' << a << ' ' << b;
    }
  }
}

TEST(FinalArithmetic, ETimesFOfAllPairs) {
  for (const HardwareProfile& p : integer_profiles()) {
    CombinerState state = silent_state(1);
    state.final_combiner.d = rgb_of(Register::e_times_f);
    state.final_combiner.e = rgb_of(Register::primary);
    state.final_combiner.f = rgb_of(Register::secondary);
    for_all_pairs(state, p, Register::primary, Register::secondary, 0,
                  [&](int e, int f) { return (2 * e * f + p.one) / (2 * p.one); });
  }
}

// With the clamp, and without it by halves, so that what lies above 1.0 shows; of the NV2A with 1 - x of either or
// both.
TEST(FinalArithmetic, ColorSumOfAllPairs) {
  for (const HardwareProfile& p : integer_profiles()) {
    for (const bool clamp : {true, false}) {
      if (!clamp && p.narrowing_point == NarrowingPoint::before_scale) continue;  // geforce2's final combiner
      for (int inverts = 0; inverts < (p.color_sum_inverts ? 4 : 1); ++inverts) {
        CombinerState state = silent_state(1);
        state.color_sum_clamp = clamp;
        state.color_sum_invert_spare0 = (inverts & 1) != 0;
        state.color_sum_invert_secondary = (inverts & 2) != 0;
        FinalCombiner& f = state.final_combiner;
        (clamp ? f.d : f.b) = rgb_of(Register::spare0_plus_secondary);
        state.constant0 = {0.5F, 0.5F, 0.5F, 0.5F};
        if (!clamp) f.a = rgb_of(Register::constant0);
        const int low = kSlowBuild ? -3 : p.lowest.value, half = (p.one + 1) / 2;
        for_all_pairs(state, p, Register::spare0, Register::secondary, low, [&](int x, int y) {
          const auto part = [&](int v, bool inverted) { return inverted ? p.one - std::max(v, 0) : std::max(v, 0); };
          const int sum = part(x, (inverts & 1) != 0) + part(y, (inverts & 2) != 0);
          return std::min(clamp ? sum : (2 * half * sum + p.one) / (2 * p.one), p.one.value);
        });
        if (HasFailure()) return;
      }
    }
  }
}

TEST(FinalArithmetic, DIsAddedAfterTheNarrowingAndTheSumIsClamped) {
  const Datapath d = datapath_of(profiles::geforce2);
  for (int a = 0; a < 256; a += 5) {
    for (int b = 0; b < 256; b += 3) {
      for (int added = 0; added <= 510; ++added) {
        const int expected = std::min(nearest_255(a * b) + added, 255);
        ASSERT_EQ(reference::final_rgb(d, a, b, 0, added), expected) << a << ' ' << b << ' ' << added;
      }
    }
  }
}

}  // namespace
}  // namespace ninebit::test
