#include "src/language/gl_calls/gl_calls_lexer.h"

#include <algorithm>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {
namespace {

constexpr std::string_view kPunctuation = "(){}[],;=+-&*.:@";
constexpr std::size_t kLongestLook = 128;  // bytes ahead

// The first byte from `at` on that is not a blank.
std::size_t behind_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && is_blank(text[at])) ++at;
  return at;
}

// The word that begins at a byte, with the qualifiers before it; empty: none does. `at` goes behind it.
std::string_view qualified_word(std::string_view text, std::size_t& at) {
  std::string_view word;
  while (at < text.size()) {
    const std::size_t begin = at;
    while (at < text.size() && is_word(text[at])) ++at;
    word = text.substr(begin, at - begin);
    const bool scope = text.substr(at, 2) == "::" || text.substr(at, 2) == "->";
    if (!scope && text.substr(at, 1) != ".") break;
    at += scope ? 2 : 1;
  }
  return word;
}

}  // namespace

GlLexer::GlLexer(std::string_view text, SourceFaults& faults) : text_(text), faults_(faults) {
  if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  advance();
}

GlToken GlLexer::take() {
  const GlToken taken = token_;
  end_of_last_ = at_;
  advance();
  return taken;
}

bool GlLexer::next_is_member() const {
  std::string_view rest = text_.substr(at_);
  for (const std::string_view separator : {"::", "->", "."}) {
    if (rest.starts_with(separator)) {
      rest.remove_prefix(separator.size());
      return !rest.empty() && is_word(rest.front()) && !is_digit(rest.front());
    }
  }
  return false;
}

bool GlLexer::next_is_call() const {
  const std::string_view text = text_.substr(0, std::min(text_.size(), at_ + kLongestLook));
  std::size_t at = behind_blanks(text, at_);
  if (token_.text.ends_with("_cast") && text.substr(at, 1) == "<") {
    at = text.find('>', at);
    if (at == std::string_view::npos) return false;
    at = behind_blanks(text, at + 1);
  }
  return text.substr(at, 1) == "(";
}

bool GlLexer::next_is_assignment() const {
  const std::string_view text = text_.substr(0, std::min(text_.size(), at_ + kLongestLook));
  const std::size_t at = behind_blanks(text, at_);
  return text.substr(at, 1) == "=" && text.substr(at, 2) != "==";
}

bool GlLexer::begins_array_type() const {
  const std::string_view text = text_.substr(0, std::min(text_.size(), at_ + kLongestLook));
  std::size_t at = behind_blanks(text, at_);
  while (at < text.size() && (is_word(text[at]) || is_blank(text[at]))) ++at;
  return text.substr(at, 1) == "[";
}

bool GlLexer::begins_pointer_call() const {
  std::size_t at = behind_blanks(text_, at_);
  if (!token_.is('(') || text_.substr(at, 1) != "*") return false;
  at = behind_blanks(text_, at + 1);
  return at < text_.size() && is_word(text_[at]) && !is_digit(text_[at]);
}

bool GlLexer::wraps_call() const {
  const std::string_view text = text_.substr(0, std::min(text_.size(), at_ + kLongestLook));
  std::size_t at = behind_blanks(text, at_);
  if (text.substr(at, 1) != "(") return false;
  at = behind_blanks(text, at + 1);
  return find_gl_call(qualified_word(text, at)) != nullptr;
}

std::size_t GlLexer::cast_end() const {
  if (!token_.is('(')) return 0;
  const std::string_view text = text_.substr(0, std::min(text_.size(), at_ + kLongestLook));
  std::size_t at = behind_blanks(text, at_);
  std::string_view type;
  while (at < text.size() && is_word(text[at]) && !is_digit(text[at])) {
    type = qualified_word(text, at);
    at = behind_blanks(text, at);
  }
  // (GL_RGB) is not a type.
  if (type.empty() || value_of_name(type) || value_of_spelling(type, true)) return 0;
  while (at < text.size() && (text[at] == '*' || is_blank(text[at]))) ++at;
  if (text.substr(at, 1) != ")") return 0;
  const std::size_t end = at + 1;
  const std::size_t operand = behind_blanks(text, end);
  const bool follows = operand < text.size() && (is_word(text[operand]) || text[operand] == '(' ||
                                                 text[operand] == '&' || text[operand] == '$' || text[operand] == '@');
  return follows ? end : 0;
}

void GlLexer::move_to(std::size_t at) {
  end_of_last_ = at;
  at_ = at;
  advance();
}

void GlLexer::skip_line() {
  at_ = std::min(text_.find('\n', token_.offset), text_.size());
  advance();
}

// The end of a C preprocessing number: digits, letters and dots, and a sign after a decimal exponent's e.
std::size_t GlLexer::number_end() const {
  const bool hex = text_.substr(at_, 2) == "0x" || text_.substr(at_, 2) == "0X";
  std::size_t end = at_ + 1;
  while (end < text_.size()) {
    const char c = text_[end];
    const char before = text_[end - 1];
    const bool exponent_sign = (c == '+' || c == '-') && (before == 'e' || before == 'E') && !hex;
    if (!is_word(c) && c != '.' && !exponent_sign) break;
    ++end;
  }
  return end;
}

std::size_t GlLexer::unknown_end() const {
  std::size_t end = at_ + 1;
  while (end < text_.size() && !is_word(text_[end]) && !is_blank(text_[end]) && text_[end] != '/' &&
         kPunctuation.find(text_[end]) == std::string_view::npos) {
    ++end;
  }
  return end;
}

void GlLexer::advance() {
  if (!skip_blanks(text_, at_, {}, faults_)) cut_short_ = true;
  token_ = {GlToken::Kind::end, at_, {}};
  if (at_ >= text_.size()) return;
  const char c = text_[at_];
  std::size_t end = at_ + 1;
  const bool pascals_hex = c == '$' && end < text_.size() && is_word(text_[end]);
  if (pascals_hex || is_digit(c) || (c == '.' && end < text_.size() && is_digit(text_[end]))) {
    token_.kind = GlToken::Kind::number;
    end = number_end();
  } else if (is_word(c)) {
    token_.kind = GlToken::Kind::name;
    while (end < text_.size() && is_word(text_[end])) ++end;
  } else if (kPunctuation.find(c) != std::string_view::npos) {
    token_.kind = GlToken::Kind::punctuation;
    if (text_.substr(at_).starts_with("->") || text_.substr(at_).starts_with("::")) ++end;
  } else {
    token_.kind = GlToken::Kind::unknown;
    end = unknown_end();
  }
  token_.text = text_.substr(at_, end - at_);
  at_ = end;
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
