#include "src/language/c_like/c_lexer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "src/language/source/source_faults.h"
#include "src/system/lines.h"

namespace ninebit::code {
namespace {

using detail::is_blank;
using detail::is_digit;
using detail::is_word;

// Longer ones first.
constexpr std::array<std::string_view, 24> kLongPunctuation{
    "<<=", ">>=", "...", "->", "::", "<<", ">>", "<=", ">=", "==", "!=", "&&",
    "||",  "++",  "--",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "##"};

}  // namespace

std::string shown(const Token& token) {
  return token.kind == Token::Kind::end ? "the end of the text" : detail::quoted(token.text);
}

int precedence(const Token& token) {
  constexpr std::array<std::array<std::string_view, 4>, 10> kOrder{{{"||"},
                                                                    {"&&"},
                                                                    {"|"},
                                                                    {"^"},
                                                                    {"&"},
                                                                    {"==", "!="},
                                                                    {"<", ">", "<=", ">="},
                                                                    {"<<", ">>"},
                                                                    {"+", "-"},
                                                                    {"*", "/", "%"}}};
  if (token.kind != Token::Kind::punctuation) return 0;
  for (std::size_t i = 0; i < kOrder.size(); ++i) {
    if (std::find(kOrder[i].begin(), kOrder[i].end(), token.text) != kOrder[i].end()) return static_cast<int>(i) + 1;
  }
  return 0;
}

bool is_assignment(const Token& token) {
  constexpr std::array<std::string_view, 11> kAssignments{
      "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};
  return token.kind == Token::Kind::punctuation &&
         std::find(kAssignments.begin(), kAssignments.end(), token.text) != kAssignments.end();
}

// Only the line is looked at, and no further than needed: a line may have many marks, and a text many lines.
bool begins_directive(std::string_view text, std::size_t at) {
  ++at;
  while (at < text.size() && text[at] != '\n') {
    if (text.substr(at).starts_with("/*")) {
      at += 2;
      while (at < text.size() && text[at] != '\n' && !text.substr(at).starts_with("*/")) ++at;
      if (at == text.size() || text[at] == '\n') return false;
      at += 2;
    } else if (is_blank(text[at])) {
      ++at;
    } else {
      break;
    }
  }
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  return std::find(kDirectives.begin(), kDirectives.end(), text.substr(at, end - at)) != kDirectives.end();
}

// A comment at the current place; false: there is none. A line ends at \r, too, as text editors of old had it.
bool Lexer::skip_comment() {
  if (starts("//")) {
    do {
      at_ = std::min(text_.find_first_of("\r\n", at_ + 1), text_.size());
    } while (at_ < text_.size() && (text_[at_ - 1] == '\\' || text_.substr(0, at_).ends_with("\\\r")));
    return true;
  }
  if (hash_comments_ && starts("#") && !begins_directive(text_, at_)) {
    at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
    return true;
  }
  if (!starts("/*")) return false;
  const std::size_t found = text_.find("*/", at_ + 2);
  if (found == std::string_view::npos) unterminated_ = at_;
  at_ = found == std::string_view::npos ? text_.size() : found + 2;
  return true;
}

// Returns whether there were any.
bool Lexer::skip_blanks() {
  const std::size_t begin = at_;
  if (at_ == 0) at_ = mark_size(text_);
  while (at_ < text_.size()) {
    if (text_[at_] == '\n' || text_[at_] == '\r') {
      line_begins_ = true;
      ++at_;
    } else if (is_blank(text_[at_])) {
      ++at_;
    } else if (starts("\\\n") || starts("\\\r\n")) {
      at_ = text_.find('\n', at_) + 1;
      line_begins_ = false;
    } else if (!skip_comment()) {
      break;
    }
  }
  return at_ > begin;
}

std::size_t Lexer::number_end() const {
  const bool hex = starts("0x") || starts("0X");
  std::size_t end = at_ + 1;
  while (end < text_.size()) {
    const char c = text_[end], before = text_[end - 1];
    const bool power = hex ? before == 'p' || before == 'P' : before == 'e' || before == 'E';
    const bool sign = (c == '+' || c == '-') && power;
    if (!is_word(c) && c != '.' && !sign) break;
    ++end;
  }
  return end;
}

// The end of a literal that begins here; without its quote, the end of the line.
std::size_t Lexer::quoted_end(char quote) const {
  std::size_t end = at_ + 1;
  while (end < text_.size() && text_[end] != quote && text_[end] != '\n') {
    const bool escape = text_[end] == '\\' && end + 1 < text_.size();
    // Behind a backslash, a line may end as Windows ends it.
    const bool line_goes_on = escape && text_.substr(end + 1).starts_with("\r\n");
    end += line_goes_on ? 3 : escape ? 2 : 1;
  }
  return end < text_.size() && text_[end] == quote ? end + 1 : std::min(end, text_.size());
}

// R"delimiter( … )delimiter", whose quote is at `quote`.
std::size_t Lexer::raw_text_end(std::size_t quote) const {
  constexpr std::size_t kLongestDelimiter = 16;
  const std::size_t length = text_.substr(quote, kLongestDelimiter + 2).find('(');
  if (length == std::string_view::npos) return quote + 1;
  const std::size_t open = quote + length;
  const std::string close = ")" + std::string(text_.substr(quote + 1, open - quote - 1)) + "\"";
  const std::size_t found = text_.find(close, open);
  return found == std::string_view::npos ? text_.size() : found + close.size();
}

std::size_t Lexer::punctuation_size() const {
  for (const std::string_view known : kLongPunctuation) {
    if (starts(known)) return known.size();
  }
  // Bytes beyond ASCII stay together, as those of a character do.
  const auto is_beyond = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  std::size_t size = 1;
  while (is_beyond(text_[at_]) && at_ + size < text_.size() && is_beyond(text_[at_ + size])) ++size;
  return size;
}

void Lexer::move_to(std::size_t at) {
  at_ = std::min(at, text_.size());
  line_begins_ = at_ == 0 || text_[at_ - 1] == '\n' || text_[at_ - 1] == '\r';
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
  if (is_digit(c) || (c == '.' && is_digit(after))) {
    token.kind = Token::Kind::number;
    end = number_end();
  } else if (c == 'R' && after == '"') {
    token.kind = Token::Kind::text;
    end = raw_text_end(at_ + 1);
  } else if (is_word(c)) {
    token.kind = Token::Kind::name;
    while (end < text_.size() && is_word(text_[end])) ++end;
  } else if (c == '"' || c == '\'') {
    token.kind = c == '"' ? Token::Kind::text : Token::Kind::character;
    end = quoted_end(c);
  } else {
    end = at_ + punctuation_size();
  }
  token.text = text_.substr(at_, end - at_);
  at_ = end;
  token.end = static_cast<std::uint32_t>(at_);
  return token;
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> all;
  Lexer lexer(text);
  do {
    all.push_back(lexer.next());
  } while (all.back().kind != Token::Kind::end);
  return all;
}

Token TokenReader::take() {
  end_of_last_ = next_.end;
  return std::exchange(next_, lexer_.next());
}

bool TokenReader::takes(std::string_view what) {
  if (!next_.is(what)) return false;
  take();
  return true;
}

std::optional<Token> TokenReader::skip_behind_array() {
  while (!at_end()) {
    const Token first = take();
    if (first.is(";")) continue;
    if (first.is("#") && first.begins_line) {
      while (!at_end() && !peek().begins_line) take();
      continue;
    }
    std::size_t names = first.is_name() ? 1 : 0;
    for (; names > 0 && peek().is_name(); ++names) take();
    if (names > 1 && takes("=") && take().kind == Token::Kind::number && peek().is(";")) continue;
    return first;
  }
  return std::nullopt;
}

void TokenReader::move_to(std::size_t at) {
  lexer_.move_to(at);
  end_of_last_ = at;
  next_ = lexer_.next();
}

}  // namespace ninebit::code
