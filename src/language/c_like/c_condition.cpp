#include "src/language/c_like/c_condition.h"

#include <cstdint>

#include "src/language/c_like/c_number.h"
#include "src/language/source/source_faults.h"

namespace ninebit::code {
namespace {

constexpr int kDeepestCondition = 64;                              // parentheses in parentheses
constexpr std::size_t kMostConditionBytes = std::size_t{1} << 20;  // with names replaced

// A number of an expression, or why there is none: only what decides the condition matters.
struct ConditionNumber {
  Number number = int_number(0, kInt64);  // signed or unsigned, of 64 bits
  std::string unknown{}, fault{};

  [[nodiscard]] bool is_sure() const { return unknown.empty() && fault.empty(); }
};

ConditionNumber truth_number(bool value) {
  return {.number = int_number(value ? 1 : 0, kInt64)};
}

// A result with what is not known of the operands.
ConditionNumber from_operands(ConditionNumber result, const ConditionNumber& a, const ConditionNumber& b) {
  result.unknown = a.unknown.empty() ? b.unknown : a.unknown;
  result.fault = a.fault.empty() ? b.fault : a.fault;
  return result;
}

std::string text_of(const Number& number) {
  return number.kinds == kUint64 ? std::to_string(static_cast<std::uint64_t>(number.integer))
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
  auto value = calculate(mark, a.number, b.number);
  if (value && value->kinds == kInt32) value = convert(*value, kInt64);  // of a comparison
  ConditionNumber out = from_operands({.number = value.value_or(Number{.kinds = kInt64})}, a, b);
  if (!value && out.is_sure()) {
    out.fault = text_of(a.number) + " " + std::string(mark) + " " + text_of(b.number) + " has no value";
  }
  return out;
}

ConditionNumber number_of(std::string_view text) {
  const auto value = read_number(std::string(text) + "u");
  if (!value) return {.fault = detail::quoted(text) + " is not a whole number of 64 bits"};
  const bool is_unsigned = value->integer < 0 || text.find_first_of("uU") != std::string_view::npos;
  return {.number = int_number(value->integer, is_unsigned ? kUint64 : kInt64)};
}

class ConditionParser {
 public:
  ConditionParser(const std::vector<Token>& tokens, const std::function<bool(std::string_view)>& is_defined)
      : tokens_(tokens), is_defined_(is_defined) {}

  ConditionValue read() {
    const ConditionNumber number = conditional(0);
    if (!at_end()) fail("an operator");
    const std::string& fault = fault_.empty() ? number.fault : fault_;
    return {.holds = number.number.is_true() && fault.empty(), .unknown = number.unknown, .fault = fault};
  }

 private:
  ConditionNumber conditional(int depth) {
    const ConditionNumber which = binary(1, depth);
    if (!takes("?")) return which;
    const ConditionNumber yes = conditional(depth + 1);
    if (!takes(":")) fail("':'");
    const ConditionNumber no = conditional(depth + 1);
    ConditionNumber out = which.number.is_true() ? yes : no;
    if (yes.number.kinds == kUint64 || no.number.kinds == kUint64) out.number.kinds = kUint64;
    return which.is_sure() ? out : from_operands(out, which, out);
  }

  ConditionNumber binary(int least, int depth) {
    ConditionNumber left = unary(depth);
    while (true) {
      const Token op = peek();
      if (precedence(op) < least) return left;
      ++at_;
      left = applied(op.text, left, binary(precedence(op) + 1, depth));
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
    if (takes("~")) return applied("^", {.number = int_number(-1, kInt64)}, unary(depth + 1));
    if (takes("(")) {
      ConditionNumber inner = conditional(depth + 1);
      if (!takes(")")) fail("')'");
      return inner;
    }
    return primary();
  }

  ConditionNumber primary() {
    const Token token = peek();
    if (token.kind == Token::Kind::number) {
      ++at_;
      return number_of(token.text);
    }
    if (!token.is_name()) {
      fail("a number, a name or defined(NAME)");
      return {};
    }
    ++at_;
    if (token.text == "defined") return defined();
    const std::string name(token.text);
    if (!peek().is("(")) return {.unknown = name};
    fault_ = fault_.empty() ? detail::quoted(name) + " has parameters; only names without them are computed" : fault_;
    at_ = tokens_.size();
    return {};
  }

  // NAME or (NAME) behind `defined`.
  ConditionNumber defined() {
    const bool bracket = takes("(");
    if (!peek().is_name()) {
      fail("a name after defined");
      return {};
    }
    const ConditionNumber out = truth_number(is_defined_(tokens_[at_++].text));
    if (bracket && !takes(")")) fail("')'");
    return out;
  }

  [[nodiscard]] bool at_end() const { return at_ >= tokens_.size(); }
  [[nodiscard]] Token peek() const { return at_end() ? Token{} : tokens_[at_]; }

  bool takes(std::string_view mark) {
    if (peek().kind != Token::Kind::punctuation || peek().text != mark) return false;
    ++at_;
    return true;
  }

  // Keeps the first fault of the expression, and ends it.
  void fail(const std::string& expected) {
    if (fault_.empty()) {
      fault_ = "expected " + expected + "; found " + (at_end() ? "the end of the line" : detail::quoted(peek().text));
    }
    at_ = tokens_.size();
  }

  const std::vector<Token>& tokens_;
  const std::function<bool(std::string_view)>& is_defined_;
  std::size_t at_ = 0;
  std::string fault_;
};

}  // namespace

ConditionValue condition_value(const std::vector<Token>& expression,
                               const std::function<bool(std::string_view)>& is_defined) {
  std::size_t bytes = 0;
  for (const Token& token : expression) bytes += token.text.size() + 1;
  if (bytes > kMostConditionBytes) return {.fault = "the condition is longer than 1 MiB with names replaced"};
  return ConditionParser(expression, is_defined).read();
}

}  // namespace ninebit::code
