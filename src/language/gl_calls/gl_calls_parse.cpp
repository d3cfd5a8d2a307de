#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/language/gl_calls.h"
#include "src/language/gl_calls/gl_calls_execute.h"
#include "src/language/gl_calls/gl_calls_lexer.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/gl_calls/gl_calls_spelling.h"
#include "src/language/source/foreign_language.h"

namespace ninebit {
namespace {

using detail::element_type;
using detail::GlArgument;
using detail::GlElement;
using detail::GlLexer;
using detail::GlSignature;
using detail::GlToken;
using detail::quoted;
using detail::read_gl_number;

constexpr std::size_t kMostValues = 1024;
constexpr std::size_t kReadValues = 4;  // the most that GL reads of an array

// Reads statements and executes each as soon as it is read. A faulty statement is skipped up to its semicolon or the
// next name of a call.
class Parser {
 public:
  Parser(const SourceText& source, const HardwareProfile& profile)
      : source_(source), faults_(source), lexer_(source.text, faults_), context_(profile) {}

  Parsed<CombinerState> parse() {
    while (lexer_.peek().kind != GlToken::Kind::end && !faults_.full()) {
      if (!statement()) recover();
    }
    if (faults_.empty()) return {context_.state(), {}};
    return {std::nullopt, faults_.take()};
  }

 private:
  // Returns false if the rest of the statement must be skipped.
  bool statement() {
    const GlToken& token = lexer_.peek();
    if (token.is(';')) {
      lexer_.take();
      return true;
    }
    if (token.text.starts_with('#')) {
      faults_.add(token.offset, "preprocessor lines are not supported; expected a GL call");
      lexer_.skip_line();
      return true;
    }
    if (token.kind != GlToken::Kind::name) return expected("a GL call");
    const bool qualified = qualifier();
    if (const GlSignature* const call = detail::find_gl_call(token.text)) return call_statement(*call);
    if (qualified) return unknown_call(lexer_.take());
    if (token.is("static") || token.is("const") || element_type(token.text)) return declaration();
    return unknown_call(lexer_.take());
  }

  bool unknown_call(const GlToken& name) {
    const std::string meant = detail::meant_call(name.text);
    faults_.add(name.offset, (lexer_.peek().is('(') ? quoted(name.text) + " is not a call of the register combiners"
                                                    : "expected a GL call, found " + quoted(name.text)) +
                                 meant);
    return false;
  }

  // Skips gl., ext->, vtkgl:: and the like before a name; whether there was one.
  bool qualifier() {
    bool found = false;
    while (lexer_.peek().kind == GlToken::Kind::name && lexer_.next_is_member()) {
      lexer_.take();
      lexer_.take();
      found = true;
    }
    return found;
  }

  bool call_statement(const GlSignature& call) {
    const std::size_t offset = lexer_.take().offset;
    std::vector<GlArgument> arguments;
    bool good = true;
    if (!expect('(')) return false;
    while (!lexer_.peek().is(')')) {
      if (!arguments.empty() && !expect(',')) return false;
      GlArgument argument;
      const Read read = this->argument(argument);
      if (read == Read::broken) return false;
      good = good && read == Read::done;
      // The longest call has ten arguments; the limit only bounds the memory.
      if (arguments.size() < kMostValues) arguments.push_back(std::move(argument));
    }
    lexer_.take();
    if (good) detail::execute_gl_call(call, arguments, offset, context_, faults_);
    return end_of_statement();
  }

  // [static] [const] TYPE [const] NAME [ [N] ] = { … } {, NAME …};
  bool declaration() {
    while (lexer_.peek().is("static") || lexer_.peek().is("const")) lexer_.take();
    const auto element = element_type(lexer_.peek().text);
    if (!element) return expected("GLfloat or GLint");
    lexer_.take();
    while (lexer_.peek().is("const")) lexer_.take();
    while (true) {
      if (lexer_.peek().kind != GlToken::Kind::name) return expected("the name of an array");
      const GlToken name = lexer_.take();
      GlArgument array;
      array.element = *element;
      std::optional<std::size_t> size;
      if (!bounds(size) || !expect('=') || !braces(array, size)) return false;
      if (!arrays_.emplace(name.text, std::move(array)).second) {
        faults_.add(name.offset, quoted(name.text) + " is already declared");
      }
      if (!lexer_.peek().is(',')) return end_of_statement();
      lexer_.take();
    }
  }

  // "[4]" or "[]".
  bool bounds(std::optional<std::size_t>& size) {
    if (!expect('[')) return false;
    if (lexer_.peek().kind == GlToken::Kind::number) {
      GlArgument number;
      const GlToken token = lexer_.take();
      if (!read_gl_number(token.text, number) || !number.is_integer || number.integer < 1 ||
          number.integer > std::int64_t{kMostValues}) {
        faults_.add(token.offset, "an array has 1 to 1024 elements, not " + quoted(token.text));
        return false;
      }
      size = static_cast<std::size_t>(number.integer);
    }
    return expect(']');
  }

  // "{1, 0.5f, …}". An array with bounds is padded with zeros.
  bool braces(GlArgument& array, std::optional<std::size_t> size) {
    array.is_array = true;
    if (!expect('{')) return false;
    while (!lexer_.peek().is('}')) {
      if (array.count > 0 && !expect(',')) return false;
      if (lexer_.peek().is('}')) break;  // after a trailing comma
      const std::size_t offset = lexer_.peek().offset;
      GlArgument value;
      if (const Read read = scalar(value); read != Read::done) return false;
      if (array.count == size.value_or(kMostValues)) {
        faults_.add(offset, "too many values; the array has " + std::to_string(array.count) + " elements");
        return false;
      }
      if (array.element == GlElement::integer && !value.is_integer) {
        faults_.add(offset, quoted(value.text) + " is not an integer");
        return false;
      }
      if (++array.count <= kReadValues) array.values.push_back(std::move(value));
    }
    lexer_.take();
    array.count = size.value_or(array.count);
    if (size) array.values.resize(std::min(*size, kReadValues));
    return true;
  }

  enum class Read {
    done,
    unknown,  // a fault was reported; parsing can continue
    broken    // a fault was reported; the rest of the statement must be skipped
  };

  Read argument(GlArgument& out) {
    const std::size_t offset = lexer_.peek().offset;
    Read read = Read::done;
    if (lexer_.peek().is('{')) {
      read = braces(out, std::nullopt) ? Read::done : Read::broken;
    } else if (lexer_.peek().is('(')) {
      read = compound_literal(out) ? Read::done : Read::broken;
    } else if (lexer_.peek().is('&')) {
      read = address(out);
    } else if (const auto array = arrays_.find(lexer_.peek().text); array != arrays_.end()) {
      lexer_.take();
      out = array->second;
    } else {
      return scalar(out);
    }
    place(out, offset);
    return read;
  }

  // "(GLfloat[4]){…}".
  bool compound_literal(GlArgument& out) {
    lexer_.take();
    while (lexer_.peek().is("const")) lexer_.take();
    const auto element = element_type(lexer_.peek().text);
    if (!element) return expected("GLfloat or GLint");
    lexer_.take();
    out.element = *element;
    std::optional<std::size_t> size;
    return bounds(size) && expect(')') && braces(out, size);
  }

  // "&name[0]", which is the array itself.
  Read address(GlArgument& out) {
    lexer_.take();
    const auto array = arrays_.find(lexer_.peek().text);
    if (array == arrays_.end()) return expected("an array declared above") ? Read::done : Read::broken;
    lexer_.take();
    out = array->second;
    if (!expect('[')) return Read::broken;
    if (lexer_.peek().text != "0") return expected("0") ? Read::done : Read::broken;
    lexer_.take();
    return expect(']') ? Read::done : Read::broken;
  }

  // A number or an enumerant, or a sum of them such as GL_COMBINER0_NV + 1.
  Read scalar(GlArgument& out) {
    const std::size_t offset = lexer_.peek().offset;
    Read read = Read::done;
    bool first = true;
    while (first || lexer_.peek().is('+') || lexer_.peek().is('-')) {
      const bool negative = lexer_.peek().is('-');
      if (negative || lexer_.peek().is('+')) lexer_.take();
      GlArgument term;
      const Read one = this->term(term);
      if (one == Read::broken) return one;
      if (one == Read::unknown) read = one;
      out.is_integer = out.is_integer && term.is_integer;
      out.integer += negative ? -term.integer : term.integer;
      out.real += negative ? -term.real : term.real;
      first = false;
    }
    place(out, offset);
    return read;
  }

  Read term(GlArgument& out) {
    const GlToken& token = lexer_.peek();
    if (token.kind == GlToken::Kind::number) {
      const GlToken number = lexer_.take();
      if (read_gl_number(number.text, out)) return Read::done;
      faults_.add(number.offset, quoted(number.text) + " is not a C number, or is out of range");
      return Read::unknown;
    }
    if (token.kind != GlToken::Kind::name) return expected("an enumerant or a number") ? Read::done : Read::broken;
    const bool qualified = qualifier();
    const GlToken name = lexer_.take();
    auto value = detail::value_of_name(name.text);
    if (!value) value = detail::value_of_spelling(name.text, qualified);
    if (!value) {
      faults_.add(name.offset, quoted(name.text) +
                                   " is neither an enumerant of the register combiners nor a declared array" +
                                   detail::meant_enumerant(name.text));
      return Read::unknown;
    }
    out.integer = *value;
    out.real = static_cast<double>(*value);
    return Read::done;
  }

  void place(GlArgument& out, std::size_t offset) const {
    out.offset = offset;
    out.text = source_.text.substr(offset, lexer_.end_of_last() - offset);
  }

  bool expect(char c) {
    if (!lexer_.peek().is(c)) return expected(quoted({&c, 1}));
    lexer_.take();
    return true;
  }

  // If only the semicolon is missing, nothing is skipped.
  bool end_of_statement() {
    if (!expect(';')) return detail::find_gl_call(lexer_.peek().text) != nullptr;
    return true;
  }

  bool expected(const std::string& what) {
    const GlToken& token = lexer_.peek();
    if (token.kind != GlToken::Kind::end) {
      faults_.add(token.offset, "expected " + what + ", found " + quoted(token.text));
    } else if (!lexer_.cut_short()) {
      faults_.add(token.offset, "expected " + what + ", but the text ends");
    }
    return false;
  }

  void recover() {
    while (lexer_.peek().kind != GlToken::Kind::end) {
      if (lexer_.peek().kind == GlToken::Kind::name && detail::find_gl_call(lexer_.peek().text) != nullptr) return;
      if (lexer_.take().is(';')) return;
    }
  }

  SourceText source_;
  detail::SourceFaults faults_;
  GlLexer lexer_;
  gl::Context context_;
  std::map<std::string_view, GlArgument> arrays_;
};

}  // namespace

Parsed<CombinerState> parse_gl_calls(const SourceText& source, const HardwareProfile& profile) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return {std::nullopt, faults.take()};
  Parsed<CombinerState> parsed = Parser(source, profile).parse();
  if (parsed) return parsed;
  const std::string_view language = foreign_language(source.text);
  if (language.empty()) return parsed;
  faults.add(0, cannot_run(language));
  return {std::nullopt, faults.take()};
}

}  // namespace ninebit
