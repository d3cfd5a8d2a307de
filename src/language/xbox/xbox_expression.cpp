#include "src/language/xbox/xbox_expression.h"

#include <algorithm>
#include <charconv>

#include "src/language/register_words/register_words_layout.h"
#include "src/language/source/nearest_name.h"

namespace ninebit::xbox {
namespace {

constexpr int kDeepest = 32;  // brackets in brackets
constexpr std::int64_t kBeyondWords = std::int64_t{1} << 32;

struct Operator {
  std::string_view mark;
  int rank;  // a higher one binds closer
};
constexpr Operator kOperators[] = {{"|", 1}, {"^", 2}, {"&", 3}, {"<<", 4}, {">>", 4}, {"+", 5}, {"-", 5}};

int rank_of(const Token& token) {
  if (token.kind != TokenKind::mark) return 0;
  const auto found = std::find_if(std::begin(kOperators), std::end(kOperators),
                                  [&](const Operator& one) { return one.mark == token.text; });
  return found == std::end(kOperators) ? 0 : found->rank;
}

bool is_type(const Token& token) {
  constexpr std::string_view kTypes[] = {"DWORD",    "ULONG",  "UINT", "BYTE", "WORD",     "D3DCOLOR", "dword",
                                         "unsigned", "signed", "long", "int",  "uint32_t", "int32_t"};
  return token.kind == TokenKind::name &&
         std::find(std::begin(kTypes), std::end(kTypes), token.text) != std::end(kTypes);
}

std::string_view without_suffix(std::string_view digits) {
  while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string_view::npos) {
    digits.remove_suffix(1);
  }
  return digits;
}

std::string hex(std::int64_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  return words::hex_text(word, word > 0xffff ? 8 : word > 0xff ? 4 : 2);
}

}  // namespace

std::optional<std::uint32_t> Expressions::read() {
  const TextPlace place = lexer_.peek().place;
  const Value value = binary(1, 0);
  if (!value) return std::nullopt;
  if (*value >= kBeyondWords || *value < -kBeyondWords / 2) {
    faults_.add(place, "the value does not fit in 32 bits");
    return 0;
  }
  return static_cast<std::uint32_t>(*value);
}

std::uint32_t Expressions::number(const Token& token) {
  std::string_view digits = without_suffix(token.text);
  int base = 10;
  if (digits.starts_with("0x") || digits.starts_with("0X")) {
    base = 16;
    digits.remove_prefix(2);
  } else if (digits.size() > 1 && digits.front() == '0') {
    base = 8;
  }
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error == std::errc::result_out_of_range && end == digits.data() + digits.size()) {
    faults_.add(token.place, "the value does not fit in 32 bits");
  } else if (error != std::errc{} || end != digits.data() + digits.size()) {
    faults_.add(token.place, shown(token) + " is not a number; expected one such as 0x08040000, 15 or 017");
  }
  return value;
}

Expressions::Value Expressions::fail(const std::string& expected) {
  faults_.add(lexer_.peek().place, "expected " + expected + "; found " + shown(lexer_.peek()));
  return std::nullopt;
}

Expressions::Value Expressions::binary(int lowest, int depth) {
  Value left = unary(depth);
  while (left) {
    const Token mark = lexer_.peek();
    const int rank = rank_of(mark);
    if (rank < lowest) return left;
    (void)lexer_.take();
    const Value right = binary(rank + 1, depth);
    if (!right) return std::nullopt;
    left = apply(mark, *left, *right);
  }
  return left;
}

Expressions::Value Expressions::apply(const Token& mark, std::int64_t left, std::int64_t right) {
  if (mark.is("|")) return left | right;
  if (mark.is("^")) return left ^ right;
  if (mark.is("&")) return left & right;
  if (mark.is("<<") || mark.is(">>")) {
    if (right < 0 || right > 31) {
      faults_.add(mark.place, "a shift by " + std::to_string(right) + " bits is out of range; expected 0 to 31");
      return 0;
    }
    if (mark.is(">>")) return left >> right;
    // Bits that a shift moves out of the word are gone, as in C.
    return static_cast<std::int64_t>(static_cast<std::uint32_t>(left) << right);
  }
  const std::int64_t value = mark.is("+") ? left + right : left - right;
  if (value >= kBeyondWords || value <= -kBeyondWords) {
    faults_.add(mark.place, "the value does not fit in 32 bits");
    return 0;
  }
  return value;
}

Expressions::Value Expressions::unary(int depth) {
  // Signs in a row are counted rather than nested; those of arithmetic and ~ do not mix.
  bool negative = false, inverted = false, arithmetic = false, bitwise = false;
  while (lexer_.peek().is("-") || lexer_.peek().is("+") || lexer_.peek().is("~")) {
    const bool bits = lexer_.peek().is("~");
    if (bits ? arithmetic : bitwise) return fail("a value after the sign");
    (bits ? bitwise : arithmetic) = true;
    if (lexer_.peek().is("-")) negative = !negative;
    if (bits) inverted = !inverted;
    (void)lexer_.take();
  }
  while (skip_cast()) {
  }
  Value value = primary(depth);
  if (value && negative) value = -*value;
  if (value && inverted) value = ~*value & (kBeyondWords - 1);
  return value;
}

bool Expressions::skip_cast() {
  if (!lexer_.peek().is("(")) return false;
  Lexer ahead = lexer_;
  (void)ahead.take();
  if (!is_type(ahead.peek())) return false;
  for (int names = 0; names < 4 && is_type(ahead.peek()); ++names) (void)ahead.take();
  if (!ahead.peek().is(")")) return false;
  (void)ahead.take();
  lexer_ = ahead;
  return true;
}

Expressions::Value Expressions::primary(int depth) {
  if (depth > kDeepest) return fail("at most " + std::to_string(kDeepest) + " brackets in each other");
  const Token token = lexer_.peek();
  if (token.kind == TokenKind::number) return number(lexer_.take());
  if (token.kind == TokenKind::name) return named(lexer_.take(), depth);
  if (!token.is("(")) return fail("a value");
  (void)lexer_.take();
  const Value value = binary(1, depth + 1);
  if (!value) return std::nullopt;
  if (!lexer_.peek().is(")")) return fail("')'");
  (void)lexer_.take();
  return value;
}

Expressions::Value Expressions::named(const Token& name, int depth) {
  if (const Constant* const constant = find_constant(name.text)) return constant->value;
  if (const Macro* const macro = find_macro(name.text)) return call(*macro, name, depth);
  if (faults_.full()) return std::nullopt;
  faults_.add(name.place, "unknown name " + shown(name) + did_you_mean(name.text, macro_names()));
  if (!lexer_.peek().is("(")) return 0;
  // The arguments of an unknown macro have faults of their own.
  (void)lexer_.take();
  while (!lexer_.peek().is(")")) {
    if (!binary(1, depth + 1)) return std::nullopt;
    if (lexer_.peek().is(",")) {
      (void)lexer_.take();
    } else if (!lexer_.peek().is(")")) {
      return fail("',' or ')'");
    }
  }
  (void)lexer_.take();
  return 0;
}

Expressions::Value Expressions::call(const Macro& macro, const Token& name, int depth) {
  const std::string expected =
      "the " + std::to_string(macro.arguments.size()) + " arguments of " + std::string(macro.name);
  if (!lexer_.peek().is("(")) return fail("'(' and " + expected);
  if (depth >= kDeepest) return fail("at most " + std::to_string(kDeepest) + " brackets in each other");
  (void)lexer_.take();
  std::uint32_t value = macro.always;
  std::size_t count = 0;
  for (; !lexer_.peek().is(")"); ++count) {
    const TextPlace place = lexer_.peek().place;
    const Value argument = binary(1, depth + 1);
    if (!argument) return std::nullopt;
    if (count < macro.arguments.size()) {
      if (accepts(macro.arguments[count], *argument)) {
        value |= bits_of(macro.arguments[count], *argument);
      } else {
        faults_.add(place, "argument " + std::to_string(count + 1) + " of " + std::string(macro.name) + " is " +
                               hex(*argument) + "; expected 0 to " + hex(macro.arguments[count].most));
      }
    }
    if (lexer_.peek().is(")")) continue;
    if (!lexer_.peek().is(",")) return fail("',' or ')' after an argument of " + std::string(macro.name));
    (void)lexer_.take();
    if (lexer_.peek().is(")")) return fail("an argument of " + std::string(macro.name));
  }
  (void)lexer_.take();
  if (count != macro.arguments.size()) {
    faults_.add(name.place, std::string(macro.name) + " has " + std::to_string(count) + " arguments; expected " +
                                std::to_string(macro.arguments.size()));
  }
  return value;
}

}  // namespace ninebit::xbox
