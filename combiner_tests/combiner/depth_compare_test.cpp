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
  state.general[0].rgb = {rgb_of(Register::texture0), kOne, rgb_of(Register::texture1), kMinusOne,
                          sum_to(Register::spare0)};
  state.general[0].alpha = {alpha_of(Register::texture1), kOneAlpha,
                            alpha_of(Register::texture0, InputMapping::unsigned_invert), kOneAlpha,
                            sum_to(Register::spare0, Scale::none, Bias::by_negative_one_half)};
  state.general[1].alpha = {blue_of(Register::spare0), kOneAlpha, kZeroAlpha, kZeroAlpha, mux_to(Register::spare0)};
  return state;
}

// The pairs for which the program does not take AB where tex1.a <= tex0.a and CD where it is larger.
int wrong_decisions(const HardwareProfile& profile) {
  std::vector<RegisterFile> fragments;
  for (int i = 0; i < 65536; ++i) {
    FragmentInputs inputs;
    inputs.texture[0] = Texel{.value = {0, 0, 255, static_cast<std::uint8_t>(i / 256)}};
    inputs.texture[1] = Texel{.value = {0, 0, 0, static_cast<std::uint8_t>(i)}};
    fragments.push_back(initial_registers(profile, inputs));
  }
  int wrong = 0, i = 0;
  for (const Fragment& fragment : judged(depth_compare(), profile, fragments)) {
    const int alpha = fragment.color[kAlpha], first = i / 256, second = i % 256;
    EXPECT_TRUE(alpha == 0 || alpha == profile.one) << alpha;
    if ((alpha != 0) != (second <= first)) ++wrong;
    ++i;
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
