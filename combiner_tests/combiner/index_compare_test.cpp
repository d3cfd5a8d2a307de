// Rules 7 and 8 together: the index comparison of the article on index shadows. Which steps between indices work tells
// the profiles apart, and only after-scale truncation gives the article's step of 2.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/initial_registers.h"

namespace ninebit::test {
namespace {

// The registers where the indices a = i / 256 and b = i % 256 meet, in one channel.
RegisterFile registers_of(const HardwareProfile& profile, int i) {
  FragmentInputs inputs;
  inputs.primary = {static_cast<std::uint8_t>(i / 256), 0, 0, 0};
  inputs.texture[0] = Texel{.value = {static_cast<std::uint8_t>(i), 0, 0, 0}};
  return initial_registers(profile, inputs);
}

// For each step, the ordered pairs of different multiples of it that come out lit.
std::array<int, 6> mistakes(const HardwareProfile& profile, Scale scale = Scale::by_four) {
  constexpr std::array kSteps{1, 2, 3, 4, 8, 16};
  std::vector<RegisterFile> fragments;
  for (int i = 0; i < 65536; ++i) fragments.push_back(registers_of(profile, i));
  std::vector<bool> lit;
  for (const Fragment& f : judged(index_comparison(scale), profile, fragments)) lit.push_back(f.color[kAlpha] == 0);
  std::array<int, 6> count{};
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    for (int a = 0; a < 256; a += kSteps[i]) {
      EXPECT_TRUE(lit[static_cast<std::size_t>(a * 257)]) << "equal indices must be lit";
      for (int b = 0; b < 256; b += kSteps[i]) {
        if (a != b && lit[static_cast<std::size_t>(a * 256 + b)]) ++count[i];
      }
    }
  }
  return count;
}

using Counts = std::array<int, 6>;

TEST(IndexCompare, StepsOfTwoWorkOnTheGeforce2) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  EXPECT_EQ(mistakes(profiles::geforce2), (Counts{510, 0, 0, 0, 0, 0}));
}

TEST(IndexCompare, EarlyNarrowingNeedsLargerSteps) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  HardwareProfile nearest = profiles::geforce2_early_truncation;
  nearest.general_narrowing.value = Narrowing::nearest_halves_up;
  EXPECT_EQ(mistakes(nearest), (Counts{1018, 254, 0, 0, 0, 0}));
  EXPECT_EQ(mistakes(profiles::geforce2_early_truncation), (Counts{1524, 254, 170, 0, 0, 0}));
}

TEST(IndexCompare, EightBitsNeedLargerSteps) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  EXPECT_EQ(mistakes(profiles::geforce256_8bit), (Counts{1272, 254, 86, 0, 0, 0}));
}

TEST(IndexCompare, WithoutTheScalesStepsOf16AreNeeded) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  EXPECT_EQ(mistakes(profiles::geforce2, Scale::none), (Counts{7440, 1736, 830, 372, 62, 0}));
}

// Where nothing is narrowed, the alpha test still compares bytes: 64 d² / 255 is rounded, and the difference 1 is lost.
TEST(IndexCompare, RealNumbersLoseOneStepWhereTheFrameBufferStoresThem) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  for (const HardwareProfile& p : {profiles::ideal, profiles::float_shader}) {
    if (kSlowBuild && p.arithmetic == Arithmetic::exact) continue;  // too slow
    EXPECT_EQ(mistakes(p), (Counts{510, 0, 0, 0, 0, 0})) << p.name;
    // d² / 255 rounds to 0 up to d = 11: 2 · (255 + 254 + … + 245) for the step of 1.
    EXPECT_EQ(mistakes(p, Scale::none), (Counts{5500, 1250, 504, 250, 62, 0})) << p.name;
  }
}

// The algebra itself makes no mistake at any step: alpha is above 0 wherever two indices differ. Six further stages
// multiply it by four, so that it is not rounded to 0.
TEST(IndexCompare, RealNumbersThemselvesTellAllIndicesApart) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  for (const Scale scale : {Scale::by_four, Scale::none}) {
    CombinerState state = index_comparison(scale);
    state.num_general_combiners = kMaxGeneralCombiners;
    for (std::size_t i = 2; i < kMaxGeneralCombiners; ++i) {
      state.general[i].rgb = {rgb_of(Register::spare1), kOne, kZero, kZero, ab_to(Register::spare1, Scale::by_four)};
    }
    for (const HardwareProfile& profile : {profiles::ideal, profiles::float_shader}) {
      const Program program = compile(state, profile).value();
      int mistakes_of_all = 0;
      for (int a = 0; a < 256; a += kSlowBuild ? 15 : 1) {
        for (int b = 0; b < 256; b += kSlowBuild ? 3 : 1) {
          const Rgba9 color = evaluate(program, registers_of(profile, 256 * a + b));
          if ((color[kAlpha] > 0) != (a != b)) ++mistakes_of_all;
        }
      }
      EXPECT_EQ(mistakes_of_all, 0) << profile.name;
    }
  }
}

}  // namespace
}  // namespace ninebit::test
