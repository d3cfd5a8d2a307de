// Which names are suggested for one that is not known.
#include "src/language/source/nearest_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ninebit {
namespace {

std::string nearest(std::string_view wrong, const std::vector<std::string>& names) {
  return nearest_name(wrong, names).value_or("");
}

TEST(NearestName, AThirdOfTheLettersMayBeWrong) {
  EXPECT_EQ(nearest("rendr", {"trace", "render"}), "render");
  EXPECT_EQ(nearest("abx", {"abc"}), "abc") << "1 of 3";
  EXPECT_EQ(nearest("ax", {"ab"}), "") << "1 of 2";
  EXPECT_EQ(nearest("abcdxx", {"abcdef"}), "abcdef") << "2 of 6";
  EXPECT_EQ(nearest("abcxx", {"abcde"}), "") << "2 of 5";
}

TEST(NearestName, NoMoreThanThreeChanges) {
  EXPECT_EQ(nearest("abcdefghixxx", {"abcdefghijkl"}), "abcdefghijkl") << "3 of 12";
  EXPECT_EQ(nearest("abcdefghxxxx", {"abcdefghijkl"}), "") << "4 of 12";
}

TEST(NearestName, TheNearestAndOfSeveralTheFirst) {
  EXPECT_EQ(nearest("color1", {"colour2", "color2", "color3"}), "color2");
  EXPECT_EQ(nearest("redner", {"render"}), "render") << "neighbours that are swapped are one change";
  EXPECT_EQ(nearest("RENDER", {"render"}), "render") << "case is no change";
}

TEST(NearestName, TextsAsLongAsAPageAreNotNames) {
  EXPECT_EQ(nearest(std::string(64, 'a'), {std::string(64, 'a')}), std::string(64, 'a'));
  EXPECT_EQ(nearest(std::string(65, 'a'), {std::string(64, 'a')}), "");
}

}  // namespace
}  // namespace ninebit
