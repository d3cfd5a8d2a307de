// Finds the routines of a Pascal file, and the declarations and statements outside of them.
#include <utility>

#include "src/language/source_code/pascal_parser.h"

namespace ninebit::code {
namespace {

class PascalReader {
 public:
  explicit PascalReader(const File& file) : in_(file, 0, file.tokens.size() - 1), parser_(in_, outline_.arrays) {}

  Outline read() {
    while (!in_.at_end()) {
      if (parser_.takes("interface")) {
        in_interface_ = true;
      } else if (parser_.takes("implementation")) {
        in_interface_ = false;
      } else if (!section(outline_.globals)) {
        other();
      }
    }
    return std::move(outline_);
  }

 private:
  // A section of declarations, or a routine; false: there is none here.
  bool section(std::vector<Statement>& into) {
    Statement out;
    out.kind = Statement::Kind::declaration;
    out.offset = in_.peek().offset;
    if (parser_.takes("const") || parser_.takes("resourcestring")) {
      parser_.constants(out);
    } else if (parser_.takes("var") || parser_.takes("threadvar")) {
      parser_.variables(out);
    } else if (parser_.takes("type")) {
      parser_.types(out);
    } else if (is_routine(0) || (parser_.is("class") && is_routine(1))) {
      routine();
      return true;
    } else {
      return false;
    }
    into.push_back(std::move(out));
    return true;
  }

  [[nodiscard]] bool is_routine(std::size_t ahead) const {
    return parser_.is("procedure", ahead) || parser_.is("function", ahead) || parser_.is("constructor", ahead) ||
           parser_.is("destructor", ahead);
  }

  // The main program, or a part that is not needed.
  void other() {
    const bool main = parser_.takes("begin") || parser_.takes("initialization") || parser_.takes("finalization");
    if (!main) {
      in_.skip_brackets();
      return;
    }
    while (!in_.at_end() && !parser_.is("end")) {
      std::vector<Statement> body = parser_.statements();
      outline_.code.insert(outline_.code.end(), std::make_move_iterator(body.begin()),
                           std::make_move_iterator(body.end()));
      if (!in_.at_end() && !parser_.is("end")) in_.take();
    }
    parser_.takes("end");
  }

  void routine() {
    parser_.takes("class");
    in_.take();
    Function out;
    out.offset = in_.peek().offset;
    while (in_.peek().is_name()) {
      out.own_name = in_.take().text;
      out.name += (out.name.empty() ? "" : "::") + std::string(out.own_name);
      if (!parser_.takes(".")) break;
    }
    if (parser_.is("(")) parameters(out);
    while (!in_.at_end() && !parser_.is(";")) in_.skip_brackets();
    parser_.takes(";");
    if (!has_body()) return;
    out.first = in_.at();
    out.begin = in_.peek().offset;
    // Inner routines stand among the declarations; they are functions of their own.
    std::vector<Statement> declarations;
    if (++depth_ < kMostNestedStatements) {
      while (!in_.at_end() && !parser_.is("begin") && !parser_.is("asm") && section(declarations)) {
      }
    }
    --depth_;
    out.block = in_.at();
    skip_block();
    out.last = in_.at();
    out.end = in_.last_end();
    parser_.takes(";");
    if (!out.own_name.empty()) outline_.functions.push_back(std::move(out));
  }

  // Skips directives such as stdcall; and says whether a body follows.
  bool has_body() {
    bool forward = in_interface_;
    for (bool more = true; more && !in_.at_end();) {
      more = false;
      for (const std::string_view word : {"forward", "external", "stdcall", "cdecl", "overload", "inline", "virtual",
                                          "override", "register", "pascal", "abstract", "dynamic", "reintroduce"}) {
        if (!parser_.is(word)) continue;
        forward = forward || word == "forward" || word == "external" || word == "abstract";
        while (!in_.at_end() && !parser_.is(";")) in_.take();
        parser_.takes(";");
        more = true;
      }
    }
    return !forward;
  }

  // From begin, or another word, to its end.
  void skip_block() {
    std::size_t depth = 0;
    while (!in_.at_end()) {
      const bool opens = parser_.is("begin") || parser_.is("case") || parser_.is("try") || parser_.is("asm");
      const bool closes = parser_.is("end");
      in_.take();
      if (opens) ++depth;
      if (closes && (depth == 0 || --depth == 0)) return;
    }
  }

  // (const a, b: TYPE; var c: TYPE = 1)
  void parameters(Function& out) {
    in_.take();
    while (!in_.at_end() && !parser_.is(")")) {
      std::vector<std::string_view> names;
      for (const std::string_view word : {"const", "var", "out"}) parser_.takes(word);
      while (in_.peek().is_name()) {
        names.push_back(in_.take().text);
        if (!parser_.takes(",")) break;
      }
      Parameter one;
      while (!in_.at_end() && !parser_.is(";") && !parser_.is(")")) {
        if (parser_.takes("=")) {
          one.value.push_back(parser_.expression());
          break;
        }
        in_.skip_brackets();
      }
      for (const std::string_view name : names) {
        one.name = name;
        out.parameters.push_back(one);
      }
      if (names.empty() && !parser_.is(";") && !parser_.is(")")) in_.take();
      parser_.takes(";");
    }
    parser_.takes(")");
  }

  TokenCursor in_;
  Outline outline_;
  PascalParser parser_;
  bool in_interface_ = false;
  int depth_ = 0;
};

}  // namespace

Outline read_pascal_outline(const File& file) {
  return PascalReader(file).read();
}

std::vector<Statement> read_pascal_body(const File& file, const Function& function, Outline& outline) {
  TokenCursor in(file, function.first, function.last);
  PascalParser parser(in, outline.arrays);
  std::vector<Statement> body;
  while (in.at() < function.block) {
    Statement out;
    out.kind = Statement::Kind::declaration;
    out.offset = in.peek().offset;
    if (parser.takes("const")) {
      parser.constants(out);
    } else if (parser.takes("var")) {
      parser.variables(out);
    } else if (parser.takes("type")) {
      parser.types(out);
    } else {  // routines inside
      break;
    }
    body.push_back(std::move(out));
  }
  in.move_to(function.block);
  if (!in.at_end()) body.push_back(parser.statement());
  return body;
}

}  // namespace ninebit::code
