// Lines, words and numbers of the text formats, and numbers of the others.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"

namespace ninebit {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r';
}

// The number of some bytes, the lowest first.
[[nodiscard]] inline std::uint32_t little_endian(std::string_view data, std::size_t at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes; i-- > 0;) value = (value << 8U) | static_cast<unsigned char>(data[at + i]);
  return value;
}

// Reads a text line by line; \n, \r\n and \r all end a line.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : text_(text) {}

  // Reads the next line, without its line end; false at the end of the text.
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = end + 1;
    if (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n') ++at_;
    ++number_;
    return true;
  }

  [[nodiscard]] int number() const { return number_; }                              // of the last line read, from 1
  [[nodiscard]] std::size_t offset() const { return std::min(at_, text_.size()); }  // of the following line

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

// Splits a line into words, up to a word that starts with '#'.
inline void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t at = 0;
  while (at < line.size()) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    if (line[at] == '#') return;
    const std::size_t start = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    words.push_back(line.substr(start, at - start));
  }
}

// The longest line of a text format: the data made from a line takes several times its bytes.
inline constexpr std::size_t kLongestTextLine = std::size_t{1} << 24;

inline Diagnostic at_line(int line, std::string message) {
  return {std::move(message), "", line, Fault::invalid_input};
}

inline Diagnostic overlong(int line) {
  return at_line(line, fmt::format("the line is longer than {} bytes", kLongestTextLine));
}

// A fault for the first longer line, if there is one.
inline std::optional<Diagnostic> overlong_line(std::string_view text) {
  if (text.size() <= kLongestTextLine) return std::nullopt;
  LineScanner lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (line.size() > kLongestTextLine) return overlong(lines.number());
  }
  return std::nullopt;
}

// A word as an integer; nothing if it is not one.
template <class Number>
std::optional<Number> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// A word as a real number; nothing if it is not one. The result is infinite for an infinity or a number that is too
// large, NaN for NaN, and 0 for a number that is too small.
//
// The value is the sum of the digits before the point and up to 15 behind it, each rounded on its own, times a power of
// ten, in the precision of Real: usually the nearest number to the word, sometimes a neighbour of it. Existing pictures
// of text files depend on exactly this sum. A word for which it overflows is rounded once, correctly.
template <class Real>
[[nodiscard]] std::optional<Real> real_of(std::string_view word);

extern template std::optional<float> real_of<float>(std::string_view word);
extern template std::optional<double> real_of<double>(std::string_view word);

// Reads a word as a coordinate in single precision. Returns the fault if it is not one.
[[nodiscard]] std::optional<std::string> read_coordinate(std::string_view word, float& value);

// The same for a component of a normal, which may be infinite or NaN.
[[nodiscard]] std::optional<std::string> read_normal_part(std::string_view word, float& value);

}  // namespace ninebit
