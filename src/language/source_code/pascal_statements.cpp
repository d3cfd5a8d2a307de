// Pascal's statements.
#include <algorithm>
#include <iterator>
#include <utility>

#include "src/language/source/source_faults.h"
#include "src/language/source_code/code_tree_build.h"
#include "src/language/source_code/pascal_parser.h"

namespace ninebit::code {
namespace {

using PascalStatement = Statement::Kind;

Statement started(const Token& token, PascalStatement kind) {
  Statement out;
  out.kind = kind;
  out.offset = token.offset;
  out.end = token.end;
  return out;
}

}  // namespace

void PascalParser::skip_to_semicolon() {
  while (!in_.at_end() && !is(";") && !is("end") && !is("until") && !is("else")) in_.skip_brackets();
}

std::vector<Statement> PascalParser::statements() {
  std::vector<Statement> all;
  while (!in_.at_end() && !is("end") && !is("until") && !is("else") && !is("except") && !is("finally")) {
    if (takes(";")) continue;
    all.push_back(statement());
  }
  return all;
}

Statement PascalParser::statement() {
  const Token token = in_.peek();
  if (depth_ >= kMostNestedStatements) {
    skip_to_semicolon();
    if (!is(";")) in_.take();
    return started(token, PascalStatement::unreadable);
  }
  ++depth_;
  Statement out = controlled();
  --depth_;
  out.offset = token.offset;
  out.end = std::max(token.end, in_.last_end());
  return out;
}

Statement PascalParser::controlled() {
  const Token token = in_.peek();
  if (takes("begin")) {
    Statement out = started(token, PascalStatement::block);
    out.body = statements();
    takes("end");
    return out;
  }
  if (takes("if")) {
    Statement out = started(token, PascalStatement::branch);
    out.value.push_back(expression());
    while (!in_.at_end() && !is("then") && !is(";") && !is("end")) in_.take();
    takes("then");
    if (!is("else")) out.body.push_back(statement());
    if (takes("else")) out.otherwise.push_back(statement());
    return out;
  }
  if (is("for")) return for_loop();
  if (takes("while")) {
    Statement out = started(token, PascalStatement::loop);
    out.value.push_back(expression());
    while (!in_.at_end() && !is("do") && !is(";") && !is("end")) in_.take();
    takes("do");
    out.body.push_back(statement());
    return out;
  }
  if (takes("repeat")) {
    Statement out = started(token, PascalStatement::loop);
    out.tests_last = out.is_repeated_until = true;
    out.body = statements();
    takes("until");
    out.value.push_back(expression());
    return out;
  }
  if (is("case")) return choice();
  if (takes("with")) {
    while (!in_.at_end() && !is("do") && !is(";") && !is("end")) in_.take();
    takes("do");
    return statement();
  }
  if (takes("try")) {
    Statement out = started(token, PascalStatement::block);
    out.body = statements();
    if (takes("finally")) {
      std::vector<Statement> last = statements();
      std::move(last.begin(), last.end(), std::back_inserter(out.body));
    }
    if (takes("except")) statements();
    takes("end");
    return out;
  }
  if (takes("exit")) {
    if (is("(")) in_.skip_brackets();
    return started(token, PascalStatement::give_back);
  }
  if (takes("break")) return started(token, PascalStatement::leave);
  if (takes("continue")) return started(token, PascalStatement::next);
  return plain();
}

// for i := a to b do
Statement PascalParser::for_loop() {
  const Token token = in_.take();
  Statement out = started(token, PascalStatement::loop);
  const Token name = in_.take();
  Expression begin, end;
  bool good = name.is_name() && takes(":=");
  if (good) begin = expression();
  const bool down = is("downto");
  good = good && !failed(begin) && (takes("to") || takes("downto"));
  if (good) end = expression();
  if (!good || failed(end)) {
    out.kind = PascalStatement::unreadable;
    out.message = "expected for NAME := FIRST to LAST do";
  } else {
    const auto variable = [&] { return made(Expression::Kind::name, name.text, name.offset, name.end); };
    Statement first = started(name, PascalStatement::expression);
    first.value.push_back(joined(Expression::Kind::assignment, "=", variable(), std::move(begin)));
    out.first.push_back(std::move(first));
    out.value.push_back(joined(Expression::Kind::binary, down ? ">=" : "<=", variable(), std::move(end)));
    out.step.push_back(around(Expression::Kind::unary, down ? "--" : "++", name.offset, variable()));
  }
  while (!in_.at_end() && !is("do") && !is(";") && !is("end")) in_.take();
  takes("do");
  out.body.push_back(statement());
  return out;
}

// case x of a, b: …; else … end
Statement PascalParser::choice() {
  const Token token = in_.take();
  Statement out = started(token, PascalStatement::choice);
  out.value.push_back(expression());
  while (!in_.at_end() && !is("of") && !is(";") && !is("end")) in_.take();
  takes("of");
  while (!in_.at_end() && !is("end")) {
    if (takes(";")) continue;
    if (takes("else")) {
      out.body.push_back(started(in_.peek(), PascalStatement::label));
      std::vector<Statement> rest = statements();
      std::move(rest.begin(), rest.end(), std::back_inserter(out.body));
      break;
    }
    do {
      Statement label = started(in_.peek(), PascalStatement::label);
      label.value.push_back(expression());
      if (failed(label.value[0])) break;
      out.body.push_back(std::move(label));
    } while (takes(","));
    while (!in_.at_end() && !is(":") && !is("end") && !is(";")) in_.take();
    takes(":");
    if (!is(";") && !is("end") && !is("else")) out.body.push_back(statement());
    out.body.push_back(started(in_.peek(), PascalStatement::leave));
  }
  takes("end");
  return out;
}

// An assignment or a call, which needs no parentheses.
Statement PascalParser::plain() {
  const std::size_t begin = in_.at();
  const Token token = in_.peek();
  if (token.is_name() && is(":", 1)) {  // a label
    in_.take();
    in_.take();
    return started(token, PascalStatement::nothing);
  }
  Statement out = started(token, PascalStatement::expression);
  Expression value = expression();
  // What looks like a comparison at the beginning is none.
  if (!failed(value) && takes(":=")) {
    Expression right = expression();
    value = failed(right) ? std::move(right)
                          : joined(Expression::Kind::assignment, "=", std::move(value), std::move(right));
  } else if (value.kind == Expression::Kind::name || value.kind == Expression::Kind::member) {
    const std::uint32_t offset = value.offset;
    value = around(Expression::Kind::call, {}, offset, std::move(value));
  }
  const bool ends = is(";") || is("end") || is("else") || is("until") || is("except") || is("finally") || in_.at_end();
  if (!failed(value) && ends) {
    out.value.push_back(std::move(value));
    return out;
  }
  out.kind = PascalStatement::unreadable;
  out.message = "expected ';', found " + detail::quoted(in_.peek().text);
  if (in_.at() == begin && !ends) in_.skip_brackets();
  skip_to_semicolon();
  return out;
}

}  // namespace ninebit::code
