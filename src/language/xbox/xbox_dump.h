// Lists of hexadecimal numbers and the hex dumps of xxd, hexdump, od and WinDbg, as rows of numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "src/language/register_words/register_words_faults.h"

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

}  // namespace ninebit::xbox
