#include <gtest/gtest.h>
#include <ninebit/numerics/datapath.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, Datapath) {
  using namespace ninebit;
  const Datapath chip = datapath_of(profiles::geforce2);
  const Datapath rival = datapath_of(profiles::geforce2_early_truncation);
  EXPECT_EQ(chip.one, 255);
  EXPECT_EQ(rival.narrowing_point, NarrowingPoint::before_scale);
  EXPECT_NE(chip, rival);
}
