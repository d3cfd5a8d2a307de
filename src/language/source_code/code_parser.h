// Parses C, C++, Java and C# as far as calls and constants need it. Whatever it cannot read becomes an unreadable
// statement or expression, and reading goes on behind it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "src/language/source_code/code_file.h"
#include "src/language/source_code/code_tree.h"

namespace ninebit::code {

// The tokens that a parser reads.
class TokenCursor {
 public:
  TokenCursor(const File& file, std::size_t begin, std::size_t end)
      : file_(file), tokens_(file.tokens), at_(begin), end_(end) {}

  // The token `ahead` of the current one; Kind::end at the end.
  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
    return at_ + ahead < end_ ? tokens_[at_ + ahead] : end_token_;
  }
  const Token& take() { return at_ < end_ ? tokens_[at_++] : end_token_; }
  bool takes(std::string_view what) {
    if (!peek().is(what)) return false;
    ++at_;
    return true;
  }
  [[nodiscard]] bool at_end() const { return at_ >= end_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] const File& file() const { return file_; }
  void move_to(std::size_t at) { at_ = at; }
  // The byte at which the token before the current one ends.
  [[nodiscard]] std::uint32_t last_end() const { return at_ == 0 ? 0 : tokens_[at_ - 1].end; }
  // Goes behind the bracket that closes the one at the current place, or to the end. At another token, skips that.
  void skip_brackets() { at_ = std::min<std::size_t>(at_ < end_ ? file_.closing[at_] + std::size_t{1} : end_, end_); }

 private:
  const File& file_;
  const std::vector<Token>& tokens_;
  std::size_t at_, end_;
  Token end_token_{};
};

// Expressions with C's operators and precedence, and the casts, `new` and named casts of the other languages.
class ExpressionParser {
 public:
  explicit ExpressionParser(TokenCursor& in) : in_(in) {}

  // With a comma operator only where `commas` is set.
  Expression expression(bool commas = false);
  // { … }, whose brace is the next token.
  Expression list(std::string_view close);

 private:
  Expression assignment();
  Expression binary(int least);
  Expression unary();
  Expression postfix();
  Expression primary();
  Expression literals(const Token& begin);
  Expression parenthesis();
  Expression creation(const Token& begin);
  Expression designated_element();
  Expression named(const Token& begin);
  Expression fail(const Token& at) const;
  [[nodiscard]] bool is_cast() const;
  void skip_template_arguments();

  TokenCursor& in_;
  int depth_ = 0;
};

class StatementParser {
 public:
  StatementParser(TokenCursor& in, Outline& outline) : in_(in), outline_(outline), expressions_(in) {}

  // All statements up to the end.
  std::vector<Statement> statements();
  Statement statement();
  // Whether a declaration begins at the current token.
  [[nodiscard]] bool is_declaration() const;
  Statement declaration();
  // struct, class, union or enum with its body, and what is declared with it; empty: there is no body here.
  bool type_definition(Statement& out);

 private:
  Statement controlled(const Token& keyword);
  Statement branch(const Token& keyword);
  Statement loop(const Token& keyword);
  bool for_each(Statement& out);
  Statement choice(const Token& keyword);
  Statement block();
  Statement plain();
  void declarators(Statement& out, std::string_view type, bool is_constant);
  bool condition(Statement& out);
  void enumerators(Statement& out);
  Members members(Statement& out);
  void array_type();
  Statement unreadable(std::size_t begin, const std::string& expected);

  TokenCursor& in_;
  Outline& outline_;
  ExpressionParser expressions_;
  int depth_ = 0;
};

// The functions, declarations and other code of a whole C-like file.
[[nodiscard]] Outline read_outline(const File& file);

// The same of a Pascal file.
[[nodiscard]] Outline read_pascal_outline(const File& file);
// The statements of a Pascal function's body.
[[nodiscard]] std::vector<Statement> read_pascal_body(const File& file, const Function& function, Outline& outline);

}  // namespace ninebit::code
