#include "src/language/pixel_shader/shader_lexer.h"

#include <algorithm>

#include "src/language/source/source_faults.h"

namespace ninebit::detail {
namespace {

char lower_letter(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool begins_with(std::string_view text, std::string_view lower_word) {
  return text.size() >= lower_word.size() && std::equal(lower_word.begin(), lower_word.end(), text.begin(),
                                                        [](char a, char b) { return a == lower_letter(b); });
}

bool is_name_letter(char c) {
  return is_word(c) && !is_digit(c);
}

class ShaderLexer {
 public:
  ShaderLexer(std::string_view text, SourceFaults& faults) : text_(text), faults_(faults) {
    if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  }

  std::vector<ShaderToken> read() {
    while (at_ < text_.size()) {
      if (tokens_.size() == kMostShaderTokens) {
        faults_.add(at_, "the text is longer than " + std::to_string(kMostShaderTokens) + " words");
        break;
      }
      if (!skipped()) token();
    }
    add(ShaderToken::Kind::end_of_line, 0);
    add(ShaderToken::Kind::end, 0);
    return std::move(tokens_);
  }

 private:
  // Skips a blank or a comment, or adds a line's end; false: a token begins here.
  bool skipped() {
    const std::string_view rest = text_.substr(at_);
    if (rest.front() == '\n') {
      add(ShaderToken::Kind::end_of_line, 1);
    } else if (is_blank(rest.front()) || rest.front() == '\0') {
      ++at_;
    } else if (rest.front() == ';' || rest.starts_with("//")) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (rest.starts_with("/*")) {
      comment();
    } else if (rest.front() == '\\' && continues()) {
      at_ = text_.find('\n', at_) + 1;
    } else {
      return false;
    }
    return true;
  }

  void comment() {
    const std::size_t end = text_.find("*/", at_ + 2);
    if (end == std::string_view::npos) {
      faults_.add(at_, "unterminated comment; expected */");
      at_ = text_.size();
      return;
    }
    at_ = end + 2;
  }

  // Whether nothing but blanks stands between a backslash and the end of its line.
  [[nodiscard]] bool continues() const {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) return false;
    const std::string_view between = text_.substr(at_ + 1, end - at_ - 1);
    return std::all_of(between.begin(), between.end(), is_blank);
  }

  void token() {
    const std::string_view rest = text_.substr(at_);
    const char c = rest.front();
    const bool glued = at_ > 0 && (is_word(text_[at_ - 1]) || text_[at_ - 1] == ']');
    if (const std::size_t length = shader_version_length(rest); length > 0) {
      add(ShaderToken::Kind::version, length);
    } else if (is_name_letter(c)) {
      const auto end = std::find_if_not(rest.begin(), rest.end(), is_word);
      add(ShaderToken::Kind::word, static_cast<std::size_t>(end - rest.begin()));
    } else if (is_digit(c) || (c == '.' && !glued && rest.size() > 1 && is_digit(rest[1]))) {
      add(ShaderToken::Kind::number, number_length(rest));
    } else {
      add(ShaderToken::Kind::punctuation, 1);
    }
  }

  // Digits with a fraction and an exponent; an f and other letters that follow directly belong to it.
  static std::size_t number_length(std::string_view rest) {
    std::size_t length = 0;
    while (length < rest.size()) {
      const char c = rest[length];
      const bool sign = (c == '+' || c == '-') && lower_letter(rest[length - 1]) == 'e' && length + 1 < rest.size() &&
                        is_digit(rest[length + 1]);
      if (!is_word(c) && c != '.' && !(length > 0 && sign)) break;
      ++length;
    }
    return length;
  }

  void add(ShaderToken::Kind kind, std::size_t length) {
    tokens_.push_back({kind, at_, text_.substr(at_, length)});
    at_ += length;
  }

  std::string_view text_;
  SourceFaults& faults_;
  std::size_t at_ = 0;
  std::vector<ShaderToken> tokens_;
};

}  // namespace

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), lower_letter);
  return out;
}

std::size_t shader_version_length(std::string_view text) {
  if (begins_with(text, "!!ps1.")) {
    const std::size_t length = std::string_view("!!PS1.").size();
    return text.size() > length && is_digit(text[length]) ? length + 1 : 0;
  }
  const std::size_t name = begins_with(text, "xps") ? 3 : begins_with(text, "ps") ? 2 : 0;
  if (name == 0 || text.size() < name + 4) return 0;
  const char separator = text[name];
  const bool separated = (separator == '.' || separator == '_') && text[name + 2] == separator;
  if (!separated || !is_digit(text[name + 1]) || !is_word(text[name + 3])) return 0;
  std::size_t length = name + 4;
  while (length < text.size() && is_word(text[length])) ++length;
  return length;
}

std::vector<ShaderToken> lex_shader(std::string_view text, SourceFaults& faults) {
  return ShaderLexer(text, faults).read();
}

}  // namespace ninebit::detail
