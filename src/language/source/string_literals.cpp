#include "src/language/source/string_literals.h"

#include <algorithm>

#include "src/language/source/source_faults.h"

namespace ninebit {
namespace {

// Writes the contents of literals over blanks.
class LiteralReader {
 public:
  LiteralReader(std::string_view from, std::string& into) : from_(from), into_(into) {}

  void read() {
    while (at_ < from_.size()) {
      if (!literal()) ++at_;
    }
  }

  // Reads literals that belong together; returns where the last one ends.
  std::size_t read_joined() {
    std::size_t end = 0;
    while (at_ < from_.size()) {
      const bool comments = from_.substr(at_).starts_with("/");
      if (literal()) {
        if (!comments) end = at_;
        continue;
      }
      const char c = from_[at_];
      const bool prefix = c == 'L' || c == 'R';  // of the next literal
      const bool joins = detail::is_blank(c) || c == '+' || c == ',' || c == '\\' || prefix;
      if (!joins) break;
      ++at_;
    }
    return std::min(end, from_.size());
  }

 private:
  // A literal or a comment here; false: there is none.
  bool literal() {
    if (comment()) return true;
    if (from_[at_] != '"') return false;
    const bool raw = at_ > 0 && from_[at_ - 1] == 'R';
    raw ? raw_literal() : escaped();
    return true;
  }

  bool comment() {
    const std::string_view rest = from_.substr(at_);
    if (rest.starts_with("//")) {
      at_ = std::min(from_.find('\n', at_), from_.size());
      return true;
    }
    if (!rest.starts_with("/*")) return false;
    const std::size_t end = from_.find("*/", at_ + 1);
    at_ = end == std::string_view::npos ? from_.size() : end + 2;
    return true;
  }

  void escaped() {
    for (++at_; at_ < from_.size() && from_[at_] != '"' && from_[at_] != '\n'; ++at_) {
      if (from_[at_] != '\\') {
        into_[at_] = from_[at_];
        continue;
      }
      if (++at_ >= from_.size()) return;
      const char c = from_[at_];
      if (c == '\r' && from_.substr(at_).starts_with("\r\n")) {
        ++at_;
        continue;
      }
      into_[at_] = c == 'n' ? '\n' : c == 't' || c == 'r' || c == '\n' || c == '0' ? ' ' : c;
    }
    ++at_;
  }

  // R"delimiter( … )delimiter"
  void raw_literal() {
    constexpr std::size_t kLongestDelimiter = 16;
    const std::size_t open = from_.find('(', at_);
    if (open == std::string_view::npos || open - at_ > kLongestDelimiter + 1) return escaped();
    const std::string close = ")" + std::string(from_.substr(at_ + 1, open - at_ - 1)) + "\"";
    const std::size_t end = std::min(from_.find(close, open), from_.size());
    for (at_ = open + 1; at_ < end; ++at_) into_[at_] = from_[at_];
    at_ = std::min(end + close.size(), from_.size());
  }

  std::string_view from_;
  std::string& into_;
  std::size_t at_ = 0;
};

}  // namespace

LiteralText::LiteralText(const SourceText& source, std::size_t begin, std::size_t end)
    : source_(source), begin_(begin), text_(end - begin, ' ') {
  LiteralReader(source.text.substr(begin, end - begin), text_).read();
}

SourceText LiteralText::source() const {
  return {.text = text_,
          .file = source_.file,
          .written = (source_.written.empty() ? source_.text : source_.written).substr(begin_, text_.size()),
          .begin = source_.place(begin_)};
}

std::size_t end_of_literals(std::string_view text, std::size_t begin) {
  constexpr std::size_t kLongest = std::size_t{1} << 20;
  text = text.substr(begin, kLongest);
  std::string contents(text.size(), ' ');
  return begin + LiteralReader(text, contents).read_joined();
}

std::size_t find_literal(std::string_view text, std::string_view header, std::size_t from) {
  for (std::size_t at = from; (at = text.find(header, at)) != std::string_view::npos; ++at) {
    std::size_t before = at;
    while (before > 0 && (detail::is_blank(text[before - 1]) && text[before - 1] != '\n')) --before;
    // An escaped line's end may stand before the header.
    while (before >= 2 && text[before - 2] == '\\' && text[before - 1] == 'n') before -= 2;
    if (before > 0 && text[before - 1] == '(') {  // R"( or R"delimiter(
      constexpr std::size_t kLongestDelimiter = 16;
      const std::size_t first = before - 1 - std::min(before - 1, kLongestDelimiter + 1);
      const std::size_t quote = text.substr(first, before - 1 - first).rfind('"');
      if (quote != std::string_view::npos && first + quote > 0 && text[first + quote - 1] == 'R')
        return first + quote - 1;
    }
    if (before > 0 && text[before - 1] == '"') return before - 1;
  }
  return std::string_view::npos;
}

}  // namespace ninebit
