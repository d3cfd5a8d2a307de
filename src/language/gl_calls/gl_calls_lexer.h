// Look-ahead in texts of GL calls, and the lines of dumps of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "src/language/c_like/c_lexer.h"

namespace ninebit::detail {

class GlLexer : public code::TokenReader {
 public:
  using TokenReader::TokenReader;

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
  // Skips (TYPE) or (const TYPE*) before an operand; whether it was there.
  bool skip_cast();

 private:
  [[nodiscard]] code::TokenReader behind_next() const;
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
