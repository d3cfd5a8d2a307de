// Splits C-like text into tokens. Reads any bytes: a character of no token is punctuation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

// A token as a message shows it: "'psd'", "the end of the text".
[[nodiscard]] std::string shown(const Token& token);

// The preprocessor's words.
inline constexpr std::array<std::string_view, 12> kDirectives{"define", "undef", "include", "if",   "ifdef", "ifndef",
                                                              "elif",   "else",  "endif",   "line", "error", "pragma"};

// How closely a binary operator of C binds, from 1 for ||; 0: the token is not one.
[[nodiscard]] int precedence(const Token& token);
// Whether a token is = or += and the like.
[[nodiscard]] bool is_assignment(const Token& token);

// Whether the # at a place of a text begins a directive.
[[nodiscard]] bool begins_directive(std::string_view text, std::size_t at);

class Lexer {
 public:
  // `hash_comments`: text from # to the end of the line is a comment, too, unless a directive follows.
  explicit Lexer(std::string_view text, bool hash_comments = false) : text_(text), hash_comments_(hash_comments) {}

  Token next();
  // Goes on at a byte.
  void move_to(std::size_t at);
  // Where a comment begins that does not end; it ended the text.
  [[nodiscard]] std::optional<std::size_t> unterminated() const { return unterminated_; }

 private:
  bool skip_comment();
  bool skip_blanks();
  [[nodiscard]] std::size_t number_end() const;
  [[nodiscard]] std::size_t quoted_end(char quote) const;
  [[nodiscard]] std::size_t raw_text_end(std::size_t quote) const;
  [[nodiscard]] std::size_t punctuation_size() const;
  [[nodiscard]] bool starts(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  std::string_view text_;
  bool hash_comments_;
  std::size_t at_ = 0;
  bool line_begins_ = true;
  std::optional<std::size_t> unterminated_{};
};

// All tokens of a text; the last is Kind::end.
[[nodiscard]] std::vector<Token> tokens_of(std::string_view text);

// A lexer with one token of lookahead; a copy goes on from the same place.
class TokenReader {
 public:
  explicit TokenReader(std::string_view text, bool hash_comments = false)
      : text_(text), lexer_(text, hash_comments), next_(lexer_.next()) {}

  [[nodiscard]] const Token& peek() const { return next_; }
  [[nodiscard]] bool at_end() const { return next_.kind == Token::Kind::end; }
  Token take();
  // Takes the next token if it is this one; whether it was.
  bool takes(std::string_view what);
  // Goes on at a byte.
  void move_to(std::size_t at);
  // Skips the rest of the line in which the next token begins.
  void skip_line() { move_to(text_.find_first_of("\r\n", next_.offset)); }
  // Skips what may stand behind an array: lines of the preprocessor and declarations of single numbers, such as the
  // length that xxd -i prints. Returns the first token of what else stands there, whose names it took.
  [[nodiscard]] std::optional<Token> skip_behind_array();
  // Where the token ends that was taken last.
  [[nodiscard]] std::size_t end_of_last() const { return end_of_last_; }
  [[nodiscard]] std::optional<std::size_t> unterminated() const { return lexer_.unterminated(); }

 private:
  std::string_view text_;
  Lexer lexer_;
  Token next_;
  std::size_t end_of_last_ = 0;
};

}  // namespace ninebit::code
