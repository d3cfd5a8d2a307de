// Definitions as bare numbers: hexadecimal text, hex dumps, bytes.
#pragma once

#include <string_view>

#include "src/language/register_words/register_words_faults.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::xbox {

// Whether bytes are not text: one of them is 0.
[[nodiscard]] bool is_binary(std::string_view bytes);
// The words of 240 bytes, little endian; another size is a fault.
[[nodiscard]] Definition read_bytes(std::string_view bytes, TextFaults& faults);

// Whether a text begins like 60 numbers in hexadecimal or like a hex dump of them: a line of nothing else.
[[nodiscard]] bool is_number_list(std::string_view text);
// Reads such a text. Numbers have eight digits, or any number of them after 0x; or two or four, which are bytes in
// their order. Lines may begin with an offset and end with the bytes as characters. Any other count than 60 words is a
// fault.
[[nodiscard]] Definition read_number_list(std::string_view text, TextFaults& faults);

}  // namespace ninebit::xbox
