#include <gtest/gtest.h>
#include <ninebit/numerics/profile_fields.h>

TEST(Examples, ProfileFields) {
  using namespace ninebit;
  const ProfileField* const half = find_profile_field("half");
  ASSERT_NE(half, nullptr);
  EXPECT_EQ(half->get(profiles::geforce2).value, 128);

  HardwareProfile mine = profiles::geforce2;
  half->set(mine, {127, Evidence::assumed, "what if?"});
  EXPECT_EQ(half->word_of(half->get(mine).value), "127");
}
