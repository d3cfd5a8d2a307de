// Programs inside string literals of C, C++ or Java, as they stand in sources.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "ninebit/language/source_text.h"

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {

// The contents of the literals in the bytes [begin, end) of a source: as many bytes, in which escapes have their
// meaning and everything outside of the literals is blank.
class LiteralText {
 public:
  LiteralText(const SourceText& source, std::size_t begin, std::size_t end);

  // For parsers: faults get their places in the source. Valid as long as this object and the source.
  [[nodiscard]] SourceText source() const;

 private:
  SourceText source_;
  std::size_t begin_;
  std::string text_;
};

// Where string literals that belong together end: one after the other, or with +, commas or comments between them, from
// the quote at `begin`.
[[nodiscard]] std::size_t end_of_literals(std::string_view text, std::size_t begin);

// The quote of the first string literal of C whose content begins with `header`, after blanks; npos: there is none.
[[nodiscard]] std::size_t find_literal(std::string_view text, std::string_view header, std::size_t from = 0);

}  // namespace ninebit
