#include <gtest/gtest.h>
#include <ninebit/numerics/half.h>

TEST(Examples, Half) {
  using namespace ninebit;
  const Half third = half_of(1.0F / 3.0F);
  EXPECT_EQ(third.bits, 0x3555);
  EXPECT_EQ(float_of(third), 0.333251953125F);
}
