// Expressions: C's operators and precedence, with casts, `new` and named casts of C++ and Java.
#include <array>
#include <utility>

#include "src/language/source_code/code_parser.h"

namespace ninebit::code {
namespace {

constexpr std::array<std::string_view, 11> kAssignments{
    "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};

Expression at_token(ExpressionKind kind, const Token& token) {
  Expression out;
  out.kind = kind;
  out.text = token.text;
  out.offset = token.offset;
  out.end = token.end;
  out.is_made = token.is_made;
  return out;
}

// An expression with one part or two.
Expression around(ExpressionKind kind, std::string_view text, std::uint32_t offset, Expression part) {
  Expression out;
  out.kind = kind;
  out.text = text;
  out.offset = offset;
  out.end = part.end;
  out.parts.push_back(std::move(part));
  return out;
}
Expression joined(ExpressionKind kind, std::string_view text, Expression left, Expression right) {
  Expression out = around(kind, text, left.offset, std::move(left));
  out.end = right.end;
  out.parts.push_back(std::move(right));
  return out;
}

}  // namespace

Expression Parser::fail(const Token& at) const {
  return at_token(ExpressionKind::unreadable, at);
}

Expression Parser::expression(bool commas) {
  Expression left = assignment();
  while (commas && peek().is(",") && !failed(left)) {
    take();
    Expression right = assignment();
    if (failed(right)) return right;
    left = joined(ExpressionKind::comma, ",", std::move(left), std::move(right));
  }
  return left;
}

Expression Parser::assignment() {
  if (++expression_depth_ > kMostNestedExpressions) {
    --expression_depth_;
    return fail(peek());
  }
  Expression left = binary(1);
  if (!failed(left) && peek().is("?")) {
    take();
    Expression yes = expression(true);
    const bool colon = takes(":");
    Expression no = colon ? assignment() : fail(peek());
    if (failed(yes) || failed(no)) {
      --expression_depth_;
      return failed(yes) ? yes : no;
    }
    left = joined(ExpressionKind::conditional, "?", std::move(left), std::move(yes));
    left.end = no.end;
    left.parts.push_back(std::move(no));
  }
  const Token op = peek();
  const bool assigns = op.kind == Token::Kind::punctuation &&
                       std::find(kAssignments.begin(), kAssignments.end(), op.text) != kAssignments.end();
  if (!failed(left) && assigns) {
    take();
    Expression value = peek().is("{") ? list("}") : assignment();
    left = failed(value) ? value : joined(ExpressionKind::assignment, op.text, std::move(left), std::move(value));
  }
  --expression_depth_;
  return left;
}

Expression Parser::binary(int least) {
  Expression left = unary();
  int chained = 0;
  while (!failed(left)) {
    const Token op = peek();
    const int level = precedence(op);
    if (level < least) break;
    if (++chained > kMostChained) return fail(op);
    take();
    Expression right = binary(level + 1);
    if (failed(right)) return right;
    left = joined(ExpressionKind::binary, op.text, std::move(left), std::move(right));
  }
  return left;
}

Expression Parser::unary() {
  const Token begin = peek();
  if (++expression_depth_ > kMostNestedExpressions) {
    --expression_depth_;
    return fail(begin);
  }
  Expression out;
  bool is_operator = false;
  for (const std::string_view op : {"-", "+", "!", "~", "*", "&", "++", "--"})
    is_operator = is_operator || begin.is(op);
  if (is_operator && begin.kind == Token::Kind::punctuation) {
    take();
    out = unary();
    if (!failed(out)) out = around(ExpressionKind::unary, begin.text, begin.offset, std::move(out));
  } else if (begin.is("(") && is_cast()) {
    take();
    const Type* const type = type_name();
    takes(")");
    if (type == nullptr) {
      out = fail(begin);
    } else if (peek().is("{")) {
      out = list("}");
      if (!failed(out)) out = around(ExpressionKind::make, "", begin.offset, std::move(out));
    } else {
      out = unary();
      if (!failed(out)) out = around(ExpressionKind::cast, "", begin.offset, std::move(out));
    }
    out.type = type;
  } else {
    out = postfix();
  }
  --expression_depth_;
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
  const bool opens = behind.is("(") || behind.is("{") || behind.is("!") || behind.is("~");
  const bool sign =
      behind.is("-") || behind.is("+") || behind.is("*") || behind.is("&") || behind.is("++") || behind.is("--");
  ++at_;
  Specifiers words;
  const bool known = specifiers(words, false);
  at_ = begin + 1;
  Specifiers any;
  bool fits = specifiers(any, true);
  if (fits) {
    Declared none;
    (void)declarator(any.type, none, nullptr);
    fits = at_ == close && none.name.empty();
  }
  const bool is_pointer = fits && token(close - 1).is("*");
  at_ = begin;
  if (!fits) return false;
  return known || is_pointer ? is_operand || opens || sign : is_operand;
}

const Type* Parser::type_name() {
  Specifiers words;
  if (!specifiers(words, true)) return nullptr;
  Declared none;
  return declarator(words.type, none, nullptr);
}

Expression Parser::postfix() {
  Expression left = primary();
  for (int chained = 0; !failed(left); ++chained) {
    const Token op = peek();
    if (chained > kMostNestedExpressions) return fail(op);
    if (op.is("(")) {
      left = arguments(std::move(left));
    } else if (op.is("[")) {
      take();
      Expression index = expression(true);
      if (failed(index) || !takes("]")) return fail(op);
      left = joined(ExpressionKind::index, "", std::move(left), std::move(index));
      left.end = last_end();
    } else if (op.is(".") || op.is("->")) {
      take();
      takes("::");
      if (!peek().is_name()) return fail(peek());
      const Token name = take();
      left = around(ExpressionKind::member, name.text, left.offset, std::move(left));
      left.is_arrow = op.is("->");
      left.end = name.end;
      if (peek().is("::") && peek(1).is_name()) {  // object->Class::member
        take();
        left.qualifier = left.text;
        left.text = take().text;
        left.end = last_end();
      }
    } else if (op.is("++") || op.is("--")) {
      take();
      left = around(ExpressionKind::unary, op.is("++") ? "post++" : "post--", left.offset, std::move(left));
      left.end = op.end;
    } else {
      return left;
    }
  }
  return left;
}

Expression Parser::arguments(Expression callee) {
  Expression out = around(ExpressionKind::call, "", callee.offset, std::move(callee));
  const Token open = take();
  while (!peek().is(")")) {
    Expression one = peek().is("{") ? list("}") : assignment();
    if (failed(one)) return one;
    out.parts.push_back(std::move(one));
    if (!takes(",") && !peek().is(")")) return fail(peek());
    if (at_end()) return fail(open);
  }
  take();
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
  if (begin.is("::")) {
    take();
    return peek().is_name() ? named() : fail(peek());
  }
  return begin.is_name() ? named() : fail(begin);
}

// Literals one after the other are one.
Expression Parser::literals() {
  const Token begin = peek();
  Expression out = at_token(ExpressionKind::text, begin);
  std::size_t count = 0;
  while (peek().kind == Token::Kind::text || (peek().is("L") && peek(1).kind == Token::Kind::text)) {
    out.is_made = out.is_made || peek().is_made;
    out.end = take().end;
    ++count;
  }
  if (out.is_made && count > 1) out.text = {};  // several, some of them from macros
  return out;
}

Expression Parser::parenthesis() {
  const Token begin = take();
  if (peek().is("{")) return fail(peek());  // a statement as an expression
  Expression out = expression(true);
  if (failed(out)) return out;
  if (!takes(")")) return fail(peek());
  out.offset = begin.offset;
  out.end = last_end();
  return out;
}

// { … }, whose brace is the next token.
Expression Parser::list(std::string_view close) {
  const Token begin = take();
  Expression out = at_token(ExpressionKind::list, begin);
  out.text = {};
  if (++expression_depth_ > kMostNestedExpressions) {
    --expression_depth_;
    return fail(begin);
  }
  while (!peek().is(close) && !at_end()) {
    Expression one;
    const Token first = peek();
    if (first.is(".") && peek(1).is_name()) {
      take();
      one = at_token(ExpressionKind::designated, take());
    } else if (first.is("[")) {
      take();
      Expression index = assignment();
      one = failed(index) || !takes("]") ? fail(first)
                                         : around(ExpressionKind::designated, "", first.offset, std::move(index));
    }
    const bool designates = one.kind == ExpressionKind::designated;
    if (designates && !takes("=")) one = fail(peek());  // .a.b = …
    if (designates && failed(one)) {
      out = one;
      break;
    }
    Expression value = peek().is("{") ? list("}") : assignment();
    if (failed(value)) {
      out = value;
      break;
    }
    if (designates) {
      one.end = value.end;
      one.parts.push_back(std::move(value));
    }
    out.parts.push_back(designates ? std::move(one) : std::move(value));
    if (!takes(",") && !peek().is(close)) {
      out = fail(peek());
      break;
    }
  }
  --expression_depth_;
  if (failed(out)) return out;
  if (!takes(close)) return fail(begin);
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
  if (!specifiers(words, true)) return fail(peek());
  out.type = words.type;
  while (takes("*")) out.type = pointer_to(out.type);
  Expression content = at_token(ExpressionKind::list, begin);
  content.text = {};
  if (peek().is("[")) {
    std::vector<std::int64_t> counts;
    while (takes("[")) {
      std::int64_t count = Type::kOpen;
      if (!peek().is("]")) {
        const Expression bound = expression();
        const auto number = failed(bound) ? std::nullopt : fold(bound);
        count = number && !number->may_be_real() ? number->integer : -2;
      }
      if (!takes("]")) return fail(peek());
      counts.push_back(count);
    }
    for (std::size_t i = counts.size(); i > 0; --i) {
      out.type = counts[i - 1] < Type::kOpen ? unknown_type() : array_of(out.type, counts[i - 1]);
    }
    if (peek().is("{"))
      content = list("}");
    else
      out.text = "empty";
  } else if (peek().is("(")) {
    content = list(")");
  }
  if (failed(content)) return content;
  out.end = last_end();
  out.parts.push_back(std::move(content));
  return out;
}

Expression Parser::size() {
  const Token begin = take();
  Expression out = at_token(ExpressionKind::size, begin);
  const std::size_t at = at_;
  if (peek().is("(")) {
    // A type, unless a variable has the name.
    const std::size_t close = file_.closing[at_];
    ++at_;
    if (begins_type(at_)) out.type = type_name();
    if (out.type != nullptr && at_ == close) {
      take();
      out.end = last_end();
      return out;
    }
    out.type = nullptr;
    at_ = at;
  }
  Expression operand = unary();
  if (failed(operand)) return operand;
  out.end = operand.end;
  out.parts.push_back(std::move(operand));
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
  if (begin.is("delete")) {
    take();
    if (takes("[")) takes("]");
    Expression freed = unary();
    if (failed(freed)) return freed;
    Expression out = around(ExpressionKind::call, "", begin.offset, at_token(ExpressionKind::name, begin));
    out.end = freed.end;
    out.parts.push_back(std::move(freed));
    return out;
  }
  for (const std::string_view word : {"if", "else", "for", "while", "do", "switch", "case", "return", "goto", "break",
                                      "continue", "default", "throw", "struct", "asm", "__asm", "__asm__"}) {
    if (begin.is(word)) return fail(begin);
  }
  if (begin.text.ends_with("_cast") && peek(1).is("<")) {
    at_ += 2;
    const Type* const type = type_name();
    if (type == nullptr || !takes(">") || !takes("(")) return fail(peek());
    Expression value = expression();
    if (failed(value) || !takes(")")) return fail(peek());
    Expression out = around(ExpressionKind::cast, "", begin.offset, std::move(value));
    out.type = type;
    out.end = last_end();
    return out;
  }
  // TYPE(value), TYPE{value}
  const std::size_t at = at_;
  Specifiers words;
  if (begins_type(at_) && specifiers(words, false) && words.type != nullptr && (peek().is("(") || peek().is("{"))) {
    Expression content = list(peek().is("(") ? ")" : "}");
    if (failed(content)) return content;
    Expression out = around(ExpressionKind::make, "call", begin.offset, std::move(content));
    out.type = words.type;
    out.end = last_end();
    return out;
  }
  at_ = at;
  Expression out = at_token(ExpressionKind::name, take());
  while (peek().is("::") && peek(1).is_name()) {
    take();
    out.qualifier = out.text;
    out.text = take().text;
    out.end = last_end();
  }
  if (peek().is("<")) {
    const std::size_t behind = behind_template(at_);
    if (behind != 0 && token(behind).is("(")) at_ = behind;
  }
  return out;
}

std::vector<Expression> Parser::expressions() {
  std::vector<Expression> all;
  if (peek().is("{")) {
    Expression whole = list("}");
    if (!failed(whole) && at_end()) return std::move(whole.parts);
    return {};
  }
  do {
    all.push_back(assignment());
    if (failed(all.back())) return {};
  } while (takes(","));
  return at_end() ? all : std::vector<Expression>{};
}

}  // namespace ninebit::code
