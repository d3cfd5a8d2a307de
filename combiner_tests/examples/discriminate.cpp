#include <gtest/gtest.h>
#include <ninebit/study/discriminate.h>

TEST(Examples, Discriminate) {
  using namespace ninebit;
  const auto found = discriminate(profiles::geforce2, profiles::geforce2_early_truncation);
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found->answer, ProofAnswer::refuted);
  EXPECT_NE(found->a, found->b);  // the bytes that the two show
  EXPECT_EQ(found->found->shown(profiles::geforce2), found->a);
  EXPECT_EQ(found->found->rc10.substr(0, 7), "!!RC1.0");
}
