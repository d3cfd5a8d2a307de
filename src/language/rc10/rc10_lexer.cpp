#include "src/language/rc10/rc10_lexer.h"

#include <algorithm>

#include "src/language/source/source_faults.h"
#include "src/system/find_row.h"

namespace ninebit::detail {
namespace {

constexpr std::string_view kRc10Punctuation = "{}()=;,.*+-";
constexpr Blanks kBlanks{.hash_comments = true, .heading = kRc10Header};

std::size_t run_of_words(std::string_view text) {
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_word) - text.begin());
}

std::size_t run_of_digits(std::string_view text) {
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
}

}  // namespace

std::optional<Register> rc10_name(std::string_view word) {
  const Rc10Name* const found = find_row(kRc10Names, &Rc10Name::name, word);
  return found == nullptr ? std::nullopt : std::optional(found->reg);
}

bool takes_rc10_suffix(std::string_view word) {
  const auto reg = rc10_name(word);
  return reg && *reg < Register::e_times_f;
}

Rc10Token Rc10Lexer::take() {
  const Rc10Token taken = token_;
  advance();
  return taken;
}

// The length of a number, [+-]d+, [+-]d+.d* or [+-]d*.d+; 0: there is none here. Letters that follow directly, as in
// 1e5 or 1.0f, are not part of a number, but of the same fault.
std::size_t Rc10Lexer::number_length() const {
  const std::string_view rest = text_.substr(at_);
  std::size_t length = rest.front() == '+' || rest.front() == '-' ? 1 : 0;
  const std::size_t whole = run_of_digits(rest.substr(length));
  length += whole;
  std::size_t fraction = 0;
  if (rest.substr(length).starts_with('.')) {
    fraction = run_of_digits(rest.substr(length + 1));
    if (whole + fraction > 0) length += 1 + fraction;
  }
  return whole + fraction > 0 ? length : 0;
}

// The length of a name with its suffix: tex0.rgb, out.a. A dot before anything but a suffix is the dot product.
std::size_t Rc10Lexer::word_length() const {
  const std::string_view rest = text_.substr(at_);
  const std::size_t length = run_of_words(rest);
  const std::string_view word = rest.substr(0, length);
  if (!takes_rc10_suffix(word) && word != "out") return length;
  for (const std::string_view suffix : {".rgb", ".a", ".b"}) {
    // out.b is lexed too, as one unknown word.
    if (rest.substr(length).starts_with(suffix)) return length + 1 + run_of_words(rest.substr(length + 1));
  }
  return length;
}

std::size_t Rc10Lexer::unknown_length() const {
  std::size_t end = at_ + 1;
  while (end < text_.size() && !is_word(text_[end]) && !is_blank(text_[end]) && text_[end] != '/' &&
         text_[end] != '#' && text_[end] != '!' && kRc10Punctuation.find(text_[end]) == std::string_view::npos) {
    ++end;
  }
  return end - at_;
}

void Rc10Lexer::advance() {
  if (!skip_blanks(text_, at_, kBlanks, faults_)) cut_short_ = true;
  token_ = {Rc10Token::Kind::end, at_, {}};
  if (at_ >= text_.size()) return;
  const char c = text_[at_];
  std::size_t length = number_length();
  if (length > 0) {
    const std::size_t glued = run_of_words(text_.substr(at_ + length));
    token_.kind = glued == 0 ? Rc10Token::Kind::number : Rc10Token::Kind::unknown;
    length += glued;
  } else if (is_word(c)) {
    token_.kind = Rc10Token::Kind::word;
    length = word_length();
  } else if (kRc10Punctuation.find(c) != std::string_view::npos) {
    token_.kind = Rc10Token::Kind::punctuation;
    length = 1;
  } else {
    token_.kind = Rc10Token::Kind::unknown;
    length = unknown_length();
  }
  token_.text = text_.substr(at_, length);
  at_ += length;
}

}  // namespace ninebit::detail
