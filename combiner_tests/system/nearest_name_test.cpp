// Which names are suggested for one that is not known.
#include "src/system/nearest_name.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
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

// The whole table, by the definition.
std::size_t changes(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        least[i][j] = i + j;
        continue;
      }
      least[i][j] = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
      }
    }
  }
  return least[a.size()][b.size()];
}

TEST(NameChanges, AreThoseOfTheDefinitionUpToABound) {
  std::mt19937 random(3);
  std::vector<int> met(5);
  for (int round = 0; round < 20'000; ++round) {
    const auto word = [&] {
      std::string letters;
      for (std::size_t n = random() % 9; n > 0; --n) letters += static_cast<char>('a' + random() % 3);
      return letters;
    };
    const std::string a = word(), b = word();
    const std::size_t most = random() % 4, right = changes(a, b), found = name_changes(a, b, most);
    if (right <= most) {
      ASSERT_EQ(found, right) << a << ' ' << b << ' ' << most;
    } else {
      ASSERT_GT(found, most) << a << ' ' << b;
    }
    ++met[std::min<std::size_t>(right, 4)];
  }
  for (const int count : met) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace ninebit
