#include <gtest/gtest.h>
#include <ninebit/language/register_words.h>
#include <ninebit/numerics/hardware_profile.h>

#include <string>

TEST(Examples, RegisterWords) {
  using namespace ninebit;
  const Result<std::string> words = print_register_words(CombinerState{}, ChipClass::nv10, profiles::geforce2);
  ASSERT_TRUE(words.ok());
  EXPECT_NE(words->find("RC_IN_RGB[0] = 0x"), std::string::npos);
  const auto state = parse_register_words({*words, "dump.txt"}, ChipClass::nv10, profiles::geforce2);
  EXPECT_EQ(*state, CombinerState{});
}
