#include "src/system/lines.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ninebit {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) lines.emplace_back(take_line(text));
  return lines;
}

TEST(Lines, OfAText) {
  EXPECT_EQ(lines_of(""), std::vector<std::string>{});
  EXPECT_EQ(lines_of("\n"), std::vector<std::string>{""});
  EXPECT_EQ(lines_of("a\r\n\nb\rc\n"), (std::vector<std::string>{"a", "", "b\rc"}));
  EXPECT_EQ(lines_of("a\nb"), (std::vector<std::string>{"a", "b"}));
}

TEST(Lines, MarksAndBlanks) {
  EXPECT_EQ(without_mark("\xEF\xBB\xBF"
                         "a"),
            "a");
  EXPECT_EQ(without_mark("\xEF\xBB"), "\xEF\xBB");
  EXPECT_EQ(trimmed(" \ta b\t "), "a b");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed("\ra", "\r"), "a");
}

// The lines of a text that is cut into pieces of `size` bytes; "!" stands for one that is too long.
std::vector<std::string> lines_in_pieces(std::string_view text, std::size_t size, std::size_t longest) {
  LinePieces pieces(longest);
  std::vector<std::string> lines;
  const auto take = [&](std::string_view line) {
    lines.emplace_back(pieces.too_long() ? "!" : line);
    EXPECT_EQ(pieces.number(), lines.size());
  };
  for (; !text.empty(); text.remove_prefix(std::min(size, text.size()))) {
    pieces.add(text.substr(0, size));
    while (const auto line = pieces.next()) take(*line);
  }
  if (const auto line = pieces.last()) take(*line);
  EXPECT_FALSE(pieces.last());
  return lines;
}

TEST(Lines, PiecesOfAnySizeGiveTheSameLines) {
  for (std::size_t size = 1; size < 12; ++size) {
    EXPECT_EQ(lines_in_pieces("", size, 4), std::vector<std::string>{}) << size;
    EXPECT_EQ(lines_in_pieces("\n\nab\r\n", size, 4), (std::vector<std::string>{"", "", "ab\r"})) << size;
    EXPECT_EQ(lines_in_pieces("abcd\nabcde\nb", size, 4), (std::vector<std::string>{"abcd", "!", "b"})) << size;
    EXPECT_EQ(lines_in_pieces("\nabcde", size, 4), (std::vector<std::string>{"", "!"})) << size;
  }
}

TEST(Lines, ALineThatHasBegunIsTooLongBeforeItsEnd) {
  LinePieces pieces(4);
  pieces.add("abc");
  EXPECT_FALSE(pieces.next());
  EXPECT_FALSE(pieces.too_long());
  pieces.add("de");
  EXPECT_FALSE(pieces.next());
  EXPECT_TRUE(pieces.too_long());
  EXPECT_EQ(pieces.number(), 0U);
}

}  // namespace
}  // namespace ninebit
