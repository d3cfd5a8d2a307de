// Finds the functions of a file, and the declarations and statements outside of them.
#include <map>
#include <utility>

#include "src/language/source_code/code_parser.h"

namespace ninebit::code {
void Parser::read_outline() {
  while (!at_end()) {
    const std::size_t begin = at_;
    if (skip_words()) continue;
    if (peek().is("}")) {
      take();
    } else if (peek().is("namespace") || (peek().is("extern") && peek(1).kind == Token::Kind::text)) {
      while (!at_end() && !peek().is("{") && !peek().is(";") && !peek().is("(")) {
        take();
        if (token(at_ - 1).kind == Token::Kind::text) break;  // extern "C" void f()
      }
      takes("{");
    } else {
      part();
    }
    if (at_ == begin) take();
  }
  add_defaults();
}

// Skips what declares nothing: labels, annotations, imports.
bool Parser::skip_words() {
  if (takes(";")) return true;
  if (peek().is_name() && peek(1).is(":") && !peek(2).is(":")) {
    at_ += 2;
  } else if (peek().is("@") && peek(1).is_name() && !peek(1).is("interface")) {
    at_ += 2;
    if (peek().is("(")) skip_brackets();
  } else if (is_one_of(peek(), {"using", "import", "package", "friend"})) {
    skip_statement();
  } else {
    return false;
  }
  return true;
}

// To behind a semicolon or a block.
void Parser::skip_statement() {
  while (!at_end() && !peek().is("}")) {
    const bool block = peek().is("{");
    if (peek().is("{") || peek().is("(") || peek().is("[")) {
      skip_brackets();
    } else if (take().is(";")) {
      return;
    }
    if (block) {
      takes(";");
      return;
    }
  }
}

Parser::DeclarationHead Parser::head() {
  DeclarationHead out{.begin = at_};
  const std::size_t begin = at_;
  bool initializers = false;  // of a constructor
  while (!at_end()) {
    const Token& one = peek();
    if (one.is("template") && peek(1).is("<")) {
      out.is_template = true;
      take();
      int depth = 0;
      do {
        if (peek().is("<")) ++depth;
        if (peek().is(">")) --depth;
        if (peek().is(">>")) depth -= 2;
        take();
      } while (depth > 0 && !at_end());
      out.begin = at_;
      continue;
    }
    if (one.is("{")) {
      const bool member = initializers && token(at_ - 1).is_name();
      if (!member) break;
      skip_brackets();
      continue;
    }
    if (one.is(";") || one.is("}")) break;
    if (one.is("(") || one.is("[")) {
      const std::string_view before = at_ > out.begin ? token(at_ - 1).text : std::string_view();
      const bool attribute = before == "__attribute__" || before == "__declspec" || before == "alignas";
      if (one.is("(") && out.assignment == 0 && out.parenthesis == 0 && !attribute) out.parenthesis = at_;
      skip_brackets();
      continue;
    }
    if (one.is("=") && out.assignment == 0 && out.parenthesis == 0) out.assignment = at_;
    if (one.is(":") && out.parenthesis != 0) initializers = true;
    if (out.parenthesis == 0 && out.assignment == 0) {
      out.is_class = out.is_class || one.is("class") || one.is("struct") || one.is("union") || one.is("interface") ||
                     one.is("enum");
    }
    take();
  }
  out.stop = at_;
  at_ = begin;
  return out;
}

void Parser::part() {
  const DeclarationHead head = this->head();
  const bool braces = head.stop < end_ && token(head.stop).is("{");
  if (is_one_of(token(head.begin), {"if", "for", "while", "do", "switch", "else", "try", "return"})) return code(head);
  // Old parameters stand between the parentheses and the brace, each with a semicolon.
  std::size_t old = head.parenthesis == 0 ? 0 : std::min(behind_brackets(head.parenthesis), end_);
  const bool follows = old != 0 && old < head.stop && !braces && begins_type(old);
  while (follows && old < end_ && !token(old).is("{") && !token(old).is("(") && !token(old).is("=")) ++old;
  const bool is_old = follows && old < end_ && token(old).is("{");
  if (head.parenthesis != 0 && head.assignment == 0 && (braces || is_old)) {
    DeclarationHead whole = head;
    if (is_old) whole.stop = old;
    if (function(whole, nullptr)) return;
  }
  at_ = head.begin;
  Statement out;
  out.offset = peek().offset;
  const bool has_calls = file_.calls_between(peek().offset, head.stop < end_ ? token(head.stop).end : last_end());
  const bool is_call = head.parenthesis > head.begin && head.assignment == 0 && !head.is_class;
  if (!(has_calls && is_call) && is_declaration()) {
    declaration(out, false);
    if (!std::exchange(failed_, false)) {
      if (!out.declared.empty()) outline_.globals.push_back(std::move(out));
      return;
    }
  }
  at_ = head.begin;
  const bool is_block = peek().is("{");
  const bool block_calls = is_block && file_.calls_between(peek().offset, token(file_.closing[at_]).end);
  if (has_calls || block_calls || head.assignment != 0) return code(head);
  // Words that mean nothing here may stand before a declaration.
  if (head.stop > head.begin + 2 && peek().is_name() && peek(1).is_name() && !head.is_class) {
    take();
    return;
  }
  skip_statement();
}

void Parser::code(const DeclarationHead& head) {
  at_ = head.begin;
  Statement one = statement();
  if (one.kind != StatementKind::nothing) outline_.code.push_back(std::move(one));
}

// A function with its body, or its declaration; false: it is something else.
bool Parser::function(const DeclarationHead& head, Struct* of) {
  Function out;
  const std::size_t open = head.parenthesis;
  std::size_t name = open - 1;
  const bool destroys = name > head.begin && token(name - 1).is("~");
  bool is_operator = false;
  for (std::size_t i = head.begin; i < open; ++i) is_operator = is_operator || token(i).is("operator");
  if (of != nullptr) {
    const bool constructs = token(name).text == of->name && !destroys;
    of->is_special = of->is_special || constructs || destroys || is_operator;
    of->is_destroyed = of->is_destroyed || destroys;
  }
  const bool braces = head.stop < end_ && token(head.stop).is("{");
  if (is_operator || open == head.begin || !token(name).is_name()) {
    at_ = head.stop;
    if (braces) skip_brackets();
    takes(";");
    return true;
  }
  out.own_name = token(name).text;
  out.offset = token(name).offset;
  out.name = std::string(out.own_name);
  std::size_t at = name;
  if (destroys && token(--at).text.data() + 1 == out.own_name.data()) {
    out.own_name = {token(at).text.data(), out.own_name.size() + 1};
    out.name = std::string(out.own_name);
  }
  for (; at >= head.begin + 2 && token(at - 1).is("::") && token(at - 2).is_name(); at -= 2) {
    if (out.scope.empty()) out.scope = token(at - 2).text;
    out.name.insert(0, std::string(token(at - 2).text) + "::");
  }
  if (out.scope.empty() && !classes_.empty() && !classes_.back().empty()) {
    out.scope = classes_.back();
    out.name.insert(0, std::string(out.scope) + "::");
  }
  out.is_template = head.is_template;
  out.result = result_type(head.begin, at);
  at_ = open;
  parameters(out);
  at_ = std::min(behind_brackets(open), head.stop);
  if (!braces && !(head.stop < end_ && token(head.stop).is("{"))) {
    at_ = head.stop;
    takes(";");
    outline_.prototypes.push_back(std::move(out));
    return true;
  }
  for (std::size_t i = at_; i < head.stop; ++i) {
    if (token(i).is(":")) out.is_special = true;  // a constructor's initializers
    if (token(i).is(";")) {
      old_parameters(out);
      break;
    }
  }
  at_ = head.stop;
  out.begin = peek().offset;
  out.first = at_ + 1;
  skip_brackets();
  out.last = at_ - 1;
  out.end = last_end();
  outline_.functions.push_back(std::move(out));
  return true;
}

// The type before a function's name, behind words that mean nothing here.
const Type* Parser::result_type(std::size_t begin, std::size_t name) {
  const std::size_t end = std::exchange(end_, name);
  const Type* found = nullptr;
  for (std::size_t i = begin; i < name && found == nullptr; ++i) {
    at_ = i;
    Specifiers words;
    if (!specifiers(words, false) || words.type == nullptr) continue;
    Declared out;
    const Type* const type = pointers(words.type, out);
    while (peek().is_name()) take();  // APIENTRY
    if (at_ == name) found = out.is_reference ? this->type({.kind = TypeKind::opaque}) : type;
  }
  end_ = end;
  return found != nullptr ? found : unknown_type();
}

// int f(a, b) int a; float b; {
void Parser::old_parameters(Function& out) {
  while (!failed_ && !at_end() && !peek().is("{")) {
    Statement old;
    declaration(old, true);
    for (const Declared& one : old.declared) {
      for (Declared& parameter : out.parameters) {
        if (parameter.name == one.name) parameter.type = decayed(one.type);
      }
    }
  }
  failed_ = false;
}

// Defaults of parameters often stand with the declaration alone.
void Parser::add_defaults() {
  std::map<std::pair<std::string_view, std::size_t>, const Function*> declared;
  for (const Function& one : outline_.prototypes) declared.try_emplace({one.own_name, one.parameters.size()}, &one);
  for (Function& function : outline_.functions) {
    const auto found = declared.find({function.own_name, function.parameters.size()});
    if (found == declared.end()) continue;
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
      std::vector<Expression>& value = function.parameters[i].value;
      if (value.empty()) value = found->second->parameters[i].value;
    }
  }
}

}  // namespace ninebit::code
