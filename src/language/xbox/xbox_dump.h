// Lists of hexadecimal numbers and the hex dumps of xxd, hexdump, od and WinDbg, as rows of numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "src/language/source/source_faults.h"

namespace ninebit::xbox {

// More numbers than any dump of one definition has; reading on would only repeat that fault.
inline constexpr std::size_t kMostNumbers = 1000;

struct DumpNumber {
  std::string_view digits{};  // without 0x and suffix
  TextPlace place{};
  bool prefixed = false;   // with 0x
  bool is_offset = false;  // with a colon, or as WinDbg writes 64 bits
};

// The numbers of a dump in their order. Offsets are left out, and rows that '*' stands for are repeated.
struct DumpNumbers {
  std::vector<DumpNumber> numbers{};  // at most kMostNumbers + 1
  // Whether groups of four digits are numbers of 16 bits, little endian, and not two bytes in their order: hexdump, od
  // and WinDbg write no colon behind the offset, xxd does.
  bool little_endian_halves = false;
};
[[nodiscard]] DumpNumbers read_dump(std::string_view text, TextFaults& faults);

// Whether a text begins with a line of hexadecimal numbers, or like a hex dump.
[[nodiscard]] bool is_number_list(std::string_view text);

// Whether the text is a hex dump: each row has an offset, which is that of the row above plus its bytes. Looks at the
// first rows. Exported because form_of() is in another shared library.
[[nodiscard]] NINEBIT_PUBLIC bool is_hex_dump(std::string_view text);

// One line of a hex dump, token by token.

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
