// The tokens of C that a definition is written in, with their places.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/language/source_text.h"
#include "src/language/c_like/c_lexer.h"

namespace ninebit::xbox {

struct Token : code::Token {
  TextPlace place{};
};

// A token as a message shows it: "'psd'", "the end of the text".
[[nodiscard]] std::string shown(const Token& token);

// One token ahead; a copy goes on from the same place. Text from # to the end of the line is a comment, too, unless a
// directive of the preprocessor follows.
class Lexer {
 public:
  explicit Lexer(std::string_view text);

  [[nodiscard]] const Token& peek() const { return next_; }
  // Returns the token ahead, and reads the one after it.
  Token take();
  // Moves past the rest of the line of the token ahead.
  void skip_line();
  // Where a comment begins that does not end; it ended the text.
  [[nodiscard]] std::optional<TextPlace> unterminated() const;

 private:
  void read();
  [[nodiscard]] bool is_directive() const;

  std::string_view text_;
  code::TokenReader reader_;
  std::size_t counted_ = 0, line_start_ = 0;  // bytes whose line feeds are counted
  int line_ = 1;
  Token next_{};
};

}  // namespace ninebit::xbox
