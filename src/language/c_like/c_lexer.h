// Splits C-like text into tokens. Reads any bytes: a character of no token is punctuation.
#pragma once

#include <cstddef>
#include <string_view>

#include "src/language/c_like/c_token.h"

namespace ninebit::code {

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  Token next();

 private:
  bool skip_comment();
  bool skip_blanks();
  [[nodiscard]] std::size_t number_end() const;
  [[nodiscard]] std::size_t quoted_end(char quote) const;
  [[nodiscard]] std::size_t raw_text_end(std::size_t quote) const;
  [[nodiscard]] std::size_t punctuation_size() const;
  [[nodiscard]] bool starts(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  std::string_view text_;
  std::size_t at_ = 0;
  bool line_begins_ = true;
};

}  // namespace ninebit::code
