#include <gtest/gtest.h>
#include <ninebit/numerics/codes.h>

TEST(Examples, Codes) {
  using namespace ninebit;
  // A colour of glColor4f as bytes, which are the codes of a register with nine bits.
  const Rgba9 color{byte_of_color(1.0F), byte_of_color(0.5F), byte_of_color(0.0F), byte_of_color(1.0F)};
  EXPECT_EQ(color[kRed], 255);
  EXPECT_EQ(color[kGreen], 128);
}
