// Operands of expressions: literals, names, lists, casts, new.
#include <algorithm>
#include <utility>

#include "src/language/gl_calls/gl_calls_spelling.h"
#include "src/language/source_code/code_parser.h"
#include "src/language/source_code/code_tree_build.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

bool is_named_cast(std::string_view name) {
  return name == "static_cast" || name == "reinterpret_cast" || name == "const_cast" || name == "dynamic_cast";
}

}  // namespace

// Whether the parenthesis here holds a type, of which a value follows.
bool ExpressionParser::is_cast() const {
  std::size_t ahead = 1;
  bool sure = false, named = false;
  std::string_view last;
  for (; ahead < 24 && !in_.peek(ahead).is(")"); ++ahead) {
    const Token& token = in_.peek(ahead);
    if (token.is("*") || token.is("[") || token.is("]")) {
      if (!named) return false;
      sure = true;
    } else if (token.kind == Token::Kind::number) {
      if (!in_.peek(ahead - 1).is("[")) return false;
    } else if (token.is_name()) {
      sure = sure || is_type_word(token.text);
      named = true;
      last = token.text;
    } else if (!token.is("::") && !token.is(".") && !token.is("&")) {
      return false;
    }
  }
  const Token& next = in_.peek(ahead + 1);
  if (!in_.peek(ahead).is(")") || !named || detail::find_gl_call(last) != nullptr) return false;
  const bool operand = next.is_name() || next.kind == Token::Kind::number || next.kind == Token::Kind::text ||
                       next.is("{") || next.is("!") || next.is("~");
  if (operand) return sure || !next.is("{");
  return sure && (next.is("(") || next.is("-") || next.is("+") || next.is("&") || next.is("*"));
}

// A cast, or a compound literal.
Expression ExpressionParser::parenthesis() {
  const Token begin = in_.take();
  std::string_view type;
  bool pointer = false;
  while (!in_.peek().is(")")) {
    const Token& token = in_.take();
    if (token.is_name() && token.text != "const") type = token.text;
    pointer = pointer || token.is("*");
  }
  in_.take();
  Expression value = in_.peek().is("{") ? list("}") : unary();
  if (failed(value)) return value;
  // A pointer's target is whatever it was.
  return around(ExpressionKind::cast, pointer ? std::string_view() : type, begin.offset, std::move(value));
}

Expression ExpressionParser::list(std::string_view close) {
  const Token begin = in_.take();
  std::vector<Expression> parts;
  if (depth_ >= kMostNestedExpressions) return fail(begin);
  ++depth_;
  while (!in_.peek().is(close)) {
    // .member = value
    const bool designated = in_.peek().is(".") && in_.peek(1).is_name() && in_.peek(2).is("=");
    if (designated) in_.take();
    Expression part = in_.peek().is("{") ? list("}") : in_.peek().is("[") ? designated_element() : assignment();
    if (failed(part) || (!in_.peek().is(",") && !in_.peek().is(close))) {
      --depth_;
      return failed(part) ? part : fail(in_.peek());
    }
    parts.push_back(std::move(part));
    in_.takes(",");
  }
  --depth_;
  const std::uint32_t end = in_.take().end;
  return made(ExpressionKind::list, {}, begin.offset, end, std::move(parts));
}

// [index] = value, as an assignment "[]=".
Expression ExpressionParser::designated_element() {
  const Token begin = in_.take();
  Expression index = expression();
  if (failed(index) || !in_.takes("]") || !in_.takes("=")) return fail(in_.peek());
  Expression value = in_.peek().is("{") ? list("}") : assignment();
  if (failed(value)) return value;
  std::vector<Expression> parts;
  parts.push_back(std::move(index));
  parts.push_back(std::move(value));
  return made(ExpressionKind::assignment, kDesignatedElement, begin.offset, in_.last_end(), std::move(parts));
}

// new TYPE[] { … }, new TYPE[n], new TYPE(…).
Expression ExpressionParser::creation(const Token& begin) {
  std::string_view type;
  while (in_.peek().is_name() || in_.peek().is("::") || in_.peek().is(".")) type = in_.take().text;
  skip_template_arguments();
  while (in_.peek().is("[")) in_.skip_brackets();
  if (in_.peek().is("{")) return list("}");
  Expression out = made(ExpressionKind::list, type, begin.offset, in_.last_end());
  if (in_.peek().is("(")) out = list(")");
  out.text = type;
  return out;
}

// <…> behind a name, if a call follows it.
void ExpressionParser::skip_template_arguments() {
  if (!in_.peek().is("<")) return;
  constexpr std::size_t kLongest = 24;
  std::size_t ahead = 1, depth = 1;
  for (; ahead < kLongest && depth > 0; ++ahead) {
    const Token& token = in_.peek(ahead);
    if (token.is("<")) ++depth;
    if (token.is(">")) --depth;
    if (token.is(">>")) depth -= std::min<std::size_t>(depth, 2);
    const bool belongs = token.is_name() || token.kind == Token::Kind::number || token.is("::") || token.is(",") ||
                         token.is("*") || token.is("&") || token.is("<") || token.is(">") || token.is(">>");
    if (!belongs) return;
  }
  if (depth == 0 && (in_.peek(ahead).is("(") || in_.peek(ahead).is("{"))) in_.move_to(in_.at() + ahead);
}

Expression ExpressionParser::named(const Token& begin) {
  Expression out = made(ExpressionKind::name, begin.text, begin.offset, begin.end);
  while (in_.peek().is("::") && in_.peek(1).is_name()) {
    in_.take();
    const Token& part = in_.take();
    out.text = part.text;
    out.end = part.end;
    out.is_qualified = true;
  }
  if (is_named_cast(out.text) && in_.peek().is("<")) {
    std::string_view type;
    bool pointer = false;
    while (!in_.at_end() && !in_.peek().is("(")) {
      const Token& token = in_.take();
      pointer = pointer || token.is("*") || token.is("&");
      if (token.is_name() && token.text != "const") type = token.text;
    }
    if (!in_.takes("(")) return fail(in_.peek());
    Expression value = expression(true);
    if (failed(value) || !in_.peek().is(")")) return failed(value) ? value : fail(in_.peek());
    Expression cast = around(ExpressionKind::cast, pointer ? std::string_view() : type, begin.offset, std::move(value));
    cast.end = in_.take().end;
    return cast;
  }
  skip_template_arguments();
  return out;
}

// String literals in a row.
Expression ExpressionParser::literals(const Token& begin) {
  const File& file = in_.file();
  std::string all;
  bool pasted = false;
  std::uint32_t end = begin.end;
  while (in_.peek().kind == Token::Kind::text) {
    const Token& token = in_.take();
    pasted = pasted || token.text.data() != file.text.data() + token.offset;
    all += std::string(token.text) + ' ';
    end = std::max(end, token.end);
  }
  Expression out = made(ExpressionKind::text, {}, begin.offset, end);
  if (pasted) {
    file.pasted.push_back(std::move(all));
    out.text = file.pasted.back();
    out.is_pasted = true;
  }
  return out;
}

Expression ExpressionParser::primary() {
  const Token token = in_.peek();
  const Token& next = in_.peek(1);
  if (token.kind == Token::Kind::number || token.kind == Token::Kind::character) {
    in_.take();
    return made(ExpressionKind::number, token.text, token.offset, token.end);
  }
  const bool prefixed = (token.is("L") || token.is("u8") || token.is("@")) && next.kind == Token::Kind::text;
  if (prefixed) in_.take();
  if (in_.peek().kind == Token::Kind::text) {
    return literals(token);
  }
  if (token.is("new") || token.is("gcnew")) {
    in_.take();
    return creation(token);
  }
  if (token.is_name()) {
    in_.take();
    return named(token);
  }
  if (token.is("::") && next.is_name()) {
    in_.take();
    return named(in_.take());
  }
  if (token.is("(")) {
    in_.take();
    Expression out = expression(true);
    if (failed(out) || !in_.peek().is(")")) return failed(out) ? out : fail(in_.peek());
    out.end = in_.take().end;
    out.offset = token.offset;
    return out;
  }
  return token.is("{") ? list("}") : fail(token);
}

}  // namespace ninebit::code
