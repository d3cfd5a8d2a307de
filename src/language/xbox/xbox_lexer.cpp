#include "src/language/xbox/xbox_lexer.h"

#include <algorithm>

#include "src/language/source/source_faults.h"

namespace ninebit::xbox {

std::string shown(const Token& token) {
  return token.kind == Token::Kind::end ? "the end of the text" : detail::quoted(token.text);
}

Lexer::Lexer(std::string_view text) : text_(text), reader_(text) {
  read();
}

Token Lexer::take() {
  const Token token = next_;
  reader_.take();
  read();
  return token;
}

void Lexer::skip_line() {
  if (next_.kind == Token::Kind::end) return;
  reader_.skip_line();
  read();
}

std::optional<TextPlace> Lexer::unterminated() const {
  const auto comment = reader_.unterminated();
  return comment ? std::optional(place_of(text_, *comment)) : std::nullopt;
}

// Whether the mark ahead, #, begins a directive and not a comment.
bool Lexer::is_directive() const {
  constexpr std::string_view kDirectives[] = {"define", "undef", "include", "pragma", "error",
                                              "if",     "else",  "elif",    "endif",  "line"};
  if (!reader_.peek().is("#")) return false;
  // Only the line is looked at, and no further than needed: a line may have many marks, and a text many lines.
  std::size_t at = reader_.peek().end;
  while (at < text_.size() && text_[at] != '\n') {
    if (text_.substr(at).starts_with("/*")) {
      at += 2;
      while (at < text_.size() && text_[at] != '\n' && !text_.substr(at).starts_with("*/")) ++at;
      if (at == text_.size() || text_[at] == '\n') return false;
      at += 2;
    } else if (detail::is_blank(text_[at])) {
      ++at;
    } else {
      break;
    }
  }
  std::size_t end = at;
  while (end < text_.size() && detail::is_word(text_[end])) ++end;
  const std::string_view word = text_.substr(at, end - at);
  return std::find(std::begin(kDirectives), std::end(kDirectives), word) != std::end(kDirectives) ||
         word.starts_with("ifdef") || word.starts_with("ifndef");
}

void Lexer::read() {
  while (reader_.peek().text.starts_with('#') && !is_directive()) reader_.skip_line();
  const code::Token& token = reader_.peek();
  const std::string_view before = text_.substr(0, token.offset);
  for (std::size_t end = before.find('\n', counted_); end != std::string_view::npos; end = before.find('\n', end + 1)) {
    ++line_;
    line_start_ = end + 1;
  }
  counted_ = token.offset;
  next_ = {token, {line_, 1 + static_cast<int>(token.offset - line_start_)}};
}

}  // namespace ninebit::xbox
