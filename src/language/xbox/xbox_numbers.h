// Definitions as bare numbers: hexadecimal text, hex dumps, bytes.
#pragma once

#include <string_view>

#include "src/language/source/source_faults.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::xbox {

// Whether bytes are not text: one of them is 0.
[[nodiscard]] bool is_binary(std::string_view bytes);
// Whether bytes are a file with the magic "PSB0" before the definition, or one that is damaged.
[[nodiscard]] bool is_definition_file(std::string_view bytes);
// The words of 240 bytes, little endian, after "PSB0" or without it; another size is a fault.
[[nodiscard]] Definition read_bytes(std::string_view bytes, TextFaults& faults);

// Reads a text for which is_number_list() is true. Numbers have eight digits, or any number of them after 0x; or two,
// which are bytes in their order; or four, which are two bytes in their order, or 16 bits in little endian in a dump
// whose offsets have no colon. Lines may begin with an offset and end with the bytes as characters; '*' repeats the row
// above. Any other count than 60 words is a fault.
[[nodiscard]] Definition read_number_list(std::string_view text, TextFaults& faults);

// Adds a fault if the count of `what` ("bytes") is not that of a definition.
void check_count(std::size_t found, std::string_view what, std::size_t expected, TextPlace place, TextFaults& faults);

// Definitions as C arrays of numbers: "DWORD ps[60] = {…};", and files that xxd -i prints.

// Whether a text begins with an array of numbers, or is 240 numbers in braces.
[[nodiscard]] bool is_number_array(std::string_view text);
// Whether it has exactly the 60 words or 240 bytes of a definition, and is not of a type of OpenGL.
[[nodiscard]] bool is_definition_array(std::string_view text);

// Reads a text for which is_number_array() is true. The type says how large an element is; for an unknown type 240
// numbers are bytes, others are words. Behind the array only declarations of single numbers may follow, such as
// xxd's "unsigned int ps_len = 240;".
[[nodiscard]] Definition read_array(std::string_view text, TextFaults& faults);

}  // namespace ninebit::xbox
