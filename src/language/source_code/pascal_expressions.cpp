// Pascal's expressions, with C's operators.
#include <array>
#include <utility>

#include "src/language/source_code/code_tree_build.h"
#include "src/language/source_code/pascal_parser.h"

namespace ninebit::code {
namespace {

struct PascalOperator {
  std::string_view pascal, c;
};
constexpr std::array kRelations{PascalOperator{"=", "=="}, PascalOperator{"<>", "!="}, PascalOperator{"<", "<"},
                                PascalOperator{">", ">"},  PascalOperator{"<=", "<="}, PascalOperator{">=", ">="}};
constexpr std::array kAdditions{PascalOperator{"+", "+"}, PascalOperator{"-", "-"}, PascalOperator{"or", "|"},
                                PascalOperator{"xor", "^"}};
constexpr std::array kProducts{PascalOperator{"*", "*"},   PascalOperator{"/", "/"},   PascalOperator{"div", "/"},
                               PascalOperator{"mod", "%"}, PascalOperator{"and", "&"}, PascalOperator{"shl", "<<"},
                               PascalOperator{"shr", ">>"}};

Expression unreadable_at(const Token& token) {
  return made(ExpressionKind::unreadable, token.text, token.offset, token.end);
}

template <std::size_t N>
std::string_view operator_of(const PascalParser& parser, const std::array<PascalOperator, N>& all) {
  for (const PascalOperator& one : all) {
    if (parser.is(one.pascal)) return one.c;
  }
  return {};
}

}  // namespace

std::string pascal_word(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

bool PascalParser::is(std::string_view word, std::size_t ahead) const {
  const Token& token = in_.peek(ahead);
  if (token.kind != Token::Kind::name && token.kind != Token::Kind::punctuation) return false;
  return token.text.size() == word.size() && pascal_word(token.text) == word;
}

bool PascalParser::takes(std::string_view word) {
  if (!is(word)) return false;
  in_.take();
  return true;
}

Expression PascalParser::expression() {
  if (depth_ >= kMostNestedExpressions) return unreadable_at(in_.peek());
  ++depth_;
  Expression out = simple();
  const std::string_view op = operator_of(*this, kRelations);
  if (!failed(out) && !op.empty()) {
    in_.take();
    Expression right = simple();
    out = failed(right) ? std::move(right) : joined(ExpressionKind::binary, op, std::move(out), std::move(right));
  }
  --depth_;
  return out;
}

Expression PascalParser::simple() {
  const Token sign = in_.peek();
  const bool negative = is("-");
  if (negative || is("+")) in_.take();
  Expression out = term();
  if (negative && !failed(out)) out = around(ExpressionKind::unary, "-", sign.offset, std::move(out));
  for (int chained = 0; !failed(out); ++chained) {
    const std::string_view op = operator_of(*this, kAdditions);
    if (op.empty()) break;
    if (chained == kMostChained) return unreadable_at(in_.peek());
    in_.take();
    Expression right = term();
    out = failed(right) ? std::move(right) : joined(ExpressionKind::binary, op, std::move(out), std::move(right));
  }
  return out;
}

Expression PascalParser::term() {
  Expression out = factor();
  for (int chained = 0; !failed(out); ++chained) {
    const std::string_view op = operator_of(*this, kProducts);
    if (op.empty()) break;
    if (chained == kMostChained) return unreadable_at(in_.peek());
    const bool real = is("/");
    in_.take();
    Expression right = factor();
    if (failed(right)) return right;
    // A slash gives a real number, whatever it divides.
    if (real) out = around(ExpressionKind::cast, "double", out.offset, std::move(out));
    out = joined(ExpressionKind::binary, op, std::move(out), std::move(right));
  }
  return out;
}

Expression PascalParser::factor() {
  const Token token = in_.peek();
  if (depth_ >= kMostNestedExpressions) return unreadable_at(token);
  if (is("not") || is("@") || is("-") || is("+")) {
    in_.take();
    ++depth_;
    Expression operand = factor();
    --depth_;
    if (failed(operand)) return operand;
    const std::string_view op = token.is("@") ? "&" : token.is("-") ? "-" : token.is("+") ? "+" : "!";
    return around(ExpressionKind::unary, op, token.offset, std::move(operand));
  }
  if (token.kind == Token::Kind::number) {
    in_.take();
    return made(ExpressionKind::number, token.text, token.offset, token.end);
  }
  if (token.kind == Token::Kind::text) {
    std::uint32_t end = token.end;
    while (in_.peek().kind == Token::Kind::text) end = in_.take().end;
    return made(ExpressionKind::text, token.text, token.offset, end);
  }
  if (is("(")) return postfix(parenthesized(false));
  if (is("[")) {  // a set
    in_.skip_brackets();
    return made(ExpressionKind::unreadable, {}, token.offset, in_.last_end());
  }
  if (!token.is_name()) return unreadable_at(token);
  in_.take();
  return postfix(made(ExpressionKind::name, token.text, token.offset, token.end));
}

// ( expression ), or the elements of a constant array.
Expression PascalParser::parenthesized(bool as_list) {
  const Token begin = in_.take();
  std::vector<Expression> parts;
  while (!in_.at_end() && !is(")")) {
    if (depth_ >= kMostNestedExpressions) return unreadable_at(in_.peek());
    ++depth_;
    Expression part = as_list && is("(") ? parenthesized(true) : expression();
    --depth_;
    if (failed(part)) return part;
    parts.push_back(std::move(part));
    if (!takes(",") && !is(")")) return unreadable_at(in_.peek());
  }
  const std::uint32_t end = in_.take().end;
  if (!as_list && parts.size() == 1) {
    Expression out = std::move(parts[0]);
    out.offset = begin.offset;
    out.end = end;
    return out;
  }
  return made(ExpressionKind::list, {}, begin.offset, end, std::move(parts));
}

Expression PascalParser::postfix(Expression out) {
  for (int chained = 0; !failed(out); ++chained) {
    const Token token = in_.peek();
    if (chained == kMostChained) return unreadable_at(token);
    if (is("^")) {
      in_.take();
    } else if (is(".") && in_.peek(1).is_name()) {
      in_.take();
      const Token& member = in_.take();
      out = around(ExpressionKind::member, member.text, out.offset, std::move(out));
      out.end = member.end;
    } else if (is("[")) {
      in_.take();
      do {
        Expression index = expression();
        if (failed(index)) return index;
        out = joined(ExpressionKind::index, "[]", std::move(out), std::move(index));
      } while (takes(","));
      if (!takes("]")) return unreadable_at(in_.peek());
      out.end = in_.last_end();
    } else if (is("(")) {
      Expression arguments = parenthesized(true);
      if (failed(arguments)) return arguments;
      const std::uint32_t offset = out.offset, end = arguments.end;
      std::vector<Expression> parts;
      parts.push_back(std::move(out));
      for (Expression& part : arguments.parts) parts.push_back(std::move(part));
      out = made(ExpressionKind::call, {}, offset, end, std::move(parts));
    } else {
      break;
    }
  }
  return out;
}

}  // namespace ninebit::code
