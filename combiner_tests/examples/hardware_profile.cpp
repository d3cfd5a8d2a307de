#include <gtest/gtest.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, HardwareProfile) {
  using namespace ninebit;
  const HardwareProfile* chip = find_profile("nv2a");
  ASSERT_NE(chip, nullptr);
  EXPECT_EQ(name_of(chip->final_narrowing.evidence), "measured");

  HardwareProfile what_if = *chip;
  what_if.final_narrowing.value = Narrowing::toward_zero;
  what_if.final_narrowing.evidence = Evidence::assumed;
  EXPECT_TRUE(chip->final_narrowing == Narrowing::nearest_halves_up);  // a field reads as its value
  EXPECT_TRUE(what_if.final_narrowing == Narrowing::toward_zero);
}
