// Programs in string literals.
#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/source/string_literals.h"
#include "src/language/source_code/code_units.h"

namespace ninebit::code {
namespace {

// Whether a string literal holds a program.
bool holds_program(std::string_view literal) {
  return literal.find("!!RC1.0") != std::string_view::npos ||
         detail::find_shader_literal(literal) != std::string_view::npos;
}

// Whether the bytes of a text, which holds a program, do not look like all of it: "!!RC1.0" alone is compared with.
bool is_header_alone(std::string_view literal) {
  return literal.find("!!RC1.0") != std::string_view::npos && literal.find('=') == std::string_view::npos;
}

}  // namespace

void Units::find_texts() {
  constexpr std::size_t kMostTexts = 1000;
  const std::vector<Token>& tokens = program_.file.tokens;
  std::size_t texts = 0;
  for (std::size_t i = 0; i < tokens.size() && texts < kMostTexts; ++i) {
    if (tokens[i].kind != Token::Kind::text || !holds_program(tokens[i].text)) continue;
    const std::size_t end = end_of_literals(program_.source.text, tokens[i].offset);
    std::string name = name_of_text(i);
    if (name.empty()) name = "string";
    const std::size_t first = i, begin = tokens[i].offset;
    while (i + 1 < tokens.size() && tokens[i + 1].offset < end) ++i;
    units_.push_back({.kind = Unit::Kind::text,
                      .name = name,
                      .own_name = name,
                      .offset = tokens[first].offset,
                      .end = static_cast<std::uint32_t>(end),
                      .is_part = is_joined(first) || is_joined(i + 2) ||
                                 is_header_alone(program_.source.text.substr(begin, end - begin))});
    ++texts;
  }
}

// Whether a text that begins at this token, or ends before the one before it, is one of the parts of a longer text.
bool Units::is_joined(std::size_t token) const {
  if (token == 0 || token >= program_.file.tokens.size()) return false;
  const Token& before = program_.file.tokens[token - 1];
  return before.is("+") || before.is("<<") || before.is("%") || before.is("+=");
}

// The variable that a text is the value of; empty: it has none.
std::string Units::name_of_text(std::size_t token) const {
  const std::vector<Token>& tokens = program_.file.tokens;
  const auto is = [&](std::size_t i, std::string_view text) { return tokens[i].is(text); };
  std::size_t i = token;
  while (i > 0 && (tokens[i - 1].kind == Token::Kind::text || is(i - 1, "{") || is(i - 1, "(") || is(i - 1, "+"))) --i;
  if (i == 0 || !is(i - 1, "=")) return "";
  --i;
  while (i > 0 && (is(i - 1, "]") || is(i - 1, "[") || tokens[i - 1].kind == Token::Kind::number)) --i;
  return i > 0 && tokens[i - 1].is_name() ? std::string(tokens[i - 1].text) : "";
}

}  // namespace ninebit::code
