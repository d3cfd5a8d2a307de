// Pascal's sections of constants, variables and types.
#include <algorithm>
#include <array>
#include <utility>

#include "src/language/source_code/code_tree_build.h"
#include "src/language/source_code/pascal_parser.h"

namespace ninebit::code {

bool PascalParser::at_section() const {
  constexpr std::array<std::string_view, 17> kWords{
      "const",        "var",        "type",           "label",     "procedure",      "function",
      "constructor",  "destructor", "begin",          "interface", "implementation", "initialization",
      "finalization", "threadvar",  "resourcestring", "uses",      "class"};
  return in_.at_end() || (in_.peek().is_name() &&
                          std::any_of(kWords.begin(), kWords.end(), [&](std::string_view word) { return is(word); }));
}

void PascalParser::declare(Statement& out, const std::vector<Token>& names, const ArrayType& type, bool is_constant) {
  Expression value;
  const bool has_value = takes("=");
  if (has_value) value = type.is_array && is("(") ? parenthesized(true) : expression();
  for (const Token& name : names) {
    Declared one;
    one.name = name.text;
    one.offset = name.offset;
    one.type = type.element;
    one.is_constant = is_constant;
    one.is_array = type.is_array;
    one.bounds = type.size;
    one.low = type.low;
    if (has_value && !failed(value)) one.value.push_back(value);
    out.declared.push_back(std::move(one));
  }
  skip_to_semicolon();
  takes(";");
}

void PascalParser::constants(Statement& out) {
  while (!at_section() && in_.peek().is_name()) {
    const std::vector<Token> names{in_.take()};
    ArrayType type;
    if (takes(":")) type = this->type();
    declare(out, names, type, true);
  }
}

void PascalParser::variables(Statement& out) {
  while (!at_section() && in_.peek().is_name()) {
    std::vector<Token> names{in_.take()};
    while (takes(",") && in_.peek().is_name()) names.push_back(in_.take());
    ArrayType type;
    if (takes(":")) type = this->type();
    declare(out, names, type, false);
  }
}

void PascalParser::types(Statement& out) {
  while (!at_section() && in_.peek().is_name()) {
    const Token name = in_.take();
    if (takes("=")) {
      if (is("(")) {  // an enumeration
        in_.take();
        for (std::int64_t i = 0; in_.peek().is_name(); ++i) {
          const Token one = in_.take();
          Declared declared;
          declared.name = one.text;
          declared.offset = one.offset;
          declared.is_constant = true;
          Expression before = made(Expression::Kind::number, "0", one.offset, one.end);
          if (i > 0) {
            before = joined(Expression::Kind::binary, "+",
                            made(Expression::Kind::name, out.declared.back().name, one.offset, one.end),
                            made(Expression::Kind::number, "1", one.offset, one.end));
          }
          declared.value.push_back(std::move(before));
          out.declared.push_back(std::move(declared));
          if (!takes(",")) break;
        }
      } else {
        types_[pascal_word(name.text)] = type();
      }
    }
    skip_to_semicolon();
    takes(";");
  }
}

// low..high
void PascalParser::dimension(ArrayType& out) {
  Expression low = expression();
  Expression size;
  if (!failed(low) && takes("..")) {
    Expression high = expression();
    const std::uint32_t offset = low.offset, end = high.end;
    if (!failed(high)) {
      size = joined(Expression::Kind::binary, "-", std::move(high), low);
      size = joined(Expression::Kind::binary, "+", std::move(size), made(Expression::Kind::number, "1", offset, end));
    }
  }
  out.low.push_back(std::move(low));
  out.size.push_back(std::move(size));
}

ArrayType PascalParser::type() {
  ArrayType out;
  if (takes("packed")) return type();
  if (takes("array")) {
    out.is_array = true;
    if (takes("[")) {
      do dimension(out);
      while (takes(","));
      takes("]");
    } else {
      out.size.emplace_back();
      out.low.push_back(made(Expression::Kind::number, "0", in_.peek().offset, in_.peek().end));
    }
    takes("of");
    if (++depth_ > kMostNestedStatements) return out;
    const ArrayType inner = type();
    --depth_;
    out.low.insert(out.low.end(), inner.low.begin(), inner.low.end());
    out.size.insert(out.size.end(), inner.size.begin(), inner.size.end());
    out.element = inner.element;
    return out;
  }
  if (is("record") || is("class") || is("object") || is("interface") || is("dispinterface")) {
    skip_type();
    return out;
  }
  if (in_.peek().is_name()) {
    const Token name = in_.take();
    if (const auto known = types_.find(pascal_word(name.text)); known != types_.end()) return known->second;
    out.element = name.text;
  }
  return out;
}

void PascalParser::skip_type() {
  in_.take();
  if (is(";") || is("of")) return;  // declared only
  std::size_t depth = 1;
  while (!in_.at_end() && depth > 0) {
    if (is("record") || is("object")) ++depth;
    if (is("end")) --depth;
    in_.take();
  }
}

}  // namespace ninebit::code
