#include <gtest/gtest.h>
#include <ninebit/numerics/fixed9.h>

TEST(Examples, Fixed9) {
  using namespace ninebit;
  const HardwareProfile& chip = profiles::geforce2;
  const s9 code = from_byte(chip, 51);
  EXPECT_DOUBLE_EQ(to_real(chip, code), 0.2);
  EXPECT_EQ(to_byte(chip, code), 51);
  EXPECT_EQ(to_byte(chip, -7), 0);  // the frame buffer has no negative colours
  EXPECT_EQ(byte_of_color(0.5F), 128);
}
