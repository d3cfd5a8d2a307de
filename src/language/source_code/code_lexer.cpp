#include "src/language/source_code/code_lexer.h"

#include <algorithm>
#include <array>

#include "src/language/source/source_blanks.h"
#include "src/language/source/source_faults.h"

namespace ninebit::code {
namespace {

using detail::is_blank;
using detail::is_digit;
using detail::is_word;

// Longer ones first.
constexpr std::array<std::string_view, 27> kLongPunctuation{
    "<<=", ">>=", "...", "->", "::", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "++",
    "--",  "+=",  "-=",  "*=", "/=", "%=", "&=", "|=", "^=", "##", ":=", "<>", ".."};

bool same_word(std::string_view text, std::string_view lower) {
  return std::equal(text.begin(), text.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

}  // namespace

// A comment at the current place; false: there is none.
bool Lexer::skip_comment() {
  const auto skip_to = [&](std::string_view close, std::size_t from) {
    const std::size_t found = text_.find(close, at_ + from);
    if (found == std::string_view::npos) cut_short_ = true;
    at_ = found == std::string_view::npos ? text_.size() : found + close.size();
    return true;
  };
  if (starts("//")) {
    while (true) {
      at_ = std::min(text_.find('\n', at_), text_.size());
      const bool goes_on = language_ == Language::c && at_ > 0 && at_ < text_.size() && text_[at_ - 1] == '\\';
      if (!goes_on) return true;
      ++at_;
    }
  }
  if (language_ == Language::pascal) {
    if (starts("{")) return skip_to("}", 1);
    return starts("(*") && skip_to("*)", 2);
  }
  return starts("/*") && skip_to("*/", 2);
}

// Returns whether there were any.
bool Lexer::skip_blanks() {
  const std::size_t begin = at_;
  if (at_ == 0 && text_.starts_with(detail::kByteOrderMark)) at_ = detail::kByteOrderMark.size();
  while (at_ < text_.size()) {
    if (text_[at_] == '\n') {
      line_begins_ = true;
      ++at_;
    } else if (is_blank(text_[at_])) {
      ++at_;
    } else if (language_ == Language::c && text_[at_] == '\\' && (starts("\\\n") || starts("\\\r\n"))) {
      at_ = text_.find('\n', at_) + 1;
      line_begins_ = false;
    } else if (!skip_comment()) {
      break;
    }
  }
  return at_ > begin;
}

std::size_t Lexer::number_end() const {
  const bool hex = starts("0x") || starts("0X") || text_[at_] == '$';
  std::size_t end = at_ + 1;
  while (end < text_.size()) {
    const char c = text_[end], before = text_[end - 1];
    const bool sign = (c == '+' || c == '-') && (before == 'e' || before == 'E') && !hex;
    // In Pascal, 0..3 is a range.
    const bool dot = c == '.' && !(language_ == Language::pascal && text_.substr(end).starts_with(".."));
    if (!is_word(c) && !dot && !sign) break;
    ++end;
  }
  return end;
}

// The end of a literal that begins here; without its quote, the end of the line.
std::size_t Lexer::quoted_end(char quote) {
  std::size_t end = at_ + 1;
  while (end < text_.size() && text_[end] != quote && text_[end] != '\n') {
    const bool escape = language_ == Language::c && text_[end] == '\\' && end + 1 < text_.size();
    // Behind a backslash, a line may end as Windows ends it.
    const bool line_goes_on = escape && text_.substr(end + 1).starts_with("\r\n");
    end += line_goes_on ? 3 : escape ? 2 : 1;
  }
  if (end < text_.size() && text_[end] == quote) return end + 1;
  cut_short_ = true;
  return std::min(end, text_.size());
}

// R"delimiter( … )delimiter", whose quote is at `quote`.
std::size_t Lexer::raw_text_end(std::size_t quote) {
  constexpr std::size_t kLongestDelimiter = 16;
  const std::size_t open = text_.find('(', quote);
  if (open == std::string_view::npos || open - quote > kLongestDelimiter + 1) return quote + 1;
  const std::string close = ")" + std::string(text_.substr(quote + 1, open - quote - 1)) + "\"";
  const std::size_t found = text_.find(close, open);
  if (found != std::string_view::npos) return found + close.size();
  cut_short_ = true;
  return text_.size();
}

std::size_t Lexer::punctuation_size() const {
  for (const std::string_view known : kLongPunctuation) {
    const bool is_pascals = known == ":=" || known == "<>" || known == "..";
    const bool is_both = known == "<=" || known == ">=";
    if (starts(known) && (is_both || is_pascals == (language_ == Language::pascal))) return known.size();
  }
  return 1;
}

Token Lexer::next() {
  Token token;
  token.after_blank = skip_blanks();
  token.begins_line = line_begins_;
  token.offset = static_cast<std::uint32_t>(at_);
  token.end = token.offset;
  if (at_ >= text_.size()) return token;
  line_begins_ = false;
  const char c = text_[at_];
  const char after = at_ + 1 < text_.size() ? text_[at_ + 1] : ' ';
  std::size_t end = at_ + 1;
  token.kind = Token::Kind::punctuation;
  if (is_digit(c) || (c == '.' && is_digit(after) && language_ == Language::c) ||
      (language_ == Language::pascal && c == '$' && is_word(after))) {
    token.kind = Token::Kind::number;
    end = number_end();
  } else if (language_ == Language::c && c == 'R' && after == '"') {
    token.kind = Token::Kind::text;
    end = raw_text_end(at_ + 1);
  } else if (is_word(c)) {
    token.kind = Token::Kind::name;
    while (end < text_.size() && is_word(text_[end])) ++end;
  } else if (c == '"' || c == '\'') {
    const bool is_text = c == '"' || language_ == Language::pascal;
    token.kind = is_text ? Token::Kind::text : Token::Kind::character;
    end = quoted_end(c);
  } else if (language_ == Language::pascal && c == '#' && is_digit(after)) {
    token.kind = Token::Kind::text;  // #13#10, characters by their numbers
    while (end < text_.size() && is_digit(text_[end])) ++end;
  } else {
    end = at_ + punctuation_size();
  }
  token.text = text_.substr(at_, end - at_);
  at_ = end;
  token.end = static_cast<std::uint32_t>(at_);
  return token;
}

Language language_of(std::string_view text) {
  constexpr std::size_t kLookedAt = std::size_t{1} << 20;
  Lexer lexer(text, Language::pascal, 0, std::min(text.size(), kLookedAt));
  bool assigns = false, blocks = false, unit = false, includes = false;
  for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next()) {
    includes = includes || (token.is("#") && token.begins_line);
    assigns = assigns || token.is(":=");
    if (!token.is_name()) continue;
    blocks = blocks || same_word(token.text, "begin");
    unit = unit || (token.begins_line && (same_word(token.text, "procedure") || same_word(token.text, "unit") ||
                                          same_word(token.text, "program") || same_word(token.text, "uses")));
  }
  return !includes && (blocks || unit) && (assigns || (blocks && unit)) ? Language::pascal : Language::c;
}

}  // namespace ninebit::code
