// Finds the functions of a C-like file, and the declarations and statements outside of them.
#include <algorithm>
#include <map>
#include <utility>

#include "src/language/source_code/code_parser.h"
#include "src/language/source_code/code_types.h"

namespace ninebit::code {
namespace {

bool is_keyword_of_control(const Token& token) {
  for (const std::string_view word : {"if", "for", "while", "do", "switch", "else", "try", "return"}) {
    if (token.is(word)) return true;
  }
  return false;
}

// What stands before a brace, a semicolon or the end at the outermost level of the file or of a class.
struct Head {
  std::size_t begin = 0, stop = 0;  // tokens; `stop` is the brace or the semicolon
  std::size_t parenthesis = 0;      // the first one; 0: none
  std::size_t assignment = 0;       // the first '=' outside of brackets; 0: none
  bool is_scope = false;            // namespace, extern "C"
  bool is_class = false;
  bool is_enum = false;
};

class OutlineReader {
 public:
  explicit OutlineReader(const File& file) : file_(file), in_(file, 0, file.tokens.size() - 1) {}

  Outline read() {
    StatementParser parser(in_, outline_);
    parser_ = &parser;
    while (!in_.at_end()) {
      if (in_.peek().is("}")) {
        in_.take();
        if (!scopes_.empty()) scopes_.pop_back();
        continue;
      }
      const bool label = in_.peek().is_name() && in_.peek(1).is(":") && !in_.peek(2).is(":");
      if (in_.peek().is(";") || label) {
        in_.take();
        if (label) in_.take();
        continue;
      }
      part(head());
    }
    parser_ = nullptr;
    add_defaults();
    return std::move(outline_);
  }

 private:
  [[nodiscard]] const Token& token(std::size_t i) const { return file_.tokens[i]; }

  Head head() {
    Head out{.begin = in_.at()};
    bool initializers = false;  // of a constructor
    while (!in_.at_end()) {
      const Token& token = in_.peek();
      if (token.is("{")) {
        const bool member = initializers && this->token(in_.at() - 1).is_name();
        if (!member) break;
        in_.skip_brackets();
        continue;
      }
      if (token.is(";") || token.is("}")) break;
      const bool before_arguments = out.parenthesis == 0 && out.assignment == 0;
      if (token.is("(") || token.is("[")) {
        const std::string_view before = in_.at() > out.begin ? this->token(in_.at() - 1).text : std::string_view();
        const bool annotation = in_.at() >= out.begin + 2 && this->token(in_.at() - 2).is("@");
        const bool attribute = annotation || before == "__attribute__" || before == "__declspec" || before == "alignas";
        if (token.is("(") && out.assignment == 0 && out.parenthesis == 0 && !attribute) out.parenthesis = in_.at();
        in_.skip_brackets();
        continue;
      }
      if (token.is("=") && out.assignment == 0 && out.parenthesis == 0) out.assignment = in_.at();
      if (token.is(":") && out.parenthesis != 0) initializers = true;
      if (before_arguments) {
        out.is_scope = out.is_scope || token.is("namespace") || (token.is("extern") && next_is_text());
        out.is_class =
            out.is_class || token.is("class") || token.is("struct") || token.is("union") || token.is("interface");
        out.is_enum = out.is_enum || token.is("enum");
      }
      in_.take();
    }
    out.stop = in_.at();
    return out;
  }

  [[nodiscard]] bool next_is_text() const { return in_.peek(1).kind == Token::Kind::text; }

  void part(const Head& head) {
    const bool braces = !in_.at_end() && in_.peek().is("{");
    if (head.begin == head.stop && !braces) return;
    if (is_keyword_of_control(token(head.begin))) return code(head);
    if (!braces) return plain(head);
    if (head.is_enum && head.assignment == 0) return global(head);
    if ((head.is_scope && head.parenthesis == 0) || (head.is_class && head.parenthesis == 0 && head.assignment == 0))
      return scope(head);
    if (head.assignment != 0) return global(head);
    if (head.parenthesis != 0) return function(head);
    // A block of its own: of Java's classes, or in a piece of code.
    if (file_.calls_between(in_.peek().offset, end_of_block())) return code(head);
    in_.skip_brackets();
  }

  [[nodiscard]] std::uint32_t end_of_block() {
    const std::size_t at = in_.at();
    in_.skip_brackets();
    const std::uint32_t end = in_.last_end();
    in_.move_to(at);
    return end;
  }

  // A statement that ends with a semicolon.
  void plain(const Head& head) {
    const std::uint32_t end = in_.at_end() ? token(head.stop - 1).end : in_.peek().end;
    if (file_.calls_between(token(head.begin).offset, end) && head.assignment == 0) return code(head);
    if (head.assignment != 0 || token(head.begin).is("typedef")) return global(head);
    if (head.parenthesis > head.begin && token(head.parenthesis - 1).is_name()) prototype(head);
    in_.takes(";");
  }

  void code(const Head& head) {
    in_.move_to(head.begin);
    Statement statement = parser_->statement();
    if (statement.kind != Statement::Kind::nothing) outline_.code.push_back(std::move(statement));
    if (in_.at() == head.begin) in_.take();
  }

  void global(const Head& head) {
    in_.move_to(head.begin);
    while (in_.peek().is("@") || in_.peek().is("[")) in_.skip_brackets();  // annotations
    Statement out;
    if (!parser_->type_definition(out)) {
      if (!parser_->is_declaration() || in_.peek().is("typedef")) return code(head);
      out = parser_->declaration();
    }
    if (in_.at() == head.begin) in_.take();
    if (out.kind == Statement::Kind::declaration) outline_.globals.push_back(std::move(out));
  }

  // Its content is read as if it stood outside, under its name.
  void scope(const Head& head) {
    std::string_view name;
    for (std::size_t i = head.begin; i < head.stop && !token(i).is(":"); ++i) {
      if (token(i).is("extends") || token(i).is("implements")) break;
      if (token(i).is_name()) name = token(i).text;
    }
    if (head.is_class) {
      // A struct of data alone also gives the order of its members.
      const std::size_t open = in_.at();
      in_.move_to(head.begin);
      Statement out;
      const bool is_data = has_no_functions(open);
      in_.move_to(head.begin);
      if (is_data && parser_->type_definition(out)) {
        if (!out.declared.empty()) outline_.globals.push_back(std::move(out));
        return;
      }
      in_.move_to(open);
    }
    in_.take();
    scopes_.push_back(head.is_class ? name : std::string_view());
  }

  // Whether no parenthesis stands between a brace and its end.
  [[nodiscard]] bool has_no_functions(std::size_t open) const {
    constexpr std::size_t kLongest = 4096;
    const std::size_t close = file_.closing[open];
    if (close - open > kLongest) return false;
    for (std::size_t i = open; i < close; ++i) {
      if (token(i).is("(")) return false;
    }
    return true;
  }

  void function(const Head& head) {
    Function out;
    std::size_t name = head.parenthesis;
    const bool objective = token(head.begin).is("-") || token(head.begin).is("+");
    if (objective) {  // - (void)setup
      in_.move_to(head.parenthesis);
      in_.skip_brackets();
      name = in_.at() + 1;
      in_.move_to(head.stop);
    }
    const Token& own = token(name - 1);
    if (!own.is_name() || name <= head.begin) {
      in_.skip_brackets();
      return;
    }
    out.own_name = own.text;
    out.offset = own.offset;
    out.name = std::string(own.text);
    std::size_t at = name - 1;
    for (; at >= head.begin + 2 && (token(at - 1).is("::") || token(at - 1).is("~")) && token(at - 2).is_name();
         at -= 2) {
      out.name.insert(0, std::string(token(at - 2).text) + "::");
    }
    if (out.name == own.text) {
      const auto inner = std::find_if(scopes_.rbegin(), scopes_.rend(), [](std::string_view s) { return !s.empty(); });
      if (inner != scopes_.rend()) out.name.insert(0, std::string(*inner) + "::");
    }
    if (!objective) parameters(head.parenthesis, out);
    out.begin = in_.peek().offset;
    out.first = in_.at() + 1;
    in_.skip_brackets();
    out.last = in_.at() - 1;
    out.end = in_.last_end();
    outline_.functions.push_back(std::move(out));
  }

  // Defaults of parameters often stand with the declaration alone.
  void prototype(const Head& head) {
    Function declared;
    declared.own_name = token(head.parenthesis - 1).text;
    parameters(head.parenthesis, declared);
    const auto has_default = [](const Parameter& one) { return !one.value.empty(); };
    if (std::any_of(declared.parameters.begin(), declared.parameters.end(), has_default)) {
      prototypes_.push_back(std::move(declared));
    }
  }

  void add_defaults() {
    std::map<std::string_view, std::vector<const Function*>> by_name;
    for (const Function& one : prototypes_) by_name[one.own_name].push_back(&one);
    for (Function& function : outline_.functions) {
      const auto found = by_name.find(function.own_name);
      if (found == by_name.end()) continue;
      for (const Function* const one : found->second) {
        if (one->parameters.size() != function.parameters.size()) continue;
        for (std::size_t i = 0; i < one->parameters.size(); ++i) {
          if (function.parameters[i].value.empty()) function.parameters[i].value = one->parameters[i].value;
        }
        break;
      }
    }
  }

  // The names between the parentheses, each with its default.
  void parameters(std::size_t open, Function& out) {
    const std::size_t after = in_.at();
    in_.move_to(open);
    in_.skip_brackets();
    const std::size_t close = in_.at() - 1;
    in_.move_to(after);
    TokenCursor list(file_, open + 1, close);
    while (!list.at_end()) {
      Parameter one;
      std::size_t names = 0;
      while (!list.at_end() && !list.peek().is(",")) {
        const Token& token = list.peek();
        if (token.is("=")) {
          list.take();
          ExpressionParser values(list);
          one.value.push_back(values.expression());
          break;
        }
        if (token.is("(") || token.is("[") || token.is("{")) {
          list.skip_brackets();
          continue;
        }
        if (token.is_name() && !token.is("const") && !token.is("volatile")) {
          one.name = token.text;
          ++names;
        }
        list.take();
      }
      while (!list.at_end() && !list.takes(",")) list.take();
      if (names < 2) one.name = {};  // a type alone
      out.parameters.push_back(std::move(one));
    }
    const bool nothing = out.parameters.size() == 1 && out.parameters[0].name.empty();
    if (nothing) out.parameters.clear();
  }

  const File& file_;
  TokenCursor in_;
  Outline outline_;
  StatementParser* parser_ = nullptr;
  std::vector<Function> prototypes_;      // with defaults
  std::vector<std::string_view> scopes_;  // the classes around the current place; empty: another scope
};

}  // namespace

Outline read_outline(const File& file) {
  return OutlineReader(file).read();
}

}  // namespace ninebit::code
