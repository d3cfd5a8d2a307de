// Definitions as bare numbers: bytes, hexadecimal text and hex dumps, C arrays.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "src/language/source/source_faults.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::xbox {

// Whether bytes are not text: one of them is 0.
[[nodiscard]] bool is_binary(std::string_view bytes);
// Whether bytes are a file with the magic "PSB0" before the definition, or one that is damaged.
[[nodiscard]] bool is_definition_file(std::string_view bytes);
// The words of 240 bytes, little endian, after "PSB0" or without it; another size is a fault.
[[nodiscard]] Definition read_bytes(std::string_view bytes, detail::SourceFaults& faults);

// Lists of hexadecimal numbers and the hex dumps of xxd, hexdump, od and WinDbg, as rows of numbers.

// More numbers than any dump of one definition has; reading on would only repeat that fault.
inline constexpr std::size_t kMostNumbers = 1000;

struct DumpNumber {
  std::string_view digits{};   // without 0x and suffix
  std::size_t offset = 0;      // in the text
  bool prefixed = false;       // with 0x
  bool is_row_offset = false;  // with a colon, or as WinDbg writes 64 bits
};
[[nodiscard]] bool is_hex_number(const DumpNumber& number);

// The numbers of a dump in their order. Offsets are left out, and rows that '*' stands for are repeated.
struct DumpNumbers {
  std::vector<DumpNumber> numbers{};  // at most kMostNumbers + 1
  // Whether groups of four digits are numbers of 16 bits, little endian, and not two bytes in their order: hexdump, od
  // and WinDbg write no colon behind the offset, xxd does.
  bool little_endian_halves = false;
};
[[nodiscard]] DumpNumbers read_dump(std::string_view text, detail::SourceFaults& faults);

// Whether a text begins with a line of hexadecimal numbers, or like a hex dump.
[[nodiscard]] bool is_number_list(std::string_view text);

// Whether the text is a hex dump: each row has an offset, which is that of the row above plus its bytes. Looks at the
// first rows. Exported because form_of() is in another shared library.
[[nodiscard]] NINEBIT_PUBLIC bool is_hex_dump(std::string_view text);

// Reads a text for which is_number_list() is true. Numbers have eight digits, or any number of them after 0x; or two,
// which are bytes in their order; or four, which are two bytes in their order, or 16 bits in little endian in a dump
// whose offsets have no colon. Lines may begin with an offset and end with the bytes as characters; '*' repeats the row
// above. Any other count than 60 words is a fault.
[[nodiscard]] Definition read_number_list(std::string_view text, detail::SourceFaults& faults);

// Definitions as C arrays of numbers: "DWORD ps[60] = {…};", and files that xxd -i prints.

// Whether a text begins with an array of numbers, or is 240 numbers in braces.
[[nodiscard]] bool is_number_array(std::string_view text);
// Whether it has exactly the 60 words or 240 bytes of a definition, and is not of a type of OpenGL.
[[nodiscard]] bool is_definition_array(std::string_view text);

// Reads a text for which is_number_array() is true. The type says how large an element is; for an unknown type 240
// numbers are bytes, others are words. Behind the array only declarations of single numbers may follow, such as
// xxd's "unsigned int ps_len = 240;".
[[nodiscard]] Definition read_array(const SourceText& source, detail::SourceFaults& faults);

}  // namespace ninebit::xbox
