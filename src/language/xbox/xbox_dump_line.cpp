#include "src/language/xbox/xbox_dump_line.h"

#include <algorithm>

#include "ninebit/language/xbox_pixel_shader.h"
#include "src/language/source/source_faults.h"

namespace ninebit::xbox {
namespace {

bool is_hex_digit(char c) {
  return detail::is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

bool is_separator(char c) {
  return detail::is_blank(c) || c == ',' || c == ';';
}

// "00-00", of which the first two characters are the next number.
bool is_pair(std::string_view token) {
  return token.size() == 5 && token[2] == '-' && is_hex_digit(token[0]) && is_hex_digit(token[1]) &&
         is_hex_digit(token[3]) && is_hex_digit(token[4]);
}

void take_prefix(DumpNumber& number) {
  if (!number.digits.starts_with("0x") && !number.digits.starts_with("0X")) return;
  number.prefixed = true;
  number.digits.remove_prefix(2);
  while (!number.digits.empty() && std::string_view("uUlL").find(number.digits.back()) != std::string_view::npos) {
    number.digits.remove_suffix(1);
  }
}

}  // namespace

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool is_hex_number(const DumpNumber& number) {
  return !number.digits.empty() && number.digits.size() <= 2 * kXboxDefinitionBytes &&
         std::all_of(number.digits.begin(), number.digits.end(), is_hex_digit);
}

bool is_row_offset(const DumpNumber& number) {
  DumpNumber low = number;
  if (number.digits.size() == 17 && number.digits[8] == '`') {
    if (!std::all_of(number.digits.begin(), number.digits.begin() + 8, is_hex_digit)) return false;
    low.digits.remove_prefix(9);
  }
  return is_hex_number(low);
}

std::size_t bytes_of(const DumpNumber& number) {
  if (number.prefixed) return number.digits.size() == 2 ? 1 : 4;
  return number.digits.size() / 2;
}

DumpLine::DumpLine(std::string_view line, int number) : line_(line), number_(number) {
  // od -z writes the characters between > and <.
  const std::size_t end =
      std::min({line.find('|'), line.find("  >"), line.find("//"), line.find('#'), line.find("/*"), line.size()});
  rest_ = line.substr(0, end);
}

std::optional<DumpNumber> DumpLine::take() {
  const std::size_t start = at_;
  if (at_ > 0 && at_ < rest_.size() && rest_[at_] == '-') ++at_;  // of the pair that is_pair() found
  while (at_ < rest_.size() && is_separator(rest_[at_])) ++at_;
  if (at_ >= rest_.size()) return std::nullopt;
  const std::size_t begin = at_;
  while (at_ < rest_.size() && !is_separator(rest_[at_])) ++at_;
  if (taken_ > 0 && is_pair(rest_.substr(begin, at_ - begin))) at_ = begin + 2;
  DumpNumber number{rest_.substr(begin, at_ - begin), {number_, 1 + static_cast<int>(begin)}};
  ++taken_;
  if (taken_ == 1 && number.digits.ends_with(':')) {
    number.is_offset = has_colon_ = has_offset_ = true;
    number.digits.remove_suffix(1);
  }
  take_prefix(number);
  if (taken_ == 1) {
    if (number.digits.find('`') != std::string_view::npos && is_row_offset(number)) number.is_offset = true;
    has_offset_ = has_offset_ || number.is_offset;
    if (number.is_offset || number.digits.size() >= 4) return number;
  }
  const std::size_t gap = begin - start;
  if (taken_ == 2 && gap > 1 && data_ == 0) has_offset_ = true;
  in_characters_ = in_characters_ || begins_characters(number, gap, start);
  has_single_gap_ = has_single_gap_ || (data_ > 0 && gap == 1);
  if (data_ == 0) width_ = number.digits.size();
  ++data_;
  bytes_ += bytes_of(number);
  return number;
}

// xxd and WinDbg write one character for each byte, behind two blanks. They may look like numbers.
bool DumpLine::begins_characters(const DumpNumber& number, std::size_t gap, std::size_t end_of_last) const {
  if (!has_offset_ || gap < 2 || data_ == 0) return false;
  const std::size_t characters = line_.size() - std::min(line_.size(), end_of_last + 2);
  if (characters == bytes_ && has_single_gap_) return true;
  const bool other = !is_hex_number(number) || (!number.prefixed && number.digits.size() != width_);
  // Editors remove blanks at the ends of lines.
  return other && (has_colon_ || characters < bytes_ || characters == bytes_);
}

}  // namespace ninebit::xbox
