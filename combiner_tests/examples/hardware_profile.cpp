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

TEST(Examples, Datapath) {
  using namespace ninebit;
  const Datapath chip = datapath_of(profiles::geforce2);
  const Datapath rival = datapath_of(profiles::geforce2_early_truncation);
  EXPECT_EQ(chip.one, 255);
  EXPECT_EQ(rival.narrowing_point, NarrowingPoint::before_scale);
  EXPECT_NE(chip, rival);
}
