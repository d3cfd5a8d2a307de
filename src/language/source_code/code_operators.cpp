// Operators of expressions, by precedence.
#include <algorithm>
#include <array>
#include <utility>

#include "src/language/source/c_operators.h"
#include "src/language/source_code/code_parser.h"
#include "src/language/source_code/code_tree_build.h"

namespace ninebit::code {
namespace {

int precedence_of(const Token& token) {
  return token.kind == Token::Kind::punctuation ? detail::c_precedence(token.text) : 0;
}

bool is_assignment(const Token& token) {
  constexpr std::array<std::string_view, 11> kAssignments{
      "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};
  return token.kind == Token::Kind::punctuation &&
         std::find(kAssignments.begin(), kAssignments.end(), token.text) != kAssignments.end();
}

}  // namespace

Expression ExpressionParser::fail(const Token& at) const {
  return made(ExpressionKind::unreadable, at.text, at.offset, at.end);
}

Expression ExpressionParser::expression(bool commas) {
  Expression out = assignment();
  for (int chained = 0; commas && !failed(out) && in_.peek().is(","); ++chained) {
    if (chained == kMostChained) return fail(in_.peek());
    in_.take();
    Expression right = assignment();
    if (failed(right)) return right;
    out = joined(ExpressionKind::binary, ",", std::move(out), std::move(right));
  }
  return out;
}

Expression ExpressionParser::assignment() {
  if (depth_ >= kMostNestedExpressions) return fail(in_.peek());
  ++depth_;
  Expression out = binary(1);
  if (!failed(out) && in_.peek().is("?")) {
    in_.take();
    Expression yes = expression(true);
    if (!failed(yes) && !in_.takes(":")) yes = fail(in_.peek());
    Expression no = failed(yes) ? yes : assignment();
    if (failed(yes) || failed(no)) {
      out = failed(yes) ? std::move(yes) : std::move(no);
    } else {
      const std::uint32_t end = no.end;
      out = joined(ExpressionKind::conditional, "?", std::move(out), std::move(yes));
      out.parts.push_back(std::move(no));
      out.end = end;
    }
  } else if (!failed(out) && is_assignment(in_.peek())) {
    const std::string_view op = in_.take().text;
    Expression value = assignment();
    out = failed(value) ? std::move(value) : joined(ExpressionKind::assignment, op, std::move(out), std::move(value));
  }
  --depth_;
  return out;
}

Expression ExpressionParser::binary(int least) {
  Expression out = unary();
  for (int chained = 0; !failed(out); ++chained) {
    const int precedence = precedence_of(in_.peek());
    if (precedence < least || precedence == 0) break;
    if (chained == kMostChained) return fail(in_.peek());
    const std::string_view op = in_.take().text;
    Expression right = binary(precedence + 1);
    if (failed(right)) return right;
    out = joined(ExpressionKind::binary, op, std::move(out), std::move(right));
  }
  return out;
}

Expression ExpressionParser::unary() {
  const Token& token = in_.peek();
  if (depth_ >= kMostNestedExpressions) return fail(token);
  ++depth_;
  Expression out;
  constexpr std::array<std::string_view, 8> kOperators{"+", "-", "!", "~", "*", "&", "++", "--"};
  const bool is_operator = token.kind == Token::Kind::punctuation &&
                           std::find(kOperators.begin(), kOperators.end(), token.text) != kOperators.end();
  // C#'s words before an argument give its address.
  const bool is_reference = (token.is("ref") || token.is("out")) && in_.peek(1).is_name();
  if (is_operator || is_reference) {
    in_.take();
    Expression operand = unary();
    if (failed(operand)) {
      out = std::move(operand);
    } else {
      out = around(ExpressionKind::unary, is_reference ? "&" : token.text, token.offset, std::move(operand));
    }
  } else if (token.is("(") && is_cast()) {
    out = parenthesis();
  } else {
    out = postfix();
  }
  --depth_;
  return out;
}

Expression ExpressionParser::postfix() {
  Expression out = primary();
  for (int chained = 0; !failed(out); ++chained) {
    const Token token = in_.peek();
    const bool is_member = (token.is(".") || token.is("->")) && in_.peek(1).is_name();
    if (!is_member && !token.is("(") && !token.is("[") && !token.is("++") && !token.is("--")) break;
    if (chained == kMostChained) return fail(token);
    if (token.is("(")) {
      Expression arguments = list(")");
      if (failed(arguments)) return arguments;
      const std::uint32_t offset = out.offset, end = arguments.end;
      std::vector<Expression> parts;
      parts.push_back(std::move(out));
      for (Expression& part : arguments.parts) parts.push_back(std::move(part));
      out = made(ExpressionKind::call, {}, offset, end, std::move(parts));
      continue;
    }
    in_.take();
    if (token.is("[")) {
      Expression index = expression(true);
      if (failed(index) || !in_.peek().is("]")) return failed(index) ? index : fail(in_.peek());
      const std::uint32_t end = in_.take().end;
      out = joined(ExpressionKind::index, "[]", std::move(out), std::move(index));
      out.end = end;
      continue;
    }
    const std::string_view member = is_member ? in_.take().text : token.is("++") ? "post++" : "post--";
    const std::uint32_t offset = out.offset;
    out = around(is_member ? ExpressionKind::member : ExpressionKind::unary, member, offset, std::move(out));
    out.end = in_.last_end();
  }
  return out;
}

}  // namespace ninebit::code
