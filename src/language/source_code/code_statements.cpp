// Statements.
#include <utility>

#include "src/language/source_code/code_parser.h"

namespace ninebit::code {
namespace {

Statement empty_at(const Token& token, StatementKind kind) {
  Statement out;
  out.kind = kind;
  out.offset = token.offset;
  out.end = token.end;
  return out;
}

}  // namespace

std::vector<Statement> Parser::body(const Function& function) {
  const std::size_t end = std::exchange(end_, function.last);
  at_ = function.first;
  open_scope();
  for (const Declared& one : function.parameters) declare(one.name, {});
  std::vector<Statement> all;
  while (!at_end()) {
    std::vector<Statement> more = statements();
    std::move(more.begin(), more.end(), std::back_inserter(all));
    if (!at_end()) take();  // a stray brace
  }
  close_scope();
  end_ = end;
  return all;
}

std::vector<Statement> Parser::statements() {
  std::vector<Statement> all;
  while (!at_end() && !peek().is("}")) all.push_back(statement());
  return all;
}

// Skips the statement that begins at `begin`, up to its semicolon or the end of the block around it.
Statement Parser::unreadable(std::size_t begin, const std::string& expected) {
  const Token at = std::exchange(failed_, false) ? failure_ : peek();
  at_ = begin;
  Statement out = empty_at(peek(), StatementKind::unreadable);
  out.message = "expected " + expected + ", " +
                (at.kind == Token::Kind::end ? "but the text ends" : "found " + detail::quoted(at.text));
  while (!at_end() && !peek().is("}")) {
    const bool block = peek().is("{");
    const std::size_t from = at_;
    if (block || peek().is("(") || peek().is("[")) {
      skip_brackets();
    } else if (take().is(";")) {
      break;
    }
    for (std::size_t i = from; i < at_; ++i) {
      out.may_jump =
          out.may_jump || is_one_of(token(i), {"return", "break", "continue", "goto", "throw", "case", "default"});
    }
    if (block && !peek().is(";") && !peek().is(",") && !peek().is(")") && !peek().is("else")) break;
  }
  out.end = last_end();
  return out;
}

Statement Parser::statement() {
  const Token first = peek();
  const Deeper deeper(depth_);
  if (depth_ > kMostNestedStatements) return unreadable(at_, "fewer nested statements");
  Statement out;
  if (first.is("{")) {
    out = block();
  } else if (takes(";")) {
    out = empty_at(first, StatementKind::nothing);
  } else if (first.is_name() && peek(1).is(":") && !first.is("default") && !first.is("case")) {
    at_ += 2;
    out = empty_at(first, StatementKind::mark);
    out.message = first.text;
  } else {
    out = controlled(first);
  }
  out.offset = first.offset;
  out.end = std::max(out.end, last_end());
  return out;
}

Statement Parser::controlled(const Token& keyword) {
  const auto word = [&](std::string_view one) { return keyword.is(one); };
  if (word("if")) return branch();
  if (word("for") || word("while") || word("do")) return loop(keyword);
  if (word("switch")) return choice();
  if (word("break") || word("continue") || word("return") || word("throw")) {
    Statement out = empty_at(take(), word("break")      ? StatementKind::leave
                                     : word("continue") ? StatementKind::next
                                                        : StatementKind::give_back);
    const bool gives = (word("return") || word("throw")) && !peek().is(";");
    if (auto value = gives ? tried([&] { return peek().is("{") ? list("}") : expression(true); }) : std::nullopt) {
      out.value.push_back(*std::move(value));
    }
    if (word("throw")) out.message = "throw";
    if (!takes(";")) unreadable(at_, "';'");
    return out;
  }
  if (word("case") || word("default")) {
    Statement out = empty_at(take(), StatementKind::label);
    if (word("case")) out.value.push_back(tried([&] { return expression(); }).value_or(Expression{}));
    while (!at_end() && !peek().is(":") && !peek().is("}") && !peek().is(";")) take();
    takes(":");
    return out;
  }
  if ((word("try") || word("__try")) && peek(1).is("{")) {
    take();
    Statement out = statement();
    out.message = "try";
    return out;
  }
  if (word("catch") || word("__except")) {
    take();
    if (peek().is("(")) skip_brackets();
    if (peek().is("{")) skip_brackets();
    return empty_at(keyword, StatementKind::nothing);
  }
  if (word("goto") && peek(1).is_name()) {
    take();
    Statement out = empty_at(keyword, StatementKind::jump);
    out.message = take().text;
    takes(";");
    return out;
  }
  if (word("using")) {
    skip_statement();
    return empty_at(keyword, StatementKind::nothing);
  }
  return plain();
}

Statement Parser::plain() {
  const std::size_t begin = at_;
  if (is_declaration()) {
    Statement out = empty_at(peek(), StatementKind::declaration);
    declaration(out, false);
    return failed_ || peek().is(":") ? unreadable(begin, "a declaration") : out;
  }
  Statement out = empty_at(peek(), StatementKind::expression);
  out.value.push_back(expression(true));
  if (failed_) return unreadable(begin, "a statement");
  // The last one of a text, or a macro that stands alone, needs no semicolon.
  const bool ends =
      takes(";") || at_end() || peek().is("}") || (out.value[0].kind == ExpressionKind::call && peek().begins_line);
  return ends ? out : unreadable(begin, "a statement");
}

Statement Parser::block() {
  Statement out = empty_at(take(), StatementKind::block);
  open_scope();
  out.body = statements();
  close_scope();
  takes("}");
  return out;
}

// A statement in a scope of its own.
std::vector<Statement> Parser::scoped() {
  open_scope();
  std::vector<Statement> out{statement()};
  close_scope();
  return out;
}

// ( … ) behind if, while and switch; it declares nothing.
void Parser::condition(Statement& out) {
  expect("(");
  if (!failed_ && is_declaration() && !peek(1).is("(")) fail();
  out.value.push_back(expression(true));
  expect(")");
}

Statement Parser::branch() {
  const std::size_t begin = at_;
  Statement out = empty_at(take(), StatementKind::branch);
  takes("constexpr");
  condition(out);
  if (failed_) return unreadable(begin, "a condition");
  out.body = scoped();
  if (takes("else")) out.otherwise = scoped();
  return out;
}

Statement Parser::loop(const Token& keyword) {
  const std::size_t begin = at_;
  Statement out = empty_at(take(), StatementKind::loop);
  open_scope();
  if (keyword.is("do")) {
    out.tests_last = true;
    out.body.push_back(statement());
    expect("while");
    condition(out);
    takes(";");
  } else if (keyword.is("while")) {
    condition(out);
  } else {
    expect("(");
    if (!for_each(out)) {
      if (is_declaration()) {
        declaration(out.first.emplace_back(empty_at(peek(), StatementKind::declaration)), false);
      } else if (!takes(";")) {
        out.first.emplace_back(empty_at(peek(), StatementKind::expression)).value.push_back(expression(true));
        expect(";");
      }
      if (!peek().is(";")) out.value.push_back(expression(true));
      expect(";");
      if (!peek().is(")")) out.step.push_back(expression(true));
    }
    expect(")");
  }
  if (!failed_ && !out.tests_last) out.body.push_back(statement());
  close_scope();
  return failed_ ? unreadable(begin, "a loop") : out;
}

// for (TYPE NAME : RANGE)
bool Parser::for_each(Statement& out) {
  const auto read = tried([&] {
    Statement each = out;
    if (!is_declaration()) fail();
    declaration(each, false);
    if (each.declared.size() != 1) fail();
    expect(":");
    each.kind = StatementKind::each;
    each.value.push_back(peek().is("{") ? list("}") : expression());
    return each;
  });
  if (read) out = *read;
  return read.has_value();
}

Statement Parser::choice() {
  const std::size_t begin = at_;
  Statement out = empty_at(take(), StatementKind::choice);
  condition(out);
  if (failed_ || !peek().is("{")) return unreadable(begin, "a switch");
  Statement body = block();
  out.body = std::move(body.body);
  // A label inside of another statement is not modelled.
  std::size_t labels = 0, seen = 0;
  for (std::size_t i = begin, inner = 0; i < at_; ++i) {
    if (token(i).is("switch") && i > begin)
      inner = std::max(inner, behind_brackets(std::min(behind_brackets(i + 1), end_ - 1)));
    if (i >= inner && (token(i).is("case") || (token(i).is("default") && token(i + 1).is(":")))) ++labels;
  }
  for (const Statement& one : out.body) {
    if (one.kind != StatementKind::label) continue;
    ++seen;
    if (!one.value.empty() && one.value[0].kind == ExpressionKind::unreadable) return unreadable(begin, "a constant");
  }
  return labels == seen ? out : unreadable(begin, "labels in the block of the switch alone");
}

}  // namespace ninebit::code
