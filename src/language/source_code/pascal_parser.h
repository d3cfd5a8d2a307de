// Parses Pascal as far as calls and constants need it, into the tree of the C-like languages.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/source_code/code_parser.h"

namespace ninebit::code {

class PascalParser {
 public:
  // `types` are array types by name; those of the text are added.
  PascalParser(TokenCursor& in, std::map<std::string, ArrayType>& types) : in_(in), types_(types) {}

  // Whether the current token is this word, in any case.
  [[nodiscard]] bool is(std::string_view word, std::size_t ahead = 0) const;
  bool takes(std::string_view word);

  Expression expression();
  Statement statement();
  // Statements up to `end`, `until`, `else`, or the end.
  std::vector<Statement> statements();
  // The section of constants, variables or types whose word was taken, up to the next word that begins another one.
  void constants(Statement& out);
  void variables(Statement& out);
  void types(Statement& out);
  // Skips a class or a record, whose word is the current token.
  void skip_type();
  // Whether a word begins another section or a routine.
  [[nodiscard]] bool at_section() const;

 private:
  Expression simple();
  Expression term();
  Expression factor();
  Expression postfix(Expression out);
  Expression parenthesized(bool as_list);
  Statement controlled();
  Statement for_loop();
  Statement choice();
  Statement plain();
  ArrayType type();
  void dimension(ArrayType& out);
  void declare(Statement& out, const std::vector<Token>& names, const ArrayType& type, bool is_constant);
  void skip_to_semicolon();

  TokenCursor& in_;
  std::map<std::string, ArrayType>& types_;
  int depth_ = 0;
};

// A word in lower case.
[[nodiscard]] std::string pascal_word(std::string_view word);

}  // namespace ninebit::code
