// Skips white space and comments between two tokens, for the hand-written lexers.
#pragma once

#include <cstddef>
#include <string_view>

#include "src/language/source/source_faults.h"

namespace ninebit::detail {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // a text may begin with it

// White space and the comments of C and C++ are always skipped. A language may also have these.
struct Blanks {
  bool hash_comments = false;  // from # to the end of the line
  std::string_view heading{};  // a word that is skipped like white space
};

// Moves `at` to the next token or the end of the text. An unterminated comment is a fault and ends the text; the result
// is then false.
[[nodiscard]] bool skip_blanks(std::string_view text, std::size_t& at, const Blanks& blanks, SourceFaults& faults);

}  // namespace ninebit::detail
