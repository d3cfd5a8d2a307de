// Rule 22: NVIDIA's 16-bit depth compare of 2000, the high bytes' part of it, must decide every pair rightly.
#include <gtest/gtest.h>

#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/initial_registers.h"

namespace ninebit::test {
namespace {

// Stage 0: spare0.rgb = tex0.rgb - tex1.rgb, spare0.a = tex1.a + (1 - tex0.a) - 1/2.
// Stage 1, alpha: mux(AB = spare0.b, CD = 0).
CombinerState depth_compare() {
  CombinerState state = silent_state(2);
  Portion& rgb = state.general[0].rgb;
  rgb.a = rgb_of(Register::texture0);
  rgb.b = kOne;
  rgb.c = rgb_of(Register::texture1);
  rgb.d = kMinusOne;
  rgb.out.sum = Register::spare0;
  Portion& alpha = state.general[0].alpha;
  alpha.a = alpha_of(Register::texture1);
  alpha.b = alpha.d = kOneAlpha;
  alpha.c = alpha_of(Register::texture0, InputMapping::unsigned_invert);
  alpha.out.sum = Register::spare0;
  alpha.out.bias = Bias::by_negative_one_half;
  Portion& choice = state.general[1].alpha;
  choice.a = blue_of(Register::spare0);
  choice.b = kOneAlpha;
  choice.c = choice.d = kZeroAlpha;
  choice.out.sum = Register::spare0;
  choice.out.mux_sum = true;
  return state;
}

// The pairs for which the program does not take AB where tex1.a <= tex0.a and CD where it is larger.
int wrong_decisions(const HardwareProfile& profile) {
  int wrong = 0;
  for (int first = 0; first < 256; ++first) {
    std::vector<RegisterFile> fragments(256);
    for (int second = 0; second < 256; ++second) {
      FragmentInputs inputs;
      inputs.texture[0] = Texel{.value = {0, 0, 255, static_cast<std::uint8_t>(first)}};
      inputs.texture[1] = Texel{.value = {0, 0, 0, static_cast<std::uint8_t>(second)}};
      fragments[static_cast<std::size_t>(second)] = initial_registers(profile, inputs);
    }
    const std::vector<Fragment> results = judged(depth_compare(), profile, fragments);
    for (int second = 0; second < 256; ++second) {
      const int alpha = results[static_cast<std::size_t>(second)].color[kAlpha];
      EXPECT_TRUE(alpha == 0 || alpha == profile.one) << alpha;
      const bool took_ab = alpha != 0;
      if (took_ab != (second <= first)) ++wrong;
    }
  }
  return wrong;
}

TEST(DepthCompare, NoPairOf65536IsDecidedWrongly) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  EXPECT_EQ(wrong_decisions(profiles::geforce2), 0);
  EXPECT_EQ(wrong_decisions(profiles::nv2a), 0);
  EXPECT_EQ(wrong_decisions(profiles::geforce2_early_truncation), 0);
}

TEST(DepthCompare, AHalfOf127DecidesEqualBytesWrongly) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  // 255 - 127 = 128 for equal bytes, and 127 for bytes that differ by one: at or above the threshold of 127.
  HardwareProfile rival = profiles::geforce2;
  rival.half.value = 127;
  EXPECT_EQ(wrong_decisions(rival), 256 + 255);
}

// In real numbers equal bytes give exactly one half, which is not below the threshold: they take CD.
TEST(DepthCompare, ExactArithmeticDecidesAllEqualBytesWrongly) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  EXPECT_EQ(wrong_decisions(profiles::ideal), 256);
}

// Floats round n / 255 and 1 - n / 255, but the two add up to 1 for every n, so that chance does not help them.
TEST(DepthCompare, FloatsDecideEqualBytesWronglyToo) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  EXPECT_EQ(wrong_decisions(profiles::float_shader), 256);
}

}  // namespace
}  // namespace ninebit::test
