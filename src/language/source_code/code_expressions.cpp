// Expressions: C's operators and precedence, with casts, `new` and named casts of C++ and Java.
#include <utility>

#include "src/language/source_code/code_parser.h"

namespace ninebit::code {
namespace {

Expression at_token(ExpressionKind kind, const Token& token) {
  Expression out;
  out.kind = kind;
  out.text = token.text;
  out.offset = token.offset;
  out.end = token.end;
  out.is_made = token.is_made;
  return out;
}

}  // namespace

Expression Parser::fail() {
  if (!failed_) failure_ = peek();
  failed_ = true;
  at_ = end_;
  return {};
}

// An expression with parts, which ends with the last token that was taken.
Expression Parser::around(ExpressionKind kind, std::string_view text, std::uint32_t offset, Expression part) const {
  Expression out;
  out.kind = kind;
  out.text = text;
  out.offset = offset;
  out.end = last_end();
  out.parts.push_back(std::move(part));
  return out;
}

Expression Parser::joined(ExpressionKind kind, std::string_view text, Expression left, Expression right) const {
  const std::uint32_t offset = left.offset;
  Expression out = around(kind, text, offset, std::move(left));
  out.parts.push_back(std::move(right));
  return out;
}

Expression Parser::expression(bool commas) {
  Expression left = assignment();
  while (commas && takes(",")) {
    Expression right = assignment();
    left = joined(ExpressionKind::comma, ",", std::move(left), std::move(right));
  }
  return left;
}

Expression Parser::assignment() {
  const Deeper deeper(expression_depth_);
  if (expression_depth_ > kMostNestedExpressions) return fail();
  Expression left = binary(1);
  if (takes("?")) {
    Expression yes = expression(true);
    expect(":");
    Expression no = assignment();
    left = joined(ExpressionKind::conditional, "?", std::move(left), std::move(yes));
    left.parts.push_back(std::move(no));
  }
  const Token op = peek();
  if (is_assignment(op)) {
    take();
    Expression value = braces_or_assignment();
    left = joined(ExpressionKind::assignment, op.text, std::move(left), std::move(value));
  }
  return left;
}

Expression Parser::braces_or_assignment() {
  return peek().is("{") ? list("}") : assignment();
}

Expression Parser::binary(int least) {
  Expression left = unary();
  for (int chained = 0;; ++chained) {
    const Token op = peek();
    const int level = precedence(op);
    if (level < least) return left;
    if (chained == kMostChained) return fail();
    take();
    Expression right = binary(level + 1);
    left = joined(ExpressionKind::binary, op.text, std::move(left), std::move(right));
  }
}

Expression Parser::unary() {
  const Deeper deeper(expression_depth_);
  if (expression_depth_ > kMostNestedExpressions) return fail();
  const Token begin = peek();
  for (const std::string_view op : {"-", "+", "!", "~", "*", "&", "++", "--"}) {
    if (takes(op)) return around(ExpressionKind::unary, op, begin.offset, unary());
  }
  if (!begin.is("(") || !is_cast()) return postfix();
  take();
  const Type* const type = type_name();
  takes(")");
  if (type == nullptr) return fail();
  const bool makes = peek().is("{");
  Expression out = makes ? list("}") : unary();
  out = around(makes ? ExpressionKind::make : ExpressionKind::cast, "", begin.offset, std::move(out));
  out.type = type;
  return out;
}

// (TYPE) before something that it converts.
bool Parser::is_cast() {
  const std::size_t close = file_.closing[at_];
  if (close <= at_ + 1 || close >= end_) return false;
  const std::size_t begin = at_;
  const Token& behind = close + 1 < end_ ? token(close + 1) : end_token_;
  const bool is_operand = behind.is_name() || behind.kind == Token::Kind::number || behind.kind == Token::Kind::text ||
                          behind.kind == Token::Kind::character;
  bool opens = false;
  for (const std::string_view mark : {"(", "{", "!", "~", "-", "+", "*", "&", "++", "--"}) {
    opens = opens || behind.is(mark);
  }
  ++at_;
  Specifiers words;
  const bool known = specifiers(words, false);
  at_ = begin + 1;
  Specifiers any;
  Declared none;
  bool fits = specifiers(any, true);
  if (fits) (void)declarator(any.type, none, nullptr);
  fits = fits && at_ == close && none.name.empty();
  at_ = begin;
  return fits && (is_operand || (opens && (known || token(close - 1).is("*"))));
}

const Type* Parser::type_name() {
  Specifiers words;
  if (!specifiers(words, true)) return nullptr;
  Declared none;
  return declarator(words.type, none, nullptr);
}

Expression Parser::postfix() {
  Expression left = primary();
  for (int chained = 0;; ++chained) {
    const Token op = peek();
    if (chained > kMostNestedExpressions) return fail();
    if (op.is("(")) {
      left = arguments(std::move(left));
    } else if (takes("[")) {
      Expression index = expression(true);
      expect("]");
      left = joined(ExpressionKind::index, "", std::move(left), std::move(index));
    } else if (takes(".") || takes("->")) {
      takes("::");
      if (!peek().is_name()) return fail();
      const std::string_view name = take().text;
      const std::uint32_t offset = left.offset;
      left = around(ExpressionKind::member, name, offset, std::move(left));
      left.is_arrow = op.is("->");
      qualified(left);  // object->Class::member
    } else if (takes("++") || takes("--")) {
      const std::uint32_t offset = left.offset;
      left = around(ExpressionKind::unary, op.is("++") ? "post++" : "post--", offset, std::move(left));
    } else {
      return left;
    }
  }
}

// ::NAME behind a name, which becomes the qualifier.
void Parser::qualified(Expression& out) {
  while (peek().is("::") && peek(1).is_name()) {
    take();
    out.qualifier = out.text;
    out.text = take().text;
    out.end = last_end();
  }
}

Expression Parser::arguments(Expression callee) {
  const std::uint32_t offset = callee.offset;
  Expression out = around(ExpressionKind::call, "", offset, std::move(callee));
  take();
  while (!takes(")") && !failed_) {
    out.parts.push_back(braces_or_assignment());
    if (!takes(",") && !peek().is(")")) return fail();
  }
  out.end = last_end();
  return out;
}

Expression Parser::primary() {
  const Token begin = peek();
  if (begin.kind == Token::Kind::number || begin.kind == Token::Kind::character) {
    take();
    Expression out = at_token(ExpressionKind::number, begin);
    const auto number = begin.kind == Token::Kind::number ? read_number(begin.text) : read_character(begin.text);
    if (number) out.number = *number;
    // A constant that no type holds has no value.
    if (!number) out.kind = ExpressionKind::name;
    return out;
  }
  if (begin.kind == Token::Kind::text) return literals();
  if (begin.is("(")) return parenthesis();
  if (begin.is("{")) return list("}");
  takes("::");
  return peek().is_name() ? named() : fail();
}

// Literals one after the other are one.
Expression Parser::literals() {
  Expression out = at_token(ExpressionKind::text, peek());
  std::size_t count = 0;
  for (; peek().kind == Token::Kind::text || (peek().is("L") && peek(1).kind == Token::Kind::text); ++count) {
    out.is_made = out.is_made || peek().is_made;
    out.end = take().end;
  }
  if (out.is_made && count > 1) out.text = {};  // several, some of them from macros
  return out;
}

Expression Parser::parenthesis() {
  const Token begin = take();
  if (peek().is("{")) return fail();  // a statement as an expression
  Expression out = expression(true);
  expect(")");
  out.offset = begin.offset;
  out.end = last_end();
  return out;
}

// { … }, whose brace is the next token.
Expression Parser::list(std::string_view close) {
  const Deeper deeper(expression_depth_);
  Expression out = at_token(ExpressionKind::list, take());
  out.text = {};
  if (expression_depth_ > kMostNestedExpressions) return fail();
  while (!takes(close) && !failed_) {
    Expression one;
    const Token first = peek();
    if (first.is(".") && peek(1).is_name()) {
      take();
      one = at_token(ExpressionKind::designated, take());
    } else if (takes("[")) {
      Expression index = assignment();
      expect("]");
      one = around(ExpressionKind::designated, "", first.offset, std::move(index));
    }
    const bool designates = one.kind == ExpressionKind::designated;
    if (designates) expect("=");  // not .a.b = …
    Expression value = braces_or_assignment();
    one.end = value.end;
    if (designates) one.parts.push_back(std::move(value));
    out.parts.push_back(designates ? std::move(one) : std::move(value));
    if (!takes(",") && !peek().is(close)) return fail();
  }
  out.end = last_end();
  return out;
}

// new TYPE(…), new TYPE[…] {…}
Expression Parser::creation() {
  const Token begin = take();
  Specifiers words;
  Expression out = at_token(ExpressionKind::make, begin);
  out.text = {};
  out.is_new = true;
  if (!specifiers(words, true)) return fail();
  out.type = words.type;
  while (takes("*")) out.type = pointer_to(out.type);
  Expression content = at_token(ExpressionKind::list, begin);
  content.text = {};
  if (peek().is("[")) {
    out.type = suffixes(out.type, nullptr);
    if (peek().is("{")) {
      content = list("}");
    } else {
      out.text = "empty";
    }
  } else if (peek().is("(")) {
    content = list(")");
  }
  out.end = last_end();
  out.parts.push_back(std::move(content));
  return out;
}

Expression Parser::size() {
  Expression out = at_token(ExpressionKind::size, take());
  const std::size_t at = at_;
  if (peek().is("(")) {
    // A type, unless a variable has the name.
    const std::size_t close = file_.closing[at_];
    ++at_;
    if (begins_type(at_)) out.type = type_name();
    if (out.type == nullptr || at_ != close) {
      out.type = nullptr;
      at_ = at;
    } else {
      take();
    }
  }
  if (out.type == nullptr) out.parts.push_back(unary());
  out.end = last_end();
  return out;
}

Expression Parser::named() {
  const Token begin = peek();
  if (begin.is("sizeof")) return size();
  if (begin.is("new")) return creation();
  if (begin.is("L") && peek(1).kind == Token::Kind::text) {
    take();
    return literals();
  }
  if (takes("delete")) {
    if (takes("[")) takes("]");
    Expression freed = unary();
    return joined(ExpressionKind::call, "", at_token(ExpressionKind::name, begin), std::move(freed));
  }
  if (is_one_of(begin, {"if", "else", "for", "while", "do", "switch", "case", "return", "goto", "break", "continue",
                        "default", "throw", "struct", "asm", "__asm", "__asm__"})) {
    return fail();
  }
  if (begin.text.ends_with("_cast") && peek(1).is("<")) {
    at_ += 2;
    const Type* const type = type_name();
    if (type == nullptr || !takes(">") || !takes("(")) return fail();
    Expression value = expression();
    expect(")");
    Expression out = around(ExpressionKind::cast, "", begin.offset, std::move(value));
    out.type = type;
    return out;
  }
  // TYPE(value), TYPE{value}
  const std::size_t at = at_;
  Specifiers words;
  if (begins_type(at_) && specifiers(words, false) && words.type != nullptr && (peek().is("(") || peek().is("{"))) {
    Expression content = list(peek().is("(") ? ")" : "}");
    Expression out = around(ExpressionKind::make, "call", begin.offset, std::move(content));
    out.type = words.type;
    return out;
  }
  at_ = at;
  Expression out = at_token(ExpressionKind::name, take());
  qualified(out);
  if (peek().is("<")) {
    const std::size_t behind = behind_template(at_);
    if (behind != 0 && token(behind).is("(")) at_ = behind;
  }
  return out;
}

std::vector<Expression> Parser::expressions() {
  std::vector<Expression> all;
  if (peek().is("{")) {
    all = std::move(list("}").parts);
  } else {
    do {
      all.push_back(assignment());
    } while (takes(","));
  }
  return failed_ || !at_end() ? std::vector<Expression>{} : all;
}

}  // namespace ninebit::code
