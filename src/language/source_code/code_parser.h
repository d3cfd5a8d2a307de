// Parses C and C++ as far as calls and constants need it. Whatever it cannot read becomes an unreadable statement
// or expression, and reading goes on behind it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ninebit/language/source_code.h"
#include "src/language/c_like/c_lexer.h"
#include "src/language/c_like/c_macros.h"
#include "src/language/source/source_faults.h"
#include "src/language/source_code/code_tree.h"

namespace ninebit::code {

// A source file as tokens, its macros expanded and its conditional parts chosen.

// A whole #if … #endif that sets combiners and has a condition that depends on a name without a value.
struct OpenCondition {
  std::uint32_t begin = 0, end = 0;  // of the whole
  std::uint32_t offset = 0;          // of the condition
  std::string name{};
};

struct File {
  std::string_view text;
  std::vector<Token> tokens{};  // the last is Token::Kind::end
  std::vector<std::uint32_t>
      closing{};  // of each bracket that opens, the index of the one that closes it; else its own
  Macros macros{};
  std::deque<std::string> included{};                       // texts of included files
  std::vector<std::uint32_t> calls{};                       // where the text names a combiner call, ascending
  std::set<std::string, std::less<>> used_by_conditions{};  // names that the caller defined
  std::vector<OpenCondition> open_conditions{};             // read as if their names were 0
  bool reads_stages = false;                                // calls of texture shaders set a part of the program

  // Whether the bytes [begin, end) name a combiner call.
  [[nodiscard]] bool calls_between(std::size_t begin, std::size_t end) const;
};

// The places of all names that mean calls of combiners or of nvparse and are called, and of the members of an Xbox's
// definition that are assigned to; with `reads_stages` also of calls that may set texture shaders.
[[nodiscard]] std::vector<std::uint32_t> calls_of(std::string_view text, bool reads_stages);

// Whether a text names the target of glTexEnv that sets texture shaders. Texts that do not have no calls of them.
[[nodiscard]] bool names_stages(std::string_view text);

// Reads a file. Names that neither the file nor the selection defines are not defined in #ifdef and 0 in #if, as in C,
// with these exceptions: names of OpenGL's extensions are defined; if just one branch sets combiners, that one is read,
// with a note; and a condition of #if that then depends on such a name is one of File::open_conditions. A skipped
// branch that sets combiners is noted, too.
// `file.reads_stages` is the caller's.
void read_file(File& file, const SourceText& source, const SourceSelection& selection, detail::SourceFaults& faults,
               detail::SourceFaults& notes);

class Parser {
 public:
  Parser(const File& file, Outline& outline);

  // Fills the outline with what the whole file declares and defines.
  void read_outline();
  // The statements of a function's body.
  [[nodiscard]] std::vector<Statement> body(const Function& function);
  // An expression that stands alone, or several separated by commas; empty: it cannot be read.
  [[nodiscard]] std::vector<Expression> expressions();

  // Types, each once.
  const Type* number_type(Kinds kinds) { return type({.kind = TypeKind::number, .kinds = kinds}); }
  const Type* unknown_type() { return type({}); }
  const Type* pointer_to(const Type* of) { return type({.kind = TypeKind::pointer, .of = of}); }
  const Type* array_of(const Type* of, std::int64_t count);
  // The type of a parameter that is declared with one.
  const Type* decayed(const Type* type) {
    return type->is(TypeKind::array) ? pointer_to(type->of) : type->is(TypeKind::function) ? pointer_to(type) : type;
  }

 private:
  // The meaning of a name; a name without a type and a constant is a variable.
  struct Symbol {
    const Type* type = nullptr;
    std::optional<Number> constant{};
  };
  struct Specifiers {
    const Type* type = nullptr;
    bool is_constant = false, is_static = false, is_extern = false, is_typedef = false, is_final = false;
    bool is_volatile = false;
    std::vector<Declared> enumerators{};
  };
  // Reads the text before a brace or a semicolon at the outermost level of the file or of a class.
  struct DeclarationHead {
    std::size_t begin = 0, stop = 0;
    std::size_t parenthesis = 0, assignment = 0;  // the first ones outside of brackets; 0: none
    bool is_class = false, is_template = false;
  };

  struct Deeper {
    explicit Deeper(int& counted) : depth(++counted) {}
    ~Deeper() { --depth; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    int& depth;
  };

  // The cursor.
  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
    return at_ + ahead < end_ ? file_.tokens[at_ + ahead] : end_token_;
  }
  [[nodiscard]] const Token& token(std::size_t i) const { return file_.tokens[i]; }
  const Token& take() { return at_ < end_ ? file_.tokens[at_++] : end_token_; }
  void expect(std::string_view what) {
    if (!takes(what)) fail();
  }
  // Ends all that is read until the failure is looked at; what comes back in between means nothing.
  Expression fail();
  // The result of `read`; empty: it failed, and the cursor is where it was.
  template <class Read>
  auto tried(const Read& read) -> std::optional<decltype(read())> {
    if (failed_) return std::nullopt;
    const std::size_t begin = at_;
    auto out = read();
    if (!std::exchange(failed_, false)) return out;
    at_ = begin;
    return std::nullopt;
  }
  bool takes(std::string_view what) {
    if (!peek().is(what)) return false;
    ++at_;
    return true;
  }
  [[nodiscard]] bool at_end() const { return at_ >= end_; }
  [[nodiscard]] std::uint32_t last_end() const { return at_ == 0 ? 0 : file_.tokens[at_ - 1].end; }
  void skip_brackets() { at_ = std::min<std::size_t>(at_ < end_ ? file_.closing[at_] + std::size_t{1} : end_, end_); }
  [[nodiscard]] std::size_t behind_brackets(std::size_t at) const { return file_.closing[at] + std::size_t{1}; }
  [[nodiscard]] std::size_t behind_template(std::size_t at) const;

  // Types and declarations: code_declarations.cpp
  const Type* type(const Type& like);
  [[nodiscard]] const Symbol* symbol(std::string_view name) const;
  [[nodiscard]] const Type* known_type(std::string_view name);
  void declare(std::string_view name, Symbol symbol);
  void open_scope() { saved_.emplace_back(); }
  void close_scope();
  bool specifiers(Specifiers& out, bool takes_unknown);
  bool number_words(Specifiers& out);
  const Type* structure(Specifiers& out);
  void members(Struct& out, bool& is_read);
  void enumeration(Specifiers& out);
  const Type* pointers(const Type* base, Declared& out);
  const Type* declarator(const Type* base, Declared& out, Function* function);
  const Type* suffixes(const Type* base, Function* function);
  void parameters(Function& out);
  [[nodiscard]] bool is_declaration() const;
  [[nodiscard]] bool begins_type(std::size_t at) const;
  [[nodiscard]] bool holds_parameters(std::size_t open) const;
  void declaration(Statement& out, bool of_class);
  void initializer(Declared& out);
  [[nodiscard]] std::optional<Number> fold(const Expression& e) const;

  // The file: code_outline.cpp
  DeclarationHead head();
  void part();
  void code(const DeclarationHead& head);
  bool function(const DeclarationHead& head, Struct* of);
  const Type* result_type(std::size_t begin, std::size_t name);
  void old_parameters(Function& out);
  bool skip_words();
  void skip_statement();
  void add_defaults();

  // Expressions: code_expressions.cpp
  Expression expression(bool commas = false);
  Expression assignment();
  Expression binary(int least);
  Expression unary();
  Expression postfix();
  Expression primary();
  Expression literals();
  Expression parenthesis();
  Expression creation();
  Expression list(std::string_view close);
  Expression braces_or_assignment();
  Expression arguments(Expression callee);
  Expression named();
  void qualified(Expression& out);
  Expression size();
  [[nodiscard]] Expression around(ExpressionKind kind, std::string_view text, std::uint32_t offset,
                                  Expression part) const;
  [[nodiscard]] Expression joined(ExpressionKind kind, std::string_view text, Expression left, Expression right) const;
  const Type* type_name();
  [[nodiscard]] bool is_cast();

  // Statements: code_statements.cpp
  std::vector<Statement> statements();
  Statement statement();
  Statement controlled(const Token& keyword);
  Statement branch();
  Statement loop(const Token& keyword);
  bool for_each(Statement& out);
  Statement choice();
  Statement block();
  Statement plain();
  std::vector<Statement> scoped();
  void condition(Statement& out);
  Statement unreadable(std::size_t begin, const std::string& expected);

  const File& file_;
  Outline& outline_;
  std::size_t at_ = 0, end_;
  Token end_token_{};
  bool failed_ = false;
  Token failure_{};  // the first token that could not be read
  std::unordered_map<std::string_view, Symbol> symbols_;
  std::vector<std::vector<std::pair<std::string_view, std::optional<Symbol>>>> saved_;  // of the open scopes
  std::vector<std::string_view> classes_;                                               // around the current place
  int depth_ = 0, expression_depth_ = 0;
};

// Words of types, for the parser.

[[nodiscard]] inline bool is_one_of(const Token& token, std::initializer_list<std::string_view> words) {
  return token.is_name() && std::find(words.begin(), words.end(), token.text) != words.end();
}

// Words of a number's type, and those that stand for a whole type.
[[nodiscard]] inline bool is_number_word(const Token& token) {
  return is_one_of(token, {"unsigned", "signed", "short", "long", "int", "char", "float", "double", "bool", "_Bool",
                           "void", "auto", "var", "__signed__"});
}
[[nodiscard]] inline bool is_structure_word(const Token& token) {
  return is_one_of(token, {"struct", "class", "union", "enum", "interface"});
}
// Words before a declaration that are not its type.
[[nodiscard]] inline bool is_qualifier(const Token& token) {
  return is_one_of(
      token,
      {"const",     "static",       "extern",       "volatile", "register",      "inline",   "constexpr",  "final",
       "public",    "private",      "protected",    "mutable",  "readonly",      "virtual",  "explicit",   "friend",
       "__inline",  "typedef",      "typename",     "CONST",    "__restrict",    "restrict", "__inline__", "abstract",
       "transient", "synchronized", "thread_local", "__const",  "__extension__", "strictfp", "native"});
}

}  // namespace ninebit::code
