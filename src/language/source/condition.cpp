#include "src/language/source/condition.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <vector>

#include "src/language/source/c_operators.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {
namespace {

constexpr int kDeepestCondition = 64;                               // names in names, parentheses in parentheses
constexpr std::size_t kMostConditionTokens = std::size_t{1} << 16;  // with names replaced

struct ConditionToken {
  enum class Kind { end, name, number, mark };
  Kind kind = Kind::end;
  std::string text{};

  [[nodiscard]] bool is(std::string_view other) const { return text == other && kind != Kind::end; }
};

// A number of an expression, or why there is none: only what decides the condition matters.
struct ConditionNumber {
  std::int64_t value = 0;
  bool is_unsigned = false;
  std::string unknown{}, fault{};

  [[nodiscard]] bool is_sure() const { return unknown.empty() && fault.empty(); }
};

ConditionNumber truth_number(bool value) {
  return {.value = value ? 1 : 0};
}

// A result with what is not known of the operands.
ConditionNumber from_operands(ConditionNumber result, const ConditionNumber& a, const ConditionNumber& b) {
  result.unknown = a.unknown.empty() ? b.unknown : a.unknown;
  result.fault = a.fault.empty() ? b.fault : a.fault;
  return result;
}

// Division, shifts and comparisons of unsigned numbers; the other operators give the same bits for both.
std::optional<std::int64_t> unsigned_result(std::string_view mark, std::int64_t left, std::int64_t right) {
  const auto a = static_cast<std::uint64_t>(left), b = static_cast<std::uint64_t>(right);
  if ((mark == "/" || mark == "%") && b != 0) return static_cast<std::int64_t>(mark == "/" ? a / b : a % b);
  if (mark == "/" || mark == "%") return std::nullopt;
  if (mark == "<") return a < b ? 1 : 0;
  if (mark == ">") return a > b ? 1 : 0;
  if (mark == "<=") return a <= b ? 1 : 0;
  if (mark == ">=") return a >= b ? 1 : 0;
  if (mark == ">>" && b < 64) return static_cast<std::int64_t>(a >> b);
  return c_result(mark, left, right);
}

ConditionNumber applied(std::string_view mark, const ConditionNumber& a, const ConditionNumber& b) {
  if (mark == "&&" || mark == "||") {
    const bool decides = mark == "||";
    const auto decided = [&](const ConditionNumber& one) { return one.is_sure() && (one.value != 0) == decides; };
    if (decided(a) || (a.fault.empty() && decided(b))) return truth_number(decides);
    const bool either = a.value != 0 || b.value != 0, both = a.value != 0 && b.value != 0;
    return from_operands(truth_number(decides ? either : both), a, b);
  }
  const bool shifts = mark == "<<" || mark == ">>", compares = c_precedence(mark) == 6 || c_precedence(mark) == 7;
  const bool is_unsigned = a.is_unsigned || (b.is_unsigned && !shifts);
  const auto value = is_unsigned ? unsigned_result(mark, a.value, b.value) : c_result(mark, a.value, b.value);
  ConditionNumber out = from_operands({.value = value.value_or(0), .is_unsigned = is_unsigned && !compares}, a, b);
  if (!value && out.is_sure()) {
    out.fault = std::to_string(a.value) + " " + std::string(mark) + " " + std::to_string(b.value) + " has no value";
  }
  return out;
}

ConditionNumber read_number(const std::string& text) {
  std::string_view digits = text;
  ConditionNumber out;
  while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string_view::npos) {
    out.is_unsigned = out.is_unsigned || digits.back() == 'u' || digits.back() == 'U';
    digits.remove_suffix(1);
  }
  const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
  if (hex) digits.remove_prefix(2);
  const int base = hex ? 16 : digits.size() > 1 && digits[0] == '0' ? 8 : 10;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    out.fault = quoted(text) + " is not a whole number of 64 bits";
    return out;
  }
  out.value = static_cast<std::int64_t>(value);
  out.is_unsigned = out.is_unsigned || out.value < 0;
  return out;
}

class ConditionParser {
 public:
  ConditionParser(std::string_view expression, const ConditionNames& names) : names_(names) {
    texts_.push_back({{}, std::string(expression)});
    take();
  }

  ConditionValue read() {
    const ConditionNumber number = conditional(0);
    if (token_.kind != ConditionToken::Kind::end) fail("an operator");
    const std::string& fault = fault_.empty() ? number.fault : fault_;
    return {.holds = number.value != 0 && fault.empty(), .unknown = number.unknown, .fault = fault};
  }

 private:
  // The expression, or the body of a name in it, up to the byte that was read.
  struct OpenText {
    std::string name;
    std::string text;
    std::size_t at = 0;
  };

  ConditionNumber conditional(int depth) {
    const ConditionNumber which = binary(1, depth);
    if (!takes("?")) return which;
    const ConditionNumber yes = conditional(depth + 1);
    if (!takes(":")) fail("':'");
    const ConditionNumber no = conditional(depth + 1);
    ConditionNumber out = which.value != 0 ? yes : no;
    out.is_unsigned = yes.is_unsigned || no.is_unsigned;
    return which.is_sure() ? out : from_operands(out, which, out);
  }

  ConditionNumber binary(int least, int depth) {
    ConditionNumber left = unary(depth);
    while (true) {
      const int precedence = token_.kind == ConditionToken::Kind::mark ? c_precedence(token_.text) : 0;
      if (precedence < least) return left;
      const std::string mark = token_.text;
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
      return from_operands(truth_number(operand.value == 0), operand, operand);
    }
    if (takes("+")) return unary(depth + 1);
    if (takes("-")) return applied("-", {}, unary(depth + 1));
    if (takes("~")) return applied("^", {.value = -1}, unary(depth + 1));
    if (takes("(")) {
      ConditionNumber inner = conditional(depth + 1);
      if (!takes(")")) fail("')'");
      return inner;
    }
    return primary();
  }

  ConditionNumber primary() {
    const ConditionToken token = token_;
    if (token.kind == ConditionToken::Kind::number) {
      take();
      return read_number(token.text);
    }
    if (token.kind != ConditionToken::Kind::name) {
      fail("a number, a name or defined(NAME)");
      return {};
    }
    if (token.text == "defined") return is_defined();
    take();
    if (token_.is("(")) {
      ConditionNumber call{.fault = quoted(token.text) + " has parameters; only names without them are computed"};
      fail(call.fault, false);
      return call;
    }
    return {.unknown = token.text};
  }

  // defined NAME or defined(NAME), whose name is not replaced.
  ConditionNumber is_defined() {
    take(false);
    const bool bracket = token_.is("(");
    if (bracket) take(false);
    if (token_.kind != ConditionToken::Kind::name) {
      fail("a name after defined");
      return {};
    }
    const ConditionNumber out = truth_number(names_.is_defined(token_.text));
    take();
    if (bracket && !takes(")")) fail("')'");
    return out;
  }

  bool takes(std::string_view mark) {
    if (token_.kind != ConditionToken::Kind::mark || token_.text != mark) return false;
    take();
    return true;
  }

  // Keeps the first fault of the expression, and ends it.
  void fail(const std::string& expected, bool names_found = true) {
    const std::string found = token_.kind == ConditionToken::Kind::end ? "the end of the line" : quoted(token_.text);
    if (fault_.empty()) fault_ = names_found ? "expected " + expected + "; found " + found : expected;
    texts_.clear();
    token_ = {};
  }

  // Moves to the next token. Names that have a body are replaced, but not within their own.
  void take(bool replaces = true) {
    while (true) {
      token_ = next();
      if (taken_++ == kMostConditionTokens) return fail("at most " + std::to_string(kMostConditionTokens) + " words");
      if (!replaces || token_.kind != ConditionToken::Kind::name || token_.text == "defined") return;
      const bool is_open =
          std::any_of(texts_.begin(), texts_.end(), [&](const OpenText& one) { return one.name == token_.text; });
      if (is_open || texts_.size() > static_cast<std::size_t>(kDeepestCondition)) return;
      auto body = names_.body_of(token_.text);
      if (!body) return;
      texts_.push_back({token_.text, *std::move(body)});
    }
  }

  ConditionToken next() {
    while (!texts_.empty()) {
      OpenText& open = texts_.back();
      while (open.at < open.text.size() && is_blank(open.text[open.at])) ++open.at;
      if (open.at == open.text.size()) {
        texts_.pop_back();
        continue;
      }
      const std::string_view rest = std::string_view(open.text).substr(open.at);
      ConditionToken token{.kind = ConditionToken::Kind::mark};
      std::size_t length = 1;
      if (is_word(rest.front())) {
        token.kind = is_digit(rest.front()) ? ConditionToken::Kind::number : ConditionToken::Kind::name;
        const auto belongs = [&](char c) { return is_word(c) || (c == '.' && is_digit(rest.front())); };
        length = static_cast<std::size_t>(std::find_if_not(rest.begin(), rest.end(), belongs) - rest.begin());
      } else if (c_precedence(rest.substr(0, 2)) > 0) {
        length = std::min<std::size_t>(2, rest.size());
      }
      token.text = rest.substr(0, length);
      open.at += length;
      return token;
    }
    return {};
  }

  const ConditionNames& names_;
  std::vector<OpenText> texts_;
  ConditionToken token_;
  std::size_t taken_ = 0;
  std::string fault_;
};

}  // namespace

ConditionValue condition_value(std::string_view expression, const ConditionNames& names) {
  return ConditionParser(expression, names).read();
}

}  // namespace ninebit::detail
