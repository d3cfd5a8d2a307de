#include <gtest/gtest.h>
#include <ninebit/numerics/profile_words.h>

namespace {

// A header that only passes a profile on needs no more than its name.
bool is_default(const ninebit::HardwareProfile* profile) {
  return profile == nullptr;
}

}  // namespace

TEST(Examples, ProfileWords) {
  EXPECT_TRUE(is_default(nullptr));
  EXPECT_EQ(name_of(ninebit::Evidence::measured), "measured");
}
