// Constant expressions: numbers, the headers' names and macros, and C's operators between them.
#pragma once

#include <cstdint>
#include <optional>

#include "src/language/register_words/register_words_faults.h"
#include "src/language/xbox/xbox_lexer.h"
#include "src/language/xbox/xbox_macros.h"

namespace ninebit::xbox {

class Expressions {
 public:
  Expressions(Lexer& lexer, TextFaults& faults) : lexer_(lexer), faults_(faults) {}

  // Reads one expression. Its value, modulo 2^32 if it is negative; empty after a fault that makes it unreadable. Other
  // faults (unknown names, values out of range) are reported and count as 0, so that reading goes on.
  [[nodiscard]] std::optional<std::uint32_t> read();

  // The value of a C number; a fault at the token if it is none.
  [[nodiscard]] std::uint32_t number(const Token& token);

 private:
  using Value = std::optional<std::int64_t>;

  Value binary(int lowest, int depth);
  Value unary(int depth);
  Value primary(int depth);
  Value named(const Token& name, int depth);
  Value call(const Macro& macro, const Token& name, int depth);
  // Skips "(DWORD)" and the like.
  bool skip_cast();
  [[nodiscard]] Value apply(const Token& mark, std::int64_t left, std::int64_t right);
  Value fail(const std::string& expected);

  Lexer& lexer_;
  TextFaults& faults_;
};

}  // namespace ninebit::xbox
