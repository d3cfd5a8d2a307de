// Definitions as C arrays of numbers: "DWORD ps[60] = {…};", and files that xxd -i prints.
#pragma once

#include <string_view>

#include "src/language/register_words/register_words_faults.h"
#include "src/language/xbox/xbox_fields.h"

namespace ninebit::xbox {

// Whether a text begins with an array of numbers, or is 240 numbers in braces.
[[nodiscard]] bool is_number_array(std::string_view text);
// Whether it has exactly the 60 words or 240 bytes of a definition, and is not of a type of OpenGL.
[[nodiscard]] bool is_definition_array(std::string_view text);

// Reads a text for which is_number_array() is true. The type says how large an element is; for an unknown type 240
// numbers are bytes, others are words. Behind the array only declarations of single numbers may follow, such as
// xxd's "unsigned int ps_len = 240;".
[[nodiscard]] Definition read_array(std::string_view text, TextFaults& faults);

}  // namespace ninebit::xbox
