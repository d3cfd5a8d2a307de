// Declarations.
#include <utility>

#include "src/language/source_code/code_parser.h"

namespace ninebit::code {

const Type* Parser::pointers(const Type* base, Declared& out) {
  while (true) {
    if (takes("*") || takes("^")) {
      base = pointer_to(base);
      out.is_constant = false;
    } else if (takes("&")) {
      out.is_reference = true;
      takes("&");
    } else if (peek().is("[") && peek(1).is("]") && (peek(2).is_name() || peek(2).is("["))) {
      at_ += 2;  // float[] name, of Java
      base = pointer_to(base);
    } else if (is_one_of(peek(), {"const", "volatile", "__restrict", "restrict", "CONST", "__restrict__", "far"})) {
      take();
    } else {
      return base;
    }
  }
}

const Type* Parser::declarator(const Type* base, Declared& out, Function* function) {
  base = pointers(base, out);
  const bool nested = peek().is("(") && (peek(1).is("*") || peek(1).is("&") ||
                                         (peek(1).is_name() && (peek(2).is("*") || peek(2).is("::"))));
  if (nested && ++depth_ < kMostNestedStatements) {
    const std::size_t inner = at_ + 1;
    skip_brackets();
    const Type* const type = suffixes(base, nullptr);
    const std::size_t behind = at_;
    at_ = inner;
    while (peek().is_name() || peek().is("::")) take();  // APIENTRY, Class::
    const Type* const whole = declarator(type, out, nullptr);
    at_ = behind;
    --depth_;
    return whole;
  }
  if (peek().is_name() && (!is_qualifier(peek()) || peek().is("register"))) {
    out.offset = peek().offset;
    out.name = take().text;
    while (peek().is("::") && peek(1).is_name()) {
      take();
      out.scope = out.name;
      out.name = take().text;
    }
  }
  return suffixes(base, function);
}

const Type* Parser::suffixes(const Type* base, Function* function) {
  std::vector<std::int64_t> counts;
  while (peek().is("[")) {
    const std::size_t behind = behind_brackets(at_);
    take();
    std::int64_t count = Type::kOpen;
    if (!peek().is("]")) {
      const auto bound = tried([&] { return expression(); });
      const auto number = bound ? fold(*bound) : std::nullopt;
      count = number && !number->may_be_real() && number->integer >= 0 ? number->integer : -2;
    }
    at_ = behind;
    counts.push_back(count);
  }
  if (counts.empty() && peek().is("(")) {
    const std::size_t behind = behind_brackets(at_);
    Function ignored;
    parameters(function != nullptr ? *function : ignored);
    at_ = std::min(behind, end_);
    return type({.kind = TypeKind::function, .of = base});
  }
  for (std::size_t i = counts.size(); i > 0; --i) base = array_of(base, counts[i - 1]);
  return base;
}

// Reads the parameters between the parentheses, whose first one is the next token.
void Parser::parameters(Function& out) {
  const std::size_t close = std::min<std::size_t>(file_.closing[at_], end_);
  const Deeper deeper(depth_);
  if (depth_ >= kMostNestedStatements) {
    at_ = close;
    return;
  }
  const std::size_t end = std::exchange(end_, close);
  take();
  while (!at_end()) {
    if (takes("...")) {
      out.is_variadic = true;
      break;
    }
    Declared one;
    one.type = unknown_type();
    const std::size_t begin = at_;
    Specifiers words;
    if (specifiers(words, true)) {
      one.type = decayed(declarator(words.type, one, nullptr));
      // A name without a type, as C had it before 1989, is read as a type.
      const bool alone = one.name.empty() && at_ == begin + 1 && words.type->is(TypeKind::unknown);
      if (alone && words.type->structure == nullptr) one.name = token(begin).text;
    }
    const bool is_nothing = one.type->is(TypeKind::nothing) && one.name.empty();
    if (takes("=")) {
      if (auto value = tried([&] { return assignment(); })) one.value.push_back(*std::move(value));
    }
    if (!at_end() && !peek().is(",")) {  // something else
      one = {};
      one.type = unknown_type();
      while (!at_end() && !peek().is(",")) {
        if (peek().is_name()) one.name = peek().text;
        skip_brackets();
      }
    }
    if (!is_nothing) out.parameters.push_back(std::move(one));
    takes(",");
  }
  end_ = end;
}

// Whether a type begins here for sure.
bool Parser::begins_type(std::size_t at) const {
  if (at >= end_) return false;
  const Token& word = token(at);
  if (is_number_word(word) || is_qualifier(word)) return true;
  if (is_structure_word(word)) return at + 1 < end_ && (token(at + 1).is_name() || token(at + 1).is("{"));
  const Symbol* known = word.is_name() ? symbol(word.text) : nullptr;
  while (known != nullptr && at + 2 < end_ && token(at + 1).is("::")) {
    at += 2;
    known = symbol(token(at).text);
  }
  return known != nullptr && known->type != nullptr;
}

// Whether parentheses behind TYPE NAME hold parameters, not arguments of a constructor.
bool Parser::holds_parameters(std::size_t open) const {
  return token(open + 1).is(")") || begins_type(open + 1);
}

bool Parser::is_declaration() const {
  const Token& first = peek();
  if (!first.is_name() || is_one_of(first, {"return", "else", "delete", "new", "throw", "goto", "case", "sizeof",
                                            "this", "using", "typename"})) {
    return first.is("typename");
  }
  if (begins_type(at_)) {
    if (is_qualifier(first) || is_structure_word(first)) return true;
    std::size_t next = at_ + 1;
    while (next + 1 < end_ && token(next).is("::")) next += 2;
    if (token(next).is("<")) return behind_template(next) != 0;
    const bool array = token(next).is("[") && next + 1 < end_ && token(next + 1).is("]");
    const bool pointer = token(next).is("(") && next + 1 < end_ && token(next + 1).is("*");  // float (*p)(float)
    return token(next).is_name() || token(next).is("*") || token(next).is("&") || array ||
           (pointer && is_number_word(first)) || token(next).is(";");
  }
  if (symbol(first.text) != nullptr) return false;
  // NAME NAME, NAME::NAME * NAME, NAME<…> NAME, NAME[] NAME
  std::size_t next = at_ + 1;
  while (next + 1 < end_ && (token(next).is("::") || token(next).is(".")) && token(next + 1).is_name()) next += 2;
  if (next < end_ && token(next).is("<")) next = behind_template(next);
  if (next == 0) return false;
  while (next + 1 < end_ && token(next).is("[") && token(next + 1).is("]")) next += 2;
  bool points = false;
  for (; next < end_ && (token(next).is("*") || token(next).is("&") || token(next).is("const")); ++next) points = true;
  if (next + 1 >= end_ || !token(next).is_name() || is_one_of(token(next), {"const"})) return false;
  const Token& behind = token(next + 1);
  const bool ends = behind.is("=") || behind.is(";") || behind.is(",") || behind.is("[");
  return points ? ends : ends || behind.is("(") || behind.is("{") || behind.is(":");
}

void Parser::initializer(Declared& out) {
  if (takes("=") || peek().is("{")) out.value.push_back(braces_or_assignment());
}

// From its specifiers to the semicolon.
void Parser::declaration(Statement& out, bool of_class) {
  out.kind = StatementKind::declaration;
  Specifiers words;
  if (!specifiers(words, true)) return void(fail());
  if (of_class && !words.enumerators.empty()) {
    outline_.globals.emplace_back().kind = StatementKind::declaration;
    outline_.globals.back().declared = std::move(words.enumerators);
  } else {
    out.declared = std::move(words.enumerators);
  }
  while (!failed_ && !peek().is(";") && !peek().is(":")) {
    Declared one;
    Function prototype;
    one.is_constant = words.is_constant;
    one.is_static = words.is_static;
    one.is_extern = words.is_extern;
    const std::size_t begin = at_;
    Declared trial;
    (void)pointers(words.type, trial);
    // TYPE NAME(arguments): an object, or a function that is declared.
    const bool constructs = peek().is_name() && peek(1).is("(") && !holds_parameters(at_ + 1) && !words.is_typedef;
    at_ = begin;
    if (constructs) {
      one.type = pointers(words.type, one);
      one.offset = peek().offset;
      one.name = take().text;
      one.value.push_back(list(")"));
      one.is_constructed = true;
    } else {
      one.type = declarator(words.type, one, &prototype);
      if (of_class && takes(":")) {  // a bit-field
        (void)assignment();
        one.type = type({.kind = TypeKind::opaque});
      }
    }
    if (one.name.empty()) return void(fail());
    if (words.is_typedef) {
      declare(one.name, {one.type, {}});
    } else if (one.type->is(TypeKind::function)) {
      prototype.name = std::string(one.name);
      prototype.own_name = one.name;
      prototype.result = one.type->of;
      outline_.prototypes.push_back(std::move(prototype));
    } else {
      if (!constructs) initializer(one);
      // The value of a constant is one for bounds of arrays, too.
      std::optional<Number> value;
      if (one.is_constant && one.type->is(TypeKind::number) && !one.value.empty()) value = fold(one.value[0]);
      if (value) value = convert(*value, one.type->kinds);
      if (!of_class) declare(one.name, {nullptr, value});
      out.declared.push_back(std::move(one));
    }
    if (!takes(",")) break;
  }
  if (!takes(";") && !(peek().is(":") && out.declared.size() == 1)) fail();
}

// The value of a constant expression; empty: it is not one.
std::optional<Number> Parser::fold(const Expression& e) const {
  switch (e.kind) {
    case ExpressionKind::number:
      return e.number;
    case ExpressionKind::name: {
      const Symbol* const known = symbol(e.text);
      return known == nullptr ? std::nullopt : known->constant;
    }
    case ExpressionKind::unary: {
      const auto value = fold(e.parts[0]);
      return value && e.text.size() == 1 ? calculate(e.text, *value) : std::nullopt;
    }
    case ExpressionKind::binary: {
      const auto left = fold(e.parts[0]), right = fold(e.parts[1]);
      return left && right && e.text != "&&" && e.text != "||" ? calculate(e.text, *left, *right) : std::nullopt;
    }
    case ExpressionKind::conditional: {
      const auto condition = fold(e.parts[0]), yes = fold(e.parts[1]), no = fold(e.parts[2]);
      if (!condition || !yes || !no) return std::nullopt;
      return convert(condition->is_true() ? *yes : *no, common_kinds(yes->kinds, no->kinds));
    }
    case ExpressionKind::cast: {
      const auto value = fold(e.parts[0]);
      return value && e.type->is(TypeKind::number) ? convert(*value, e.type->kinds) : std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

}  // namespace ninebit::code
