#include <gtest/gtest.h>
#include <ninebit/numerics/hardware_profile.h>
#include <ninebit/study/exhaustive_sum.h>

TEST(Examples, ExhaustiveSum) {
  using namespace ninebit;
  const HardwareProfile& small = profiles::geforce256_8bit;
  const auto study =
      exhaustive_sum_study({.study = "datapath", .profile = "geforce256-8bit"}, small, {kOutputForms.data(), 1});
  ASSERT_TRUE(study.ok());
  EXPECT_EQ((*study)->units(), 255U);
  const auto rows = (*study)->run(0, {});  // A is -127; B, C and D are anything
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ(rows->front().count("cases"), 255U * 255U * 255U);
}
