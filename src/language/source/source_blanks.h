// What the hand-written lexers skip between two tokens.
#pragma once

#include <cstddef>
#include <string_view>

#include "src/language/source/source_faults.h"

namespace ninebit::detail {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // which a text may begin with

// White space and comments of C and C++ are always skipped; these a language may have besides.
struct Blanks {
  bool hash_comments = false;  // from # to the end of the line
  std::string_view heading{};  // a word that is a blank wherever it stands
};

// Moves `at` to the next token or the end of the text. A comment without its end is a fault, and the text is over: then
// the answer is false.
[[nodiscard]] bool skip_blanks(std::string_view text, std::size_t& at, const Blanks& blanks, SourceFaults& faults);

}  // namespace ninebit::detail
