// Declarations of C-like languages.
#include <algorithm>
#include <iterator>
#include <utility>

#include "src/language/source_code/code_parser.h"
#include "src/language/source_code/code_tree_build.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

bool is_structure(const Token& token) {
  return token.is("struct") || token.is("class") || token.is("union");
}

// The last index behind a pair of angle brackets that begins `ahead`; `ahead`: there is none.
std::size_t behind_angles(const TokenCursor& in, std::size_t ahead) {
  constexpr std::size_t kLongest = 32;
  if (!in.peek(ahead).is("<")) return ahead;
  std::size_t depth = 0;
  for (std::size_t i = ahead; i < ahead + kLongest; ++i) {
    const Token& token = in.peek(i);
    if (token.is("<")) ++depth;
    if (token.is(">>")) depth -= std::min<std::size_t>(depth, 1);
    if ((token.is(">") || token.is(">>")) && (depth == 0 || --depth == 0)) return i + 1;
    if (token.is(";") || token.is("(") || token.is("{") || token.kind == Token::Kind::end) break;
  }
  return ahead;
}

// How many tokens a type has that begins here; 0: none does. `type` is its last word.
std::size_t type_size(const TokenCursor& in, std::string_view& type, bool& is_constant) {
  std::size_t i = 0;
  bool words = false;
  for (; in.peek(i).is_name() && (is_qualifier(in.peek(i).text) || is_structure(in.peek(i)) || in.peek(i).is("enum"));
       ++i) {
    is_constant = is_constant || in.peek(i).is("const") || in.peek(i).is("final") || in.peek(i).is("constexpr");
  }
  for (; in.peek(i).is_name() && type_kind(in.peek(i).text) != TypeKind::other; ++i) {
    type = in.peek(i).text;
    words = true;
  }
  if (!words) {
    if (!in.peek(i).is_name()) return 0;
    type = in.peek(i++).text;
    while ((in.peek(i).is("::") || in.peek(i).is(".")) && in.peek(i + 1).is_name()) {
      type = in.peek(i + 1).text;
      i += 2;
    }
    i = behind_angles(in, i);
  }
  for (;; ++i) {
    const Token& token = in.peek(i);
    const bool empty_bounds = token.is("[") && in.peek(i + 1).is("]");
    if (empty_bounds) ++i;
    if (!empty_bounds && !token.is("*") && !token.is("&") && !token.is("const") && !token.is("^")) return i;
  }
}

bool begins_no_declaration(const Token& token) {
  for (const std::string_view word : {"return", "else", "new", "delete", "throw", "goto", "case", "default", "sizeof",
                                      "if", "for", "while", "do", "switch", "break", "continue", "using", "this"}) {
    if (token.is(word)) return true;
  }
  return false;
}

}  // namespace

bool StatementParser::is_declaration() const {
  if (!in_.peek().is_name() || begins_no_declaration(in_.peek())) return false;
  std::string_view type;
  bool is_constant = false;
  const std::size_t size = type_size(in_, type, is_constant);
  if (size == 0 || !in_.peek(size).is_name()) return false;
  const Token& next = in_.peek(size + 1);
  return next.is("=") || next.is(";") || next.is(",") || next.is("[") || next.is("(") || next.is("{");
}

Statement StatementParser::declaration() {
  const std::size_t begin = in_.at();
  Statement out;
  out.kind = Statement::Kind::declaration;
  out.offset = in_.peek().offset;
  std::string_view type;
  bool is_constant = false;
  in_.move_to(begin + type_size(in_, type, is_constant));
  declarators(out, type, is_constant);
  if (in_.takes(";") || in_.at_end()) {
    out.end = in_.last_end();
    return out;
  }
  return unreadable(begin, "a declaration");
}

// typedef TYPE NAME[bounds];
void StatementParser::array_type() {
  in_.take();
  if (!is_declaration()) return;
  const Statement typed = declaration();
  for (const Declared& one : typed.declared) {
    if (one.is_array) outline_.arrays[std::string(one.name)] = {{}, one.bounds, one.type, true};
  }
}

// NAME [bounds] [= value], …
void StatementParser::declarators(Statement& out, std::string_view type, bool is_constant) {
  while (in_.peek().is_name() || in_.peek().is("*") || in_.peek().is("&")) {
    while (in_.peek().is("*") || in_.peek().is("&") || in_.peek().is("const")) in_.take();
    Declared one;
    one.name = in_.peek().text;
    one.offset = in_.take().offset;
    one.type = type;
    one.is_constant = is_constant;
    while (in_.peek().is("[")) {
      one.is_array = true;
      in_.take();
      Expression bound;
      if (!in_.peek().is("]")) bound = expressions_.expression();
      if (!in_.takes("]")) return;
      one.bounds.push_back(std::move(bound));
    }
    if (const auto array = outline_.arrays.find(std::string(type)); array != outline_.arrays.end()) {
      one.is_array = true;
      one.bounds.insert(one.bounds.end(), array->second.size.begin(), array->second.size.end());
      one.type = array->second.element;
    }
    if (in_.takes("=")) {
      one.value.push_back(in_.peek().is("{") ? expressions_.list("}") : expressions_.expression());
      if (failed(one.value[0])) return;
    } else if (in_.peek().is("{")) {
      one.value.push_back(expressions_.list("}"));
      if (failed(one.value[0])) return;
    } else if (in_.peek().is("(")) {
      const std::size_t open = in_.at();
      Expression arguments = expressions_.list(")");
      if (failed(arguments)) {  // a function's
        in_.move_to(open);
        in_.skip_brackets();
      } else {
        arguments.text = type;
        one.value.push_back(std::move(arguments));
      }
    }
    out.declared.push_back(std::move(one));
    if (!in_.takes(",")) return;
  }
}

// A = 1, B, …
void StatementParser::enumerators(Statement& out) {
  while (in_.peek().is_name()) {
    Declared one;
    const Token name = in_.take();
    one.name = name.text;
    one.offset = name.offset;
    one.is_constant = true;
    if (in_.takes("=")) {
      one.value.push_back(expressions_.expression());
    } else if (out.declared.empty()) {
      one.value.push_back(made(Expression::Kind::number, "0", name.offset, name.end));
    } else {
      one.value.push_back(joined(Expression::Kind::binary, "+",
                                 made(Expression::Kind::name, out.declared.back().name, name.offset, name.end),
                                 made(Expression::Kind::number, "1", name.offset, name.end)));
    }
    out.declared.push_back(std::move(one));
    if (!in_.takes(",")) break;
  }
}

// The names between the braces of a struct, whose first is the next token; methods are skipped, constants added to
// `out`.
Members StatementParser::members(Statement& out) {
  Members all;
  in_.take();
  while (!in_.at_end() && !in_.peek().is("}")) {
    std::string_view last;
    bool is_method = false;
    while (!in_.at_end() && !in_.peek().is(";") && !in_.peek().is("}")) {
      const Token& token = in_.peek();
      Statement inner;
      if (token.is("enum") && type_definition(inner)) {  // its constants are known outside, too
        std::move(inner.declared.begin(), inner.declared.end(), std::back_inserter(out.declared));
        break;
      }
      if (token.is("(") || token.is("{") || token.is("[")) {
        is_method = is_method || token.is("(");
        const bool body = token.is("{");
        in_.skip_brackets();
        if (body && is_method) break;
        continue;
      }
      if (token.is(",") && !is_method && !last.empty()) all.push_back(last);
      if (token.is("=")) {
        while (!in_.at_end() && !in_.peek().is(";") && !in_.peek().is(",") && !in_.peek().is("}")) in_.take();
        continue;
      }
      if (token.is_name()) last = token.text;
      in_.take();
    }
    if (in_.peek().is(";") && !is_method && !last.empty()) all.push_back(last);
    in_.takes(";");
  }
  in_.takes("}");
  return all;
}

bool StatementParser::type_definition(Statement& out) {
  const std::size_t begin = in_.at();
  std::size_t ahead = 0;
  while (in_.peek(ahead).is("typedef") || (in_.peek(ahead).is_name() && is_qualifier(in_.peek(ahead).text))) ++ahead;
  const Token keyword = in_.peek(ahead);
  if (!is_structure(keyword) && !keyword.is("enum")) return false;
  const std::size_t keyword_at = ahead++;
  std::string_view name;
  while (in_.peek(ahead).is_name() || in_.peek(ahead).is(":") || in_.peek(ahead).is("::")) {
    if (name.empty() && in_.peek(ahead).is_name() && !in_.peek(ahead).is("class")) name = in_.peek(ahead).text;
    ++ahead;
  }
  if (!in_.peek(ahead).is("{")) return false;
  const bool is_typedef = keyword_at > 0 && in_.peek().is("typedef");
  in_.move_to(begin + ahead);
  out.kind = Statement::Kind::declaration;
  out.offset = keyword.offset;
  Members found;
  if (keyword.is("enum")) {
    in_.take();
    enumerators(out);
    while (!in_.at_end() && !in_.peek().is("}")) in_.take();
    in_.takes("}");
  } else {
    found = members(out);
    if (name.empty()) {
      outline_.names.push_back("struct at " + std::to_string(keyword.offset));
      name = outline_.names.back();
    }
  }
  const std::size_t constants = out.declared.size();
  declarators(out, name, false);
  // What a typedef declares are other names of the type.
  const auto name_type = [&](std::string_view type) {
    if (keyword.is("union")) outline_.unions.insert(type);
    if (keyword.is("struct") || keyword.is("class")) outline_.structs[type] = found;
  };
  name_type(name);
  if (is_typedef) {
    for (std::size_t i = constants; i < out.declared.size(); ++i) name_type(out.declared[i].name);
    out.declared.resize(constants);
  }
  in_.takes(";");
  return true;
}

}  // namespace ninebit::code
