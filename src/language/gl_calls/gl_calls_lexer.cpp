#include "src/language/gl_calls/gl_calls_lexer.h"

#include <algorithm>

#include "src/language/source/source_blanks.h"

namespace ninebit::detail {
namespace {

constexpr std::string_view kPunctuation = "(){}[],;=+-&*.:";

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
  if (is_digit(c) || (c == '.' && end < text_.size() && is_digit(text_[end]))) {
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

}  // namespace ninebit::detail
