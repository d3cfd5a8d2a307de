// The C tokens that GL calls need.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "src/language/source/source_faults.h"

namespace ninebit::detail {

struct GlToken {
  enum class Kind { end, name, number, punctuation, unknown };
  Kind kind = Kind::end;
  std::size_t offset = 0;
  std::string_view text;

  [[nodiscard]] bool is(char c) const { return kind == Kind::punctuation && text.front() == c; }
  [[nodiscard]] bool is(std::string_view name) const { return kind == Kind::name && text == name; }
};

// A lexer with one token of lookahead. An unterminated comment is a fault and ends the text.
class GlLexer {
 public:
  GlLexer(std::string_view text, SourceFaults& faults);

  [[nodiscard]] const GlToken& peek() const { return token_; }
  GlToken take();
  // Whether the next token is followed by . -> or :: and a name, directly.
  [[nodiscard]] bool next_is_member() const;
  // Whether the next token, a name, is followed by a parenthesis, with <…> of a named cast between them or without.
  [[nodiscard]] bool next_is_call() const;
  // Whether the next token is followed by = alone.
  [[nodiscard]] bool next_is_assignment() const;
  // Whether the next tokens are (TYPE[, as of a compound literal.
  [[nodiscard]] bool begins_array_type() const;
  // Whether the next tokens are (* and a name.
  [[nodiscard]] bool begins_pointer_call() const;
  // Whether the next token, a name, is followed by a parenthesis and the name of a GL call.
  [[nodiscard]] bool wraps_call() const;
  // If the next tokens are (TYPE) or (const TYPE*) before an operand: the byte behind them; else 0.
  [[nodiscard]] std::size_t cast_end() const;
  // Goes on reading at a byte.
  void move_to(std::size_t at);
  // Skips the rest of the line in which the next token begins.
  void skip_line();
  // The end of the token that was taken last.
  [[nodiscard]] std::size_t end_of_last() const { return end_of_last_; }
  // Whether the text ended inside a comment; that fault is already reported.
  [[nodiscard]] bool cut_short() const { return cut_short_; }

 private:
  void advance();
  [[nodiscard]] std::size_t number_end() const;
  [[nodiscard]] std::size_t unknown_end() const;

  std::string_view text_;
  SourceFaults& faults_;
  std::size_t at_ = 0;
  std::size_t end_of_last_ = 0;
  GlToken token_;
  bool cut_short_ = false;
};

// Lines of dumps of GL calls, as apitrace and GLIntercept write them: "1235 glCombinerParameteriNV(pname = …)".

struct GlDumpLine {
  std::size_t call = 0;     // where the name of the call begins
  std::string_view name{};  // of the call
  bool sets_combiners = false;
  std::size_t end = 0;  // behind the line; text in quotes may make it longer
};

// The line of a dump that begins with the call number at this byte; empty: the number does not begin such a line.
[[nodiscard]] std::optional<GlDumpLine> gl_dump_line(std::string_view text, std::size_t number);

}  // namespace ninebit::detail
