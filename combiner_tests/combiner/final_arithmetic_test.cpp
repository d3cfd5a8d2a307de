// Every input of the final combiner's arithmetic, by the reference, the oracle, the SIMD targets and plain formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "combiner_tests/combiner/simd_targets.h"
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

// All values of A, B and C: 2^24 with nine-bit codes.
TEST(FinalArithmetic, EveryBlendOfThreeValues) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  for (const HardwareProfile& p : profiles_and_truncation()) {
    const Datapath d = datapath_of(p);
    for (int a = 0; a <= p.one; ++a) {
      for (int b = 0; b <= p.one; ++b) {
        for (int c = 0; c <= p.one; ++c) {
          const int expected = blended(p, a, b, c), actual = reference::final_rgb(d, a, b, c, 0);
          if (actual != expected) {
            FAIL() << p.name << ' ' << a << ' ' << b << ' ' << c << ": " << actual << " instead of " << expected;
          }
        }
      }
    }
  }
}

TEST(FinalArithmetic, EveryBlendOfThreeValuesOnEverySimdTarget) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "a build with sanitizers has one SIMD target";
  CombinerState state = silent_state(1);
  state.final_combiner.a = rgb_of(Register::primary);
  state.final_combiner.b = rgb_of(Register::secondary);
  state.final_combiner.c = rgb_of(Register::texture0);
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  for (const HardwareProfile& p : profiles_and_truncation()) {
    const BatchProgram program(compile(state, p).value());
    const int one = p.one;
    const auto values = static_cast<std::size_t>(one + 1);
    for (std::size_t c = 0; c < values; ++c) {
      for (int channel = 0; channel < 3; ++channel) (*batch)(Register::texture0, channel)[c] = static_cast<s9>(c);
    }
    // Three values of A at once, one a channel. A sanitizer gets every fifteenth.
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on_target(target);
      for (int a = 0; a <= one; a += kSlowBuild ? 15 : 3) {
        for (int channel = 0; channel < 3; ++channel) {
          std::fill_n((*batch)(Register::primary, channel), values, static_cast<s9>(std::min(a + channel, one)));
        }
        for (int b = 0; b <= one; ++b) {
          for (int channel = 0; channel < 3; ++channel) {
            std::fill_n((*batch)(Register::secondary, channel), values, static_cast<s9>(b));
          }
          program.run(*batch, values, *out);
          for (int channel = 0; channel < 3; ++channel) {
            const int value = std::min(a + channel, one);
            for (int c = 0; c <= one; ++c) {
              const int expected = blended(p, value, b, c);
              const int actual = out->plane[static_cast<std::size_t>(channel)][static_cast<std::size_t>(c)];
              if (actual != expected) {
                FAIL() << p.name << " on " << simd_target_name(target) << ": " << value << ' ' << b << ' ' << c << ": "
                       << actual << " instead of " << expected;
              }
            }
          }
        }
      }
      ASSERT_TRUE(on_target.ran());
    }
  }
}

// Pairs of register values in one fragment's red, green and blue, run through the whole state by every path.
template <class Expected>
void for_all_pairs(const CombinerState& state, const HardwareProfile& p, Register first, Register second, int low,
                   const Expected& expected) {
  const int one = p.one;
  const int step = kSlowBuild ? 17 : 1;
  for (int x = low; x <= one; x += x >= one - step ? 1 : step) {
    std::vector<RegisterFile> fragments;
    std::vector<int> second_value;
    const auto flush = [&] {
      const std::vector<Fragment> results = judged(state, p, fragments);
      for (std::size_t i = 0; i < results.size(); ++i) {
        const int y = second_value[i];
        const int other = std::max(low, x - 1);
        ASSERT_EQ(results[i].color[kRed], expected(x, y)) << p.name << ' ' << x << ' ' << y;
        ASSERT_EQ(results[i].color[kGreen], expected(other, y)) << p.name << ' ' << other << ' ' << y;
        ASSERT_EQ(results[i].color[kBlue], expected(y, x)) << p.name << ' ' << y << ' ' << x;
      }
      fragments.clear();
      second_value.clear();
    };
    for (int y = low; y <= one; ++y) {
      RegisterFile registers;
      registers[first] = codes(x, std::max(low, x - 1), y, 0);
      registers[second] = codes(y, y, x, 0);
      fragments.push_back(registers);
      second_value.push_back(y);
      if (fragments.size() == kBatchSize) flush();
    }
    if (!fragments.empty()) flush();
    if (testing::Test::HasFailure()) return;
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

TEST(FinalArithmetic, ColorSumOfAllPairsWithTheClamp) {
  for (const HardwareProfile& p : integer_profiles()) {
    CombinerState state = silent_state(1);
    state.final_combiner.d = rgb_of(Register::spare0_plus_secondary);
    const int low = kSlowBuild ? -3 : p.lowest.value;
    for_all_pairs(state, p, Register::spare0, Register::secondary, low,
                  [&](int x, int y) { return std::min(std::max(x, 0) + std::max(y, 0), p.one.value); });
  }
}

TEST(FinalArithmetic, ColorSumOfAllPairsWithoutTheClamp) {
  for (const HardwareProfile& p : {profiles::geforce2, profiles::geforce256_8bit}) {
    CombinerState state = silent_state(1);
    state.color_sum_clamp = false;
    // Half of the sum, so that what lies above 1.0 shows.
    state.constant0 = {0.5F, 0.5F, 0.5F, 0.5F};
    state.final_combiner.a = rgb_of(Register::constant0);
    state.final_combiner.b = rgb_of(Register::spare0_plus_secondary);
    const int half = p.one == 255 ? 128 : 64;
    for_all_pairs(state, p, Register::spare0, Register::secondary, 0,
                  [&](int x, int y) { return std::min((2 * half * (x + y) + p.one) / (2 * p.one), p.one.value); });
  }
}

// 1 - x of either or both, of every pair of register values; with the clamp, and without it by halves.
TEST(FinalArithmetic, InvertedColorSumOfAllPairs) {
  const HardwareProfile& p = profiles::nv2a;
  for (const bool clamp : {true, false}) {
    for (const int inverts : {1, 2, 3}) {
      CombinerState state = silent_state(1);
      state.color_sum_clamp = clamp;
      state.color_sum_invert_spare0 = (inverts & 1) != 0;
      state.color_sum_invert_secondary = (inverts & 2) != 0;
      if (clamp) {
        state.final_combiner.d = rgb_of(Register::spare0_plus_secondary);
      } else {
        state.constant0 = {0.5F, 0.5F, 0.5F, 0.5F};
        state.final_combiner.a = rgb_of(Register::constant0);
        state.final_combiner.b = rgb_of(Register::spare0_plus_secondary);
      }
      const int low = kSlowBuild ? -3 : p.lowest.value;
      for_all_pairs(state, p, Register::spare0, Register::secondary, low, [&](int x, int y) {
        const auto part = [](int v, bool inverted) { return inverted ? (v > 0 ? 255 - v : 255) : (v > 0 ? v : 0); };
        const int sum = part(x, (inverts & 1) != 0) + part(y, (inverts & 2) != 0);
        return clamp ? std::min(sum, 255) : std::min((2 * 128 * sum + 255) / 510, 255);
      });
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
