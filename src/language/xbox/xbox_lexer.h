// The tokens of C that a definition is written in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/language/source_text.h"

namespace ninebit::xbox {

enum class TokenKind : std::uint8_t { end, name, number, mark };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text{};  // a mark: one character, or one of -> << >> |=
  TextPlace place{};

  [[nodiscard]] bool is(std::string_view mark) const { return kind == TokenKind::mark && text == mark; }
  [[nodiscard]] bool is_name(std::string_view name) const { return kind == TokenKind::name && text == name; }
};

// A token as a message shows it: "'psd'", "the end of the text".
[[nodiscard]] std::string shown(const Token& token);

// One token ahead; a copy goes on from the same place. Skips white space and comments of C, C++, and from # to the end
// of the line unless a directive of the preprocessor follows, which comes as a mark "#". An unterminated comment ends
// the text.
class Lexer {
 public:
  explicit Lexer(std::string_view text);

  [[nodiscard]] const Token& peek() const { return next_; }
  // Returns the token ahead, and reads the one after it.
  Token take();
  // Moves past the rest of the line that the token ahead ends in.
  void skip_line();
  // Where a comment begins that does not end; it ended the text.
  [[nodiscard]] std::optional<TextPlace> unterminated() const { return unterminated_; }

 private:
  void advance(std::size_t to);
  void skip_blanks();
  [[nodiscard]] Token read();
  [[nodiscard]] TextPlace place() const { return {line_, 1 + static_cast<int>(at_ - line_start_)}; }
  [[nodiscard]] bool is_directive() const;

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  std::optional<TextPlace> unterminated_{};
  Token next_{};
};

}  // namespace ninebit::xbox
