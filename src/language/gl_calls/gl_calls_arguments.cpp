#include "src/language/gl_calls/gl_calls_arguments.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "src/language/c_like/c_number.h"
#include "src/language/gl_calls/gl_calls_execute.h"
#include "src/language/gl_calls/gl_calls_names.h"

namespace ninebit::detail {
namespace {

using code::Token;
using code::TokenReader;

constexpr int kMostLooked = 16;  // tokens ahead

bool is_separator(const Token& token) {
  return token.is("::") || token.is("->") || token.is(".");
}

// Takes a name with the qualifiers before it; empty: there is none.
std::string_view take_qualified(TokenReader& tokens) {
  std::string_view name;
  for (int i = 0; i < kMostLooked; ++i) {
    name = tokens.peek().is_name() ? tokens.take().text : std::string_view();
    if (!is_separator(tokens.peek())) break;
    tokens.take();
  }
  return name;
}

}  // namespace

TokenReader GlLexer::behind_next() const {
  TokenReader ahead = *this;
  ahead.take();
  return ahead;
}

bool GlLexer::next_is_member() const {
  TokenReader ahead = behind_next();
  const Token separator = ahead.take();
  return is_separator(separator) && !separator.after_blank && ahead.peek().is_name() && !ahead.peek().after_blank;
}

bool GlLexer::next_is_call() const {
  TokenReader ahead = behind_next();
  if (peek().text.ends_with("_cast") && ahead.peek().is("<")) {
    for (int i = 0; i < kMostLooked && !ahead.peek().is(">"); ++i) ahead.take();
    ahead.take();
  }
  return ahead.peek().is("(");
}

bool GlLexer::next_is_assignment() const {
  return behind_next().peek().is("=");
}

bool GlLexer::begins_array_type() const {
  TokenReader ahead = behind_next();
  for (int i = 0; i < kMostLooked && ahead.peek().is_name(); ++i) ahead.take();
  return ahead.peek().is("[");
}

bool GlLexer::begins_pointer_call() const {
  TokenReader ahead = behind_next();
  return peek().is("(") && ahead.take().is("*") && ahead.peek().is_name();
}

bool GlLexer::wraps_call() const {
  TokenReader ahead = behind_next();
  return ahead.take().is("(") && find_gl_call(take_qualified(ahead)) != nullptr;
}

bool GlLexer::skip_cast() {
  if (!peek().is("(")) return false;
  TokenReader ahead = behind_next();
  std::string_view type;
  for (int i = 0; i < kMostLooked && ahead.peek().is_name(); ++i) type = take_qualified(ahead);
  // (GL_RGB) is not a type.
  if (type.empty() || value_of_name(type) || value_of_spelling(type, true)) return false;
  for (int i = 0; i < kMostLooked && ahead.peek().is("*"); ++i) ahead.take();
  if (!ahead.take().is(")")) return false;
  const Token& operand = ahead.peek();
  const bool follows = operand.is_name() || operand.kind == Token::Kind::number || operand.is("(") || operand.is("&");
  if (follows) TokenReader::operator=(ahead);
  return follows;
}

namespace {

constexpr std::size_t kReadValues = 4;     // the most that GL reads of an array
constexpr int kMostNestedParentheses = 8;  // around one argument

// Whether a name is an operation of the GeForce4 Ti, such as GL_DOT_PRODUCT_TEXTURE_1D_NV.
bool is_of_texture_shader3(std::string_view name) {
  constexpr std::array<std::string_view, 14> kOperations{"OFFSET_PROJECTIVE_TEXTURE_2D",
                                                         "OFFSET_PROJECTIVE_TEXTURE_2D_SCALE",
                                                         "OFFSET_PROJECTIVE_TEXTURE_RECTANGLE",
                                                         "OFFSET_PROJECTIVE_TEXTURE_RECTANGLE_SCALE",
                                                         "OFFSET_HILO_TEXTURE_2D",
                                                         "OFFSET_HILO_TEXTURE_RECTANGLE",
                                                         "OFFSET_HILO_PROJECTIVE_TEXTURE_2D",
                                                         "OFFSET_HILO_PROJECTIVE_TEXTURE_RECTANGLE",
                                                         "DEPENDENT_HILO_TEXTURE_2D",
                                                         "DEPENDENT_RGB_TEXTURE_3D",
                                                         "DEPENDENT_RGB_TEXTURE_CUBE_MAP",
                                                         "DOT_PRODUCT_PASS_THROUGH",
                                                         "DOT_PRODUCT_TEXTURE_1D",
                                                         "DOT_PRODUCT_AFFINE_DEPTH_REPLACE"};
  if (!name.starts_with("GL_") || !name.ends_with("_NV")) return false;
  name = name.substr(3, name.size() - 6);
  return std::find(kOperations.begin(), kOperations.end(), name) != kOperations.end();
}

}  // namespace

bool GlArgumentReader::expected(const std::string& what) {
  const Token& token = lexer_.peek();
  if (!lexer_.at_end()) {
    faults_.add(token.offset, "expected " + what + ", found " + quoted(token.text));
  } else if (!lexer_.unterminated()) {
    faults_.add(token.offset, "expected " + what + ", but the text ends");
  }
  return false;
}

bool GlArgumentReader::expect(std::string_view mark) {
  return lexer_.takes(mark) || expected(quoted(mark));
}

bool GlArgumentReader::declare(std::string_view name, GlArgument array) {
  return arrays_.emplace(name, std::move(array)).second;
}

void GlArgumentReader::place(GlArgument& out, std::size_t offset) const {
  out.offset = offset;
  out.text = source_.text.substr(offset, lexer_.end_of_last() - offset);
}

bool GlArgumentReader::qualifier() {
  bool found = false;
  lexer_.takes("::");
  while (lexer_.peek().is_name() && lexer_.next_is_member()) {
    lexer_.take();
    lexer_.take();
    found = true;
  }
  return found;
}

bool GlArgumentReader::bounds(std::optional<std::size_t>& size) {
  if (!expect("[")) return false;
  if (lexer_.peek().kind == Token::Kind::number) {
    GlArgument number;
    const Token token = lexer_.take();
    if (!read_gl_number(token.text, number) || !number.is_integer || number.integer < 1 ||
        number.integer > std::int64_t{kMostGlValues}) {
      faults_.add(token.offset, "an array has 1 to 1024 elements, not " + quoted(token.text));
      return false;
    }
    size = static_cast<std::size_t>(number.integer);
  }
  return expect("]");
}

bool GlArgumentReader::braces(GlArgument& array, std::optional<std::size_t> size) {
  array.is_array = true;
  const std::string_view close = lexer_.takes("[") ? "]" : "}";
  if (close == "}" && !expect("{")) return false;
  while (!lexer_.peek().is(close)) {
    if (array.count > 0 && !expect(",")) return false;
    if (lexer_.peek().is(close)) break;  // after a trailing comma
    const std::size_t offset = lexer_.peek().offset;
    GlArgument value;
    if (const Read read = scalar(value); read != Read::done) return false;
    if (array.count == size.value_or(kMostGlValues)) {
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

// "(GLenum)", "(const GLfloat*)": the value behind them is what matters.
void GlArgumentReader::skip_casts() {
  while (lexer_.skip_cast()) {
  }
}

GlArgumentReader::Read GlArgumentReader::argument(GlArgument& out) {
  if (lexer_.peek().is_name() && lexer_.next_is_assignment()) {  // "pname = " of a dump
    lexer_.take();
    lexer_.take();
  }
  const std::size_t offset = lexer_.peek().offset;
  Read read = Read::done;
  skip_casts();
  if (lexer_.peek().is("{") || lexer_.peek().is("[")) {
    read = braces(out, std::nullopt) ? Read::done : Read::broken;
  } else if (lexer_.peek().is("(") && lexer_.begins_array_type()) {
    read = compound_literal(out) ? Read::done : Read::broken;
  } else if (lexer_.peek().is("new")) {
    read = new_array(out);
  } else if (lexer_.peek().is("&")) {
    read = address(out);
  } else if (const auto array = arrays_.find(lexer_.peek().text); array != arrays_.end()) {
    lexer_.take();
    out = array->second;
  } else if (is_conversion(lexer_.peek().text) && lexer_.next_is_call()) {
    read = converted(out);
  } else {
    return scalar(out);
  }
  place(out, offset);
  return read;
}

// "new float[4] {…}".
GlArgumentReader::Read GlArgumentReader::new_array(GlArgument& out) {
  lexer_.take();
  const auto element = element_type(lexer_.peek().text);
  if (!element) return broken("GLfloat or GLint");
  lexer_.take();
  out.element = *element;
  std::optional<std::size_t> size;
  return bounds(size) && braces(out, size) ? Read::done : Read::broken;
}

// "(GLfloat[4]){…}".
bool GlArgumentReader::compound_literal(GlArgument& out) {
  lexer_.take();
  while (lexer_.peek().is("const")) lexer_.take();
  const auto element = element_type(lexer_.peek().text);
  if (!element) return expected("GLfloat or GLint");
  lexer_.take();
  out.element = *element;
  std::optional<std::size_t> size;
  return bounds(size) && expect(")") && braces(out, size);
}

// "&name[0]" or "&name", which are the array itself.
GlArgumentReader::Read GlArgumentReader::address(GlArgument& out) {
  lexer_.take();
  const auto array = arrays_.find(lexer_.peek().text);
  if (array == arrays_.end()) return broken("an array declared above");
  lexer_.take();
  out = array->second;
  if (!lexer_.takes("[")) return Read::done;
  if (lexer_.peek().text != "0") return broken("0");
  lexer_.take();
  return expect("]") ? Read::done : Read::broken;
}

// "GLenum(…)", "static_cast<GLenum>(…)", "FloatBuffer.wrap(…)": what stands between the parentheses.
GlArgumentReader::Read GlArgumentReader::converted(GlArgument& out) {
  if (depth_ >= kMostNestedParentheses) return broken("an enumerant or a number");
  lexer_.take();
  while (!lexer_.at_end() && !lexer_.peek().is("(")) lexer_.take();
  if (!expect("(")) return Read::broken;
  ++depth_;
  const Read read = argument(out);
  --depth_;
  if (read == Read::broken) return read;
  return expect(")") ? read : Read::broken;
}

// A number or an enumerant, or a sum of them such as GL_COMBINER0_NV + 1.
GlArgumentReader::Read GlArgumentReader::scalar(GlArgument& out) {
  const std::size_t offset = lexer_.peek().offset;
  Read read = Read::done;
  bool first = true;
  while (first || lexer_.peek().is("+") || lexer_.peek().is("-")) {
    const bool negative = lexer_.takes("-");
    if (!negative) lexer_.takes("+");
    GlArgument term;
    const Read one = this->term(term);
    if (one == Read::broken) return one;
    if (one == Read::unknown) read = one;
    if (first && term.is_array) {  // Buffer.wrap(new float[] {…})
      out = std::move(term);
      break;
    }
    out.is_integer = out.is_integer && term.is_integer;
    out.integer += negative ? -term.integer : term.integer;
    out.real += negative ? -term.real : term.real;
    first = false;
  }
  place(out, offset);
  return read;
}

GlArgumentReader::Read GlArgumentReader::term(GlArgument& out) {
  skip_casts();
  const Token token = lexer_.peek();
  if (token.kind == Token::Kind::number) {
    lexer_.take();
    if (read_gl_number(token.text, out)) return Read::done;
    faults_.add(token.offset, quoted(token.text) + " is not a C number, or is out of range");
    return Read::unknown;
  }
  if (depth_ < kMostNestedParentheses && lexer_.takes("(")) {
    ++depth_;
    const Read read = scalar(out);
    --depth_;
    if (read == Read::broken) return read;
    return expect(")") ? read : Read::broken;
  }
  if (token.is_name() && is_conversion(token.text) && lexer_.next_is_call()) return converted(out);
  return token.is_name() || token.is("::") ? enumerant(out) : broken("an enumerant or a number");
}

GlArgumentReader::Read GlArgumentReader::enumerant(GlArgument& out) {
  const bool qualified = qualifier();
  if (is_conversion(lexer_.peek().text) && lexer_.next_is_call()) return converted(out);
  const Token name = lexer_.take();
  auto value = value_of_name(name.text);
  if (!value && reads_stage_names_) value = stage_value_of_name(name.text);
  if (!value) value = value_of_spelling(name.text, qualified);
  if (!value) {
    faults_.add(name.offset, is_of_texture_shader3(name.text)
                                 ? quoted(name.text) +
                                       " is an operation of NV_texture_shader3, which the GeForce3 "
                                       "does not have"
                                 : quoted(name.text) +
                                       " is neither an enumerant of the register combiners nor a declared array" +
                                       meant_enumerant(name.text));
    return Read::unknown;
  }
  out.integer = *value;
  out.real = static_cast<double>(*value);
  return Read::done;
}

bool read_gl_number(std::string_view text, GlArgument& out) {
  const bool is_long_double = text.find('.') != std::string_view::npos && (text.ends_with('l') || text.ends_with('L'));
  if (is_long_double) text.remove_suffix(1);
  const auto number = code::read_number(text);
  if (!number) return false;
  out.is_integer = !number->may_be_real();
  out.integer = number->integer;
  out.real = number->value();
  return !out.is_integer || (out.integer >= 0 && out.integer <= std::int64_t{std::numeric_limits<gl::GLenum>::max()});
}

}  // namespace ninebit::detail
