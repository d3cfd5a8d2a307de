// Splits source text into tokens. Reads any bytes: a character of no token is punctuation.
#pragma once

#include <cstddef>
#include <string_view>

#include "src/language/source_code/code_token.h"

namespace ninebit::code {

class Lexer {
 public:
  // Of the bytes [begin, end) of the text.
  Lexer(std::string_view text, Language language, std::size_t begin, std::size_t end)
      : text_(text.substr(0, end)), language_(language), at_(begin) {}

  Token next();
  // Whether a literal or a comment was cut by the end of the text.
  [[nodiscard]] bool cut_short() const { return cut_short_; }

 private:
  bool skip_comment();
  bool skip_blanks();
  [[nodiscard]] std::size_t number_end() const;
  std::size_t quoted_end(char quote);
  std::size_t raw_text_end(std::size_t quote);
  [[nodiscard]] std::size_t punctuation_size() const;
  [[nodiscard]] bool starts(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  std::string_view text_;
  Language language_;
  std::size_t at_;
  bool line_begins_ = true;
  bool cut_short_ = false;
};

// The language that a text is in, by its words and operators: Pascal if it has `begin` or `procedure`, and `:=`.
[[nodiscard]] Language language_of(std::string_view text);

}  // namespace ninebit::code
