#include "src/language/gl_calls/gl_calls_lexer.h"

#include <algorithm>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source/source_faults.h"
#include "src/system/lines.h"

namespace ninebit::detail {
namespace {

constexpr int kMostLooked = 16;  // tokens ahead

bool is_separator(const code::Token& token) {
  return token.is("::") || token.is("->") || token.is(".");
}

// Takes a name with the qualifiers before it; empty: there is none.
std::string_view take_qualified(code::TokenReader& tokens) {
  std::string_view name;
  for (int i = 0; i < kMostLooked; ++i) {
    name = tokens.peek().is_name() ? tokens.take().text : std::string_view();
    if (!is_separator(tokens.peek())) break;
    tokens.take();
  }
  return name;
}

}  // namespace

code::TokenReader GlLexer::behind_next() const {
  code::TokenReader ahead = *this;
  ahead.take();
  return ahead;
}

bool GlLexer::next_is_member() const {
  code::TokenReader ahead = behind_next();
  const code::Token separator = ahead.take();
  return is_separator(separator) && !separator.after_blank && ahead.peek().is_name() && !ahead.peek().after_blank;
}

bool GlLexer::next_is_call() const {
  code::TokenReader ahead = behind_next();
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
  code::TokenReader ahead = behind_next();
  for (int i = 0; i < kMostLooked && ahead.peek().is_name(); ++i) ahead.take();
  return ahead.peek().is("[");
}

bool GlLexer::begins_pointer_call() const {
  code::TokenReader ahead = behind_next();
  return peek().is("(") && ahead.take().is("*") && ahead.peek().is_name();
}

bool GlLexer::wraps_call() const {
  code::TokenReader ahead = behind_next();
  return ahead.take().is("(") && find_gl_call(take_qualified(ahead)) != nullptr;
}

bool GlLexer::skip_cast() {
  if (!peek().is("(")) return false;
  code::TokenReader ahead = behind_next();
  std::string_view type;
  for (int i = 0; i < kMostLooked && ahead.peek().is_name(); ++i) type = take_qualified(ahead);
  // (GL_RGB) is not a type.
  if (type.empty() || value_of_name(type) || value_of_spelling(type, true)) return false;
  for (int i = 0; i < kMostLooked && ahead.peek().is("*"); ++i) ahead.take();
  if (!ahead.take().is(")")) return false;
  const code::Token& operand = ahead.peek();
  const bool follows = operand.is_name() || operand.kind == code::Token::Kind::number || operand.is("(") ||
                       operand.is("&") || operand.is("$") || operand.is("@");
  if (follows) code::TokenReader::operator=(ahead);
  return follows;
}

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

// The first byte from `at` on that is not one of these.
template <class Is>
std::size_t behind(std::string_view text, std::size_t at, const Is& is) {
  while (at < text.size() && is(text[at])) ++at;
  return at;
}

bool begins_line(std::string_view text, std::size_t at) {
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
    at -= kByteOrderMark.size();
  }
  while (at > 0 && is_space(text[at - 1])) --at;
  return at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
}

// The end of a line. Text in quotes, such as that of a shader, may go on in the next lines.
std::size_t end_of_line(std::string_view text, std::size_t at) {
  for (bool quoted = false; at < text.size() && (quoted || text[at] != '\n'); ++at) {
    if (quoted && text[at] == '\\') {
      ++at;
    } else if (text[at] == '"') {
      quoted = !quoted;
    }
  }
  return std::min(at, text.size());
}

// Whether the arguments of glEnable or glDisable name a capability of the combiners.
bool names_capability(std::string_view arguments) {
  const auto has = [&](std::string_view part) { return arguments.find(part) != std::string_view::npos; };
  return has("REGISTER_COMBINERS") || has("PER_STAGE_CONSTANTS") || has("0x8522") || has("0x8535");
}

}  // namespace

std::optional<GlDumpLine> gl_dump_line(std::string_view text, std::size_t number) {
  if (!begins_line(text, number)) return std::nullopt;
  std::size_t at = behind(text, number, is_digit);
  const bool has_colon = at < text.size() && text[at] == ':';
  if (has_colon) ++at;
  const std::size_t blank = at;
  at = behind(text, at, is_space);
  if (at < text.size() && text[at] == '@') at = behind(text, behind(text, at + 1, is_digit), is_space);  // a thread
  if (at == blank && !has_colon) return std::nullopt;
  GlDumpLine line{.call = at};
  const std::size_t name_end = behind(text, at, is_word);
  line.name = text.substr(at, name_end - at);
  const std::size_t open = behind(text, name_end, is_space);
  if (line.name.empty() || is_digit(line.name.front()) || text.substr(open, 1) != "(") return std::nullopt;
  line.end = end_of_line(text, open);
  const GlSignature* const call = find_gl_call(line.name);
  const bool switches = call != nullptr && call->parameters == "e";
  line.sets_combiners = call != nullptr && (!switches || names_capability(text.substr(open, line.end - open)));
  return line;
}

}  // namespace ninebit::detail
