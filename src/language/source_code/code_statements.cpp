// Statements of C-like languages.
#include <algorithm>
#include <array>
#include <utility>

#include "src/language/source/source_faults.h"
#include "src/language/source_code/code_parser.h"
#include "src/language/source_code/code_tree_build.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

Statement empty_at(const Token& token, StatementKind kind) {
  Statement out;
  out.kind = kind;
  out.offset = token.offset;
  out.end = token.end;
  return out;
}

// Words with which a statement begins that runs its block once.
bool runs_block(const Token& token) {
  constexpr std::array<std::string_view, 10> kWords{"try",    "synchronized", "lock",    "fixed",     "using",
                                                    "unsafe", "checked",      "finally", "unchecked", "__try"};
  return token.is_name() && std::find(kWords.begin(), kWords.end(), token.text) != kWords.end();
}

}  // namespace

std::vector<Statement> StatementParser::statements() {
  std::vector<Statement> all;
  while (!in_.at_end() && !in_.peek().is("}")) all.push_back(statement());
  return all;
}

// Skips the statement that begins at `begin`, up to its semicolon or the end of the block around it.
Statement StatementParser::unreadable(std::size_t begin, const std::string& expected) {
  const Token at = in_.peek();
  in_.move_to(begin);
  Statement out = empty_at(in_.peek(), StatementKind::unreadable);
  out.message = "expected " + expected + ", " +
                (at.kind == Token::Kind::end ? "but the text ends" : "found " + detail::quoted(at.text));
  while (!in_.at_end() && !in_.peek().is("}")) {
    const bool opens = in_.peek().is("{") || in_.peek().is("(") || in_.peek().is("[");
    const bool block = in_.peek().is("{");
    if (opens) {
      in_.skip_brackets();
    } else if (in_.take().is(";")) {
      break;
    }
    if (block && !in_.peek().is(";") && !in_.peek().is(",") && !in_.peek().is(")")) break;
  }
  out.end = in_.last_end();
  return out;
}

Statement StatementParser::statement() {
  const std::size_t begin = in_.at();
  const Token token = in_.peek();
  if (depth_ >= kMostNestedStatements) return unreadable(begin, "fewer nested statements");
  ++depth_;
  Statement out;
  if (token.is("{")) {
    out = block();
  } else if (token.is(";")) {
    out = empty_at(in_.take(), StatementKind::nothing);
  } else if (token.is_name() && in_.peek(1).is(":") && !token.is("default") && !token.is("case")) {
    in_.take();  // a label
    out = empty_at(in_.take(), StatementKind::nothing);
  } else {
    out = controlled(token);
  }
  --depth_;
  out.offset = token.offset;
  out.end = std::max(out.end, in_.last_end());
  return out;
}

Statement StatementParser::controlled(const Token& token) {
  if (token.is("if")) return branch(token);
  if (token.is("for") || token.is("while") || token.is("do") || token.is("foreach")) return loop(token);
  if (token.is("switch")) return choice(token);
  if (token.is("break") || token.is("continue") || token.is("return")) {
    Statement out = empty_at(in_.take(), token.is("break")      ? StatementKind::leave
                                         : token.is("continue") ? StatementKind::next
                                                                : StatementKind::give_back);
    if (token.is("return") && !in_.peek().is(";")) {
      out.value.push_back(expressions_.expression(true));
      if (failed(out.value[0])) out.value.clear();
    }
    if (!in_.takes(";")) unreadable(in_.at(), "';'");
    return out;
  }
  if (token.is("case") || token.is("default")) {
    Statement out = empty_at(in_.take(), StatementKind::label);
    if (token.is("case")) out.value.push_back(expressions_.expression());
    while (!in_.at_end() && !in_.peek().is(":") && !in_.peek().is("}") && !in_.peek().is(";")) in_.take();
    in_.takes(":");
    return out;
  }
  if (runs_block(token) && (in_.peek(1).is("{") || in_.peek(1).is("("))) {
    in_.take();
    if (in_.peek().is("(")) in_.skip_brackets();
    return statement();
  }
  if (token.is("catch") || token.is("__except")) {
    in_.take();
    if (in_.peek().is("(")) in_.skip_brackets();
    if (in_.peek().is("{")) in_.skip_brackets();
    return empty_at(token, StatementKind::nothing);
  }
  if (token.is("else")) {  // without its if
    in_.take();
    return statement();
  }
  return plain();
}

Statement StatementParser::block() {
  Statement out = empty_at(in_.take(), StatementKind::block);
  out.body = statements();
  in_.takes("}");
  return out;
}

// "( … )" as the statement's condition; what cannot be read is an unreadable expression.
bool StatementParser::condition(Statement& out) {
  const std::size_t begin = in_.at();
  if (!in_.takes("(")) return false;
  Expression value = expressions_.expression(true);
  if (failed(value) || !in_.peek().is(")")) {
    in_.move_to(begin);
    const std::uint32_t offset = in_.peek().offset;
    in_.skip_brackets();
    value = made(Expression::Kind::unreadable, {}, offset, in_.last_end());
  } else {
    in_.take();
  }
  out.value.push_back(std::move(value));
  return true;
}

Statement StatementParser::branch(const Token& keyword) {
  const std::size_t begin = in_.at();
  Statement out = empty_at(in_.take(), StatementKind::branch);
  if (in_.peek().is("constexpr")) in_.take();
  if (!condition(out)) return unreadable(begin, "'(' after " + std::string(keyword.text));
  out.body.push_back(statement());
  if (in_.takes("else")) out.otherwise.push_back(statement());
  return out;
}

Statement StatementParser::loop(const Token& keyword) {
  const std::size_t begin = in_.at();
  Statement out = empty_at(in_.take(), StatementKind::loop);
  if (keyword.is("do")) {
    out.tests_last = true;
    out.body.push_back(statement());
    if (!in_.takes("while") || !condition(out)) return unreadable(begin, "while and its condition");
    in_.takes(";");
    return out;
  }
  if (keyword.is("while")) {
    if (!condition(out)) return unreadable(begin, "'(' after while");
    out.body.push_back(statement());
    return out;
  }
  const std::size_t open = in_.at();
  if (!in_.takes("(")) return unreadable(begin, "'(' after " + std::string(keyword.text));
  if (for_each(out)) return out;
  const bool nothing_first = in_.peek().is(";");
  out.first.push_back(nothing_first      ? empty_at(in_.take(), StatementKind::nothing)
                      : is_declaration() ? declaration()
                                         : plain());
  bool good = out.first[0].kind != StatementKind::unreadable;
  if (good && !in_.peek().is(";")) {
    out.value.push_back(expressions_.expression(true));
    good = !failed(out.value[0]);
  }
  good = good && in_.takes(";");
  if (good && !in_.peek().is(")")) {
    out.step.push_back(expressions_.expression(true));
    good = !failed(out.step[0]);
  }
  if (!good || !in_.peek().is(")")) {  // over the elements of something
    out.first.clear();
    out.step.clear();
    in_.move_to(open);
    const std::uint32_t offset = in_.peek().offset;
    in_.skip_brackets();
    out.value.assign(1, made(Expression::Kind::unreadable, {}, offset, in_.last_end()));
  } else {
    in_.take();
  }
  out.body.push_back(statement());
  return out;
}

// TYPE NAME : RANGE) or TYPE NAME in RANGE), and what is done for each element; false: it is another loop.
bool StatementParser::for_each(Statement& out) {
  constexpr std::size_t kLongestType = 16;
  std::size_t ahead = 0;
  while (ahead < kLongestType &&
         (in_.peek(ahead).is_name() || in_.peek(ahead).is("*") || in_.peek(ahead).is("&") || in_.peek(ahead).is("::") ||
          in_.peek(ahead).is("<") || in_.peek(ahead).is(">")) &&
         !in_.peek(ahead).is("in")) {
    ++ahead;
  }
  const bool is_range = in_.peek(ahead).is(":") || in_.peek(ahead).is("in");
  if (ahead < 2 || !is_range || !in_.peek(ahead - 1).is_name()) return false;
  const std::size_t begin = in_.at();
  Declared element;
  element.name = in_.peek(ahead - 1).text;
  element.offset = in_.peek(ahead - 1).offset;
  in_.move_to(begin + ahead + 1);
  Expression range = expressions_.expression();
  if (failed(range) || !in_.takes(")")) {
    in_.move_to(begin);
    return false;
  }
  out.kind = StatementKind::each;
  out.declared.push_back(std::move(element));
  out.value.push_back(std::move(range));
  out.body.push_back(statement());
  return true;
}

Statement StatementParser::choice(const Token& keyword) {
  const std::size_t begin = in_.at();
  Statement out = empty_at(in_.take(), StatementKind::choice);
  if (!condition(out) || !in_.takes("{"))
    return unreadable(begin, "a condition and '{' after " + std::string(keyword.text));
  out.body = statements();
  in_.takes("}");
  return out;
}

// A declaration or an expression, with its semicolon.
Statement StatementParser::plain() {
  const std::size_t begin = in_.at();
  const Token token = in_.peek();
  for (const std::string_view word : {"goto", "throw", "delete", "asm", "__asm", "import", "package"}) {
    if (token.is(word)) {
      const std::string label(in_.peek(1).text);
      Statement skipped = unreadable(begin, "");
      skipped.kind = token.is("goto") ? StatementKind::jump : StatementKind::nothing;
      skipped.message = label;
      return skipped;
    }
  }
  Statement out;
  if (type_definition(out)) return out;
  if (token.is("typedef") || (token.is("using") && !in_.peek(1).is("("))) {
    if (token.is("typedef")) array_type();
    out = unreadable(begin, "");
    out.kind = StatementKind::nothing;
    return out;
  }
  if (is_declaration()) return declaration();
  out = empty_at(token, StatementKind::expression);
  out.value.push_back(expressions_.expression(true));
  if (failed(out.value[0])) return unreadable(begin, "a statement");
  if (in_.peek().is("{") && out.value[0].kind == Expression::Kind::call) {  // a macro with a block
    out.kind = StatementKind::branch;
    out.value[0].kind = Expression::Kind::unreadable;
    out.body.push_back(statement());
    return out;
  }
  if (in_.takes(";") || in_.at_end() || in_.peek().is("}")) return out;
  // Macros of checks are written without a semicolon.
  const bool goes_on = in_.peek().begins_line && out.value[0].kind == Expression::Kind::call;
  return goes_on ? out : unreadable(begin, "';'");
}

}  // namespace ninebit::code
