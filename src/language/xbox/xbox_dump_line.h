// One line of a hex dump, token by token.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "src/language/xbox/xbox_dump.h"

namespace ninebit::xbox {

// Takes the first line out of a text; the line has no line feed.
[[nodiscard]] std::string_view take_line(std::string_view& text);

[[nodiscard]] bool is_hex_number(const DumpNumber& number);
// Whether a token may be the offset of a row: hexadecimal, or WinDbg's "00000000`00123450".
[[nodiscard]] bool is_row_offset(const DumpNumber& number);
// How many bytes the number of a row stands for.
[[nodiscard]] std::size_t bytes_of(const DumpNumber& number);

// Splits a line at blanks and commas, up to a comment or to the characters behind a |. "00-00" are two numbers, as
// WinDbg's db writes the middle of a row.
class DumpLine {
 public:
  DumpLine(std::string_view line, int number);

  // The next token; empty at the end of the line.
  [[nodiscard]] std::optional<DumpNumber> take();

  // Whether the token that was taken last is the first of its line.
  [[nodiscard]] bool leads() const { return taken_ == 1; }
  // Whether the token that was taken last begins the bytes shown as characters, not more numbers.
  [[nodiscard]] bool in_characters() const { return in_characters_; }

 private:
  [[nodiscard]] bool begins_characters(const DumpNumber& number, std::size_t gap, std::size_t end_of_last) const;

  std::string_view line_, rest_;
  int number_;
  std::size_t at_ = 0, taken_ = 0;
  std::size_t data_ = 0, bytes_ = 0, width_ = 0;  // of the numbers behind the offset
  bool has_colon_ = false, has_offset_ = false, has_single_gap_ = false, in_characters_ = false;
};

}  // namespace ninebit::xbox
