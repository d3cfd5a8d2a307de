#include "src/language/xbox/xbox_lexer.h"

#include <algorithm>

#include "src/language/source/source_faults.h"

namespace ninebit::xbox {

std::string shown(const Token& token) {
  return token.kind == TokenKind::end ? "the end of the text" : detail::quoted(token.text);
}

Lexer::Lexer(std::string_view text) : text_(text) {
  if (text_.starts_with(detail::kByteOrderMark)) at_ = detail::kByteOrderMark.size();
  next_ = read();
}

Token Lexer::take() {
  const Token token = next_;
  next_ = read();
  return token;
}

void Lexer::skip_line() {
  if (next_.kind == TokenKind::end) return;
  advance(std::min(text_.find('\n', at_), text_.size()));
  next_ = read();
}

// Counts the lines between here and there.
void Lexer::advance(std::size_t to) {
  const std::string_view between = text_.substr(0, to);
  for (std::size_t end = between.find('\n', at_); end < to; end = between.find('\n', end + 1)) {
    ++line_;
    line_start_ = end + 1;
  }
  at_ = to;
}

bool Lexer::is_directive() const {
  constexpr std::string_view kDirectives[] = {"define", "undef", "include", "pragma", "error",
                                              "if",     "else",  "elif",    "endif",  "line"};
  const std::string_view rest = text_.substr(at_ + 1, 40);
  const std::size_t start = std::min(rest.find_first_not_of(" \t"), rest.size());
  std::size_t end = start;
  while (end < rest.size() && detail::is_word(rest[end])) ++end;
  const std::string_view word = rest.substr(start, end - start);
  return std::find(std::begin(kDirectives), std::end(kDirectives), word) != std::end(kDirectives) ||
         word.starts_with("ifdef") || word.starts_with("ifndef");
}

void Lexer::skip_blanks() {
  while (at_ < text_.size()) {
    const std::string_view rest = text_.substr(at_, 2);
    if (detail::is_blank(rest[0])) {
      advance(at_ + 1);
    } else if (rest == "//" || (rest[0] == '#' && !is_directive())) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (rest == "/*") {
      const std::size_t end = text_.find("*/", at_ + 2);
      if (end == std::string_view::npos) unterminated_ = place();
      advance(end == std::string_view::npos ? text_.size() : end + 2);
    } else {
      return;
    }
  }
}

Token Lexer::read() {
  skip_blanks();
  Token token{TokenKind::end, {}, place()};
  if (at_ >= text_.size()) return token;
  std::size_t end = at_;
  while (end < text_.size() && detail::is_word(text_[end])) ++end;
  if (end > at_) {
    token.kind = detail::is_digit(text_[at_]) ? TokenKind::number : TokenKind::name;
  } else {
    constexpr std::string_view kDouble[] = {"->", "<<", ">>", "|="};
    token.kind = TokenKind::mark;
    const bool two = std::find(std::begin(kDouble), std::end(kDouble), text_.substr(at_, 2)) != std::end(kDouble);
    end = at_ + (two ? 2 : 1);
  }
  token.text = text_.substr(at_, end - at_);
  at_ = end;
  return token;
}

}  // namespace ninebit::xbox
