#include <gtest/gtest.h>
#include <ninebit/study/chip_kit.h>

#include <vector>

TEST(Examples, ChipKit) {
  using namespace ninebit;
  const Result<ChipKit> kit = make_chip_kit(profiles::geforce2);
  ASSERT_TRUE(kit.ok());
  const std::vector<int>& card = kit->shown[0];  // the bytes that a card shows, one for each program
  const KitVerdict verdict = decide(*kit, card);
  ASSERT_FALSE(verdict.fitting.empty());
  EXPECT_EQ(kit->shown[verdict.fitting[0]], card);
}
