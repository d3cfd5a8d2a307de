// Splits C-like text into tokens. Reads any bytes: a character of no token is punctuation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

// The tokens of a C-like text: C, C++, Java and the like.

namespace ninebit::code {

struct Token {
  enum class Kind : std::uint8_t { end, name, number, text, character, punctuation };
  Kind kind = Kind::end;
  bool begins_line = false;  // the first of its line
  bool after_blank = false;  // white space or a comment stands before it
  bool is_final = false;     // the name of a macro in its own expansion, which is not expanded again
  bool is_made = false;      // macros made it, or it stands in an included file: its bytes are those of another token
  std::uint32_t offset = 0;  // bytes of the source; of a token from a macro: those of the macro's use
  std::uint32_t end = 0;
  std::string_view text{};  // as written, a literal with its quotes

  [[nodiscard]] bool is(std::string_view spelled) const {
    return text == spelled && (kind == Kind::punctuation || kind == Kind::name);
  }
  [[nodiscard]] bool is_name() const { return kind == Kind::name; }
};

// How closely a binary operator of C binds, from 1 for ||; 0: the token is not one.
[[nodiscard]] int precedence(const Token& token);

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
