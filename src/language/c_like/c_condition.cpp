#include "src/language/c_like/c_condition.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "src/language/c_like/c_lexer.h"
#include "src/language/c_like/c_number.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {
namespace {

constexpr int kDeepestCondition = 64;                               // names in names, parentheses in parentheses
constexpr std::size_t kMostConditionTokens = std::size_t{1} << 16;  // with names replaced

using code::Number;
using code::Token;
using Kind = code::Token::Kind;

// A number of an expression, or why there is none: only what decides the condition matters.
struct ConditionNumber {
  Number number = code::int_number(0, code::kInt64);  // signed or unsigned, of 64 bits
  std::string unknown{}, fault{};

  [[nodiscard]] bool is_sure() const { return unknown.empty() && fault.empty(); }
};

ConditionNumber truth_number(bool value) {
  return {.number = code::int_number(value ? 1 : 0, code::kInt64)};
}

// A result with what is not known of the operands.
ConditionNumber from_operands(ConditionNumber result, const ConditionNumber& a, const ConditionNumber& b) {
  result.unknown = a.unknown.empty() ? b.unknown : a.unknown;
  result.fault = a.fault.empty() ? b.fault : a.fault;
  return result;
}

std::string text_of(const Number& number) {
  return number.kinds == code::kUint64 ? std::to_string(static_cast<std::uint64_t>(number.integer))
                                       : std::to_string(number.integer);
}

ConditionNumber applied(std::string_view mark, const ConditionNumber& a, const ConditionNumber& b) {
  if (mark == "&&" || mark == "||") {
    const bool decides = mark == "||";
    const auto decided = [&](const ConditionNumber& one) { return one.is_sure() && one.number.is_true() == decides; };
    if (decided(a) || (a.fault.empty() && decided(b))) return truth_number(decides);
    const bool left = a.number.is_true(), right = b.number.is_true();
    return from_operands(truth_number(decides ? left || right : left && right), a, b);
  }
  auto value = code::calculate(mark, a.number, b.number);
  if (value && value->kinds == code::kInt32) value = code::convert(*value, code::kInt64);  // of a comparison
  ConditionNumber out = from_operands({.number = value.value_or(Number{.kinds = code::kInt64})}, a, b);
  if (!value && out.is_sure()) {
    out.fault = text_of(a.number) + " " + std::string(mark) + " " + text_of(b.number) + " has no value";
  }
  return out;
}

ConditionNumber read_number(std::string_view text) {
  std::string_view digits = text;
  bool is_unsigned = false;
  while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string_view::npos) {
    is_unsigned = is_unsigned || digits.back() == 'u' || digits.back() == 'U';
    digits.remove_suffix(1);
  }
  const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
  if (hex) digits.remove_prefix(2);
  const int base = hex ? 16 : digits.size() > 1 && digits[0] == '0' ? 8 : 10;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    return {.fault = quoted(text) + " is not a whole number of 64 bits"};
  }
  const auto bits = static_cast<std::int64_t>(value);
  return {.number = code::int_number(bits, is_unsigned || bits < 0 ? code::kUint64 : code::kInt64)};
}

class ConditionParser {
 public:
  ConditionParser(std::string_view expression, const ConditionNames& names) : names_(names) {
    open({}, std::string(expression));
    take();
  }

  ConditionValue read() {
    const ConditionNumber number = conditional(0);
    if (token_.kind != Kind::end) fail("an operator");
    const std::string& fault = fault_.empty() ? number.fault : fault_;
    return {.holds = number.number.is_true() && fault.empty(), .unknown = number.unknown, .fault = fault};
  }

 private:
  // The expression, or the body of a name in it.
  struct OpenText {
    std::string name;
    std::unique_ptr<const std::string> text;
    code::Lexer lexer;
  };

  void open(std::string name, std::string text) {
    auto kept = std::make_unique<const std::string>(std::move(text));
    code::Lexer lexer(*kept);
    texts_.push_back({std::move(name), std::move(kept), lexer});
  }

  ConditionNumber conditional(int depth) {
    const ConditionNumber which = binary(1, depth);
    if (!takes("?")) return which;
    const ConditionNumber yes = conditional(depth + 1);
    if (!takes(":")) fail("':'");
    const ConditionNumber no = conditional(depth + 1);
    ConditionNumber out = which.number.is_true() ? yes : no;
    if (yes.number.kinds == code::kUint64 || no.number.kinds == code::kUint64) out.number.kinds = code::kUint64;
    return which.is_sure() ? out : from_operands(out, which, out);
  }

  ConditionNumber binary(int least, int depth) {
    ConditionNumber left = unary(depth);
    while (true) {
      const int precedence = code::precedence(token_);
      if (precedence < least) return left;
      const std::string mark(token_.text);
      take();
      left = applied(mark, left, binary(precedence + 1, depth));
    }
  }

  ConditionNumber unary(int depth) {
    if (depth > kDeepestCondition) {
      fail("at most " + std::to_string(kDeepestCondition) + " brackets and signs in each other");
      return {};
    }
    if (takes("!")) {
      const ConditionNumber operand = unary(depth + 1);
      return from_operands(truth_number(!operand.number.is_true()), operand, operand);
    }
    if (takes("+")) return unary(depth + 1);
    if (takes("-")) return applied("-", {}, unary(depth + 1));
    if (takes("~")) return applied("^", {.number = code::int_number(-1, code::kInt64)}, unary(depth + 1));
    if (takes("(")) {
      ConditionNumber inner = conditional(depth + 1);
      if (!takes(")")) fail("')'");
      return inner;
    }
    return primary();
  }

  ConditionNumber primary() {
    const std::string text(token_.text);
    if (token_.kind == Kind::number) {
      take();
      return read_number(text);
    }
    if (token_.kind != Kind::name) {
      fail("a number, a name or defined(NAME)");
      return {};
    }
    if (text == "defined") return is_defined();
    take();
    if (token_.is("(")) {
      ConditionNumber call{.fault = quoted(text) + " has parameters; only names without them are computed"};
      fail(call.fault, false);
      return call;
    }
    return {.unknown = text};
  }

  // defined NAME or defined(NAME), whose name is not replaced.
  ConditionNumber is_defined() {
    take(false);
    const bool bracket = token_.is("(");
    if (bracket) take(false);
    if (token_.kind != Kind::name) {
      fail("a name after defined");
      return {};
    }
    const ConditionNumber out = truth_number(names_.is_defined(token_.text));
    take();
    if (bracket && !takes(")")) fail("')'");
    return out;
  }

  bool takes(std::string_view mark) {
    if (token_.kind != Kind::punctuation || token_.text != mark) return false;
    take();
    return true;
  }

  // Keeps the first fault of the expression, and ends it.
  void fail(const std::string& expected, bool names_found = true) {
    const std::string found = token_.kind == Kind::end ? "the end of the line" : quoted(token_.text);
    if (fault_.empty()) fault_ = names_found ? "expected " + expected + "; found " + found : expected;
    for (OpenText& one : texts_) closed_.push_back(std::move(one.text));
    texts_.clear();
    token_ = {};
  }

  // Moves to the next token. Names that have a body are replaced, but not within their own.
  void take(bool replaces = true) {
    while (true) {
      token_ = next();
      if (taken_++ == kMostConditionTokens) return fail("at most " + std::to_string(kMostConditionTokens) + " words");
      if (!replaces || token_.kind != Kind::name || token_.text == "defined") return;
      const bool is_open =
          std::any_of(texts_.begin(), texts_.end(), [&](const OpenText& one) { return one.name == token_.text; });
      if (is_open || texts_.size() > static_cast<std::size_t>(kDeepestCondition)) return;
      auto body = names_.body_of(token_.text);
      if (!body) return;
      opened_ += body->size();
      if (opened_ > kMostConditionBytes) return fail(std::string(kLongCondition), false);
      open(std::string(token_.text), *std::move(body));
    }
  }

  Token next() {
    while (!texts_.empty()) {
      const Token token = texts_.back().lexer.next();
      if (token.kind != Kind::end) return token;
      closed_.push_back(std::move(texts_.back().text));
      texts_.pop_back();
    }
    return {};
  }

  const ConditionNames& names_;
  std::vector<OpenText> texts_;
  std::vector<std::unique_ptr<const std::string>> closed_;  // which tokens may still be parts of
  Token token_;
  std::size_t taken_ = 0, opened_ = 0;  // tokens; bytes of bodies
  std::string fault_;
};

}  // namespace

ConditionValue condition_value(std::string_view expression, const ConditionNames& names) {
  return ConditionParser(expression, names).read();
}

}  // namespace ninebit::detail
