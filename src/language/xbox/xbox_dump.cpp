// Hex dumps: rows of numbers with an offset before them and characters behind them.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <utility>

#include "src/language/xbox/xbox_numbers.h"
#include "src/system/lines.h"

namespace ninebit::xbox {
namespace {

bool is_separator(char c) {
  return detail::is_blank(c) || c == ',' || c == ';';
}

// "00-00", of which the first two characters are the next number.
bool is_pair(std::string_view token) {
  return token.size() == 5 && token[2] == '-' && detail::is_hex_digit(token[0]) && detail::is_hex_digit(token[1]) &&
         detail::is_hex_digit(token[3]) && detail::is_hex_digit(token[4]);
}

void take_prefix(DumpNumber& number) {
  if (!number.digits.starts_with("0x") && !number.digits.starts_with("0X")) return;
  number.prefixed = true;
  number.digits.remove_prefix(2);
  while (!number.digits.empty() && std::string_view("uUlL").find(number.digits.back()) != std::string_view::npos) {
    number.digits.remove_suffix(1);
  }
}

// Whether a token may be the offset of a row: hexadecimal, or WinDbg's "00000000`00123450".
bool may_be_row_offset(const DumpNumber& number) {
  DumpNumber low = number;
  if (number.digits.size() == 17 && number.digits[8] == '`') {
    if (!std::all_of(number.digits.begin(), number.digits.begin() + 8, detail::is_hex_digit)) return false;
    low.digits.remove_prefix(9);
  }
  return is_hex_number(low);
}

// How many bytes the number of a row stands for.
std::size_t bytes_of(const DumpNumber& number) {
  if (number.prefixed) return number.digits.size() == 2 ? 1 : 4;
  return number.digits.size() / 2;
}

// Splits a line at blanks and commas, up to a comment or to the characters behind a |. "00-00" are two numbers, as
// WinDbg's db writes the middle of a row.
class DumpLine {
 public:
  // `begin`: the offset of the line.
  DumpLine(std::string_view line, std::size_t begin) : line_(line), begin_(begin) {
    // od -z writes the characters between > and <.
    const std::size_t end =
        std::min({line.find('|'), line.find("  >"), line.find("//"), line.find('#'), line.find("/*"), line.size()});
    rest_ = line.substr(0, end);
  }

  // The next token; empty at the end of the line.
  [[nodiscard]] std::optional<DumpNumber> take();

  // Whether the token that was taken last is the first of its line.
  [[nodiscard]] bool leads() const { return taken_ == 1; }
  // Whether the token that was taken last begins the bytes shown as characters, not more numbers.
  [[nodiscard]] bool in_characters() const { return in_characters_; }

 private:
  [[nodiscard]] bool begins_characters(const DumpNumber& number, std::size_t gap, std::size_t end_of_last) const;

  std::string_view line_, rest_;
  std::size_t begin_;
  std::size_t at_ = 0, taken_ = 0;
  std::size_t data_ = 0, bytes_ = 0, width_ = 0;  // of the numbers behind the offset
  bool has_colon_ = false, has_offset_ = false, has_single_gap_ = false, in_characters_ = false;
};

std::optional<DumpNumber> DumpLine::take() {
  const std::size_t start = at_;
  if (at_ > 0 && at_ < rest_.size() && rest_[at_] == '-') ++at_;  // of the pair that is_pair() found
  while (at_ < rest_.size() && is_separator(rest_[at_])) ++at_;
  if (at_ >= rest_.size()) return std::nullopt;
  const std::size_t begin = at_;
  while (at_ < rest_.size() && !is_separator(rest_[at_])) ++at_;
  if (taken_ > 0 && is_pair(rest_.substr(begin, at_ - begin))) at_ = begin + 2;
  DumpNumber number{rest_.substr(begin, at_ - begin), begin_ + begin};
  ++taken_;
  if (taken_ == 1 && number.digits.ends_with(':')) {
    number.is_row_offset = has_colon_ = has_offset_ = true;
    number.digits.remove_suffix(1);
  }
  take_prefix(number);
  if (taken_ == 1) {
    if (number.digits.find('`') != std::string_view::npos && may_be_row_offset(number)) number.is_row_offset = true;
    has_offset_ = has_offset_ || number.is_row_offset;
    if (number.is_row_offset || number.digits.size() >= 4) return number;
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

struct Row {
  std::optional<DumpNumber> offset{};
  std::vector<DumpNumber> numbers{};
  std::size_t at = 0;    // in the text
  bool repeats = false;  // '*': the row above, up to the next row's offset

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    for (const DumpNumber& number : numbers) sum += bytes_of(number);
    return sum;
  }
};
using Rows = std::vector<Row>;

// A number that a dump has: 0x…, or two, four or eight digits, or many bytes without blanks.
bool is_dump_number(const DumpNumber& number) {
  const std::size_t digits = number.digits.size();
  if (!is_hex_number(number)) return false;
  return number.prefixed ? digits <= 8 : digits == 2 || digits == 4 || (digits >= 8 && digits % 2 == 0);
}

// The rows of a text that have any tokens, offsets among their numbers.
Rows split_rows(std::string_view text) {
  Rows rows;
  std::size_t found = 0;
  for (std::string_view rest = without_mark(text); !rest.empty() && found <= kMostNumbers;) {
    const std::size_t begin = text.size() - rest.size();
    DumpLine split(take_line(rest), begin);
    Row row;
    while (const std::optional<DumpNumber> number = split.take()) {
      if (split.in_characters()) break;
      row.numbers.push_back(*number);
      if (++found > kMostNumbers) break;
    }
    if (row.numbers.empty()) continue;
    row.at = row.numbers.front().offset;
    row.repeats = row.numbers.size() == 1 && row.numbers.front().digits == "*";
    rows.push_back(std::move(row));
  }
  return rows;
}

// Makes the first number of each row its offset, or those alone that are marked as offsets.
Rows with_offsets(Rows rows, bool marked_alone) {
  for (Row& row : rows) {
    if (row.repeats || (marked_alone && !row.numbers.front().is_row_offset)) continue;
    row.offset = row.numbers.front();
    row.numbers.erase(row.numbers.begin());
  }
  return rows;
}

std::optional<std::uint64_t> offset_value(const Row& row, int base) {
  if (!row.offset) return std::nullopt;
  std::string digits;
  std::copy_if(row.offset->digits.begin(), row.offset->digits.end(), std::back_inserter(digits),
               [](char c) { return c != '`'; });
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

// How often each row stands in the dump, if the offsets are numbers of this base: 1, or for '*' the rows that are left
// out. Empty: an offset is missing or not the one above plus its row's bytes.
std::optional<std::vector<std::uint64_t>> counts_of_rows(const Rows& rows, int base) {
  std::vector<std::uint64_t> counts(rows.size(), 1);
  std::size_t above = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].repeats) {
      if (i == 0 || i + 1 == rows.size() || rows[i - 1].repeats) return std::nullopt;
      continue;
    }
    const auto here = offset_value(rows[i], base);
    if (!here) return std::nullopt;
    if (i > 0) {
      const std::uint64_t before = offset_value(rows[above], base).value_or(0), bytes = rows[above].bytes();
      if (bytes == 0 || *here <= before || (*here - before) % bytes != 0) return std::nullopt;
      const std::uint64_t steps = (*here - before) / bytes;
      if (i - above == 1 ? steps != 1 : steps < 2) return std::nullopt;
      if (i - above > 1) counts[i - 1] = steps - 1;
    }
    above = i;
  }
  return counts;
}

// As counts_of_rows(), in the base that gives a definition's bytes, or else in the first base that fits.
std::optional<std::vector<std::uint64_t>> counts_of_rows(const Rows& rows) {
  std::optional<std::vector<std::uint64_t>> first;
  for (const int base : {16, 8, 10}) {
    auto counts = counts_of_rows(rows, base);
    if (!counts) continue;
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < rows.size() && bytes <= kXboxDefinitionBytes; ++i) {
      const std::uint64_t row = rows[i].repeats ? rows[i - 1].bytes() : rows[i].bytes();
      bytes += row * std::min<std::uint64_t>((*counts)[i], kXboxDefinitionBytes + 1);
    }
    if (bytes == kXboxDefinitionBytes) return counts;
    if (!first) first = std::move(counts);
  }
  return first;
}

// Whether the first numbers of the rows are longer or shorter than all others.
bool leads_differ(const Rows& rows) {
  const auto other = std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.numbers.size() > 1; });
  if (other == rows.end()) return false;
  const std::size_t width = other->numbers[1].digits.size();
  return std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
    return row.repeats || (row.numbers[0].digits.size() != width &&
                           std::all_of(row.numbers.begin() + 1, row.numbers.end(),
                                       [&](const DumpNumber& number) { return number.digits.size() == width; }));
  });
}

constexpr std::size_t kFewRows = 3;  // offsets that fit in this many rows are not there by chance

// Finds the offsets: tokens with a colon; or the first of each line if they are longer or shorter than the others, grow
// by the bytes of their rows, or are as many more numbers as a definition does not have.
Rows find_offsets(Rows rows) {
  std::size_t numbers = 0, lines = 0;
  bool marked = false, prefixed = false;
  for (const Row& row : rows) {
    if (row.repeats) continue;
    ++lines;
    numbers += row.numbers.size();
    marked = marked || row.numbers.front().is_row_offset;
    prefixed = prefixed || (row.numbers.size() > 1 && row.numbers[1].prefixed);
  }
  if (marked) return with_offsets(std::move(rows), true);
  if (lines < 2 || numbers == lines) return rows;
  if (leads_differ(rows)) return with_offsets(std::move(rows), false);
  if (lines >= kFewRows && !prefixed) {
    Rows tried = with_offsets(rows, false);
    if (counts_of_rows(tried)) return tried;
  }
  const bool one_more_each = numbers != kXboxDefinitionWords && numbers - lines == kXboxDefinitionWords;
  return one_more_each && !prefixed ? with_offsets(std::move(rows), false) : rows;
}

// The fault of the first '*' of rows for which counts_of_rows() finds no counts.
std::string star_fault(const Rows& rows, std::size_t star) {
  if (star == 0 || rows[star - 1].numbers.empty()) return "'*' repeats the row above it, and there is no such row";
  if (!rows[star - 1].offset || star + 1 == rows.size() || !rows[star + 1].offset) {
    return "'*' stands for repeated rows, but not for how many; expected offsets in the rows around it";
  }
  return "'*' stands for repeated rows, but the offsets do not fit the rows; expected each to be the one above plus "
         "the "
         "bytes of its row";
}

}  // namespace

bool is_hex_number(const DumpNumber& number) {
  return !number.digits.empty() && number.digits.size() <= 2 * kXboxDefinitionBytes &&
         std::all_of(number.digits.begin(), number.digits.end(), detail::is_hex_digit);
}

DumpNumbers read_dump(std::string_view text, detail::SourceFaults& faults) {
  const Rows rows = find_offsets(split_rows(text));
  DumpNumbers dump;
  const auto star = std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.repeats; });
  std::vector<std::uint64_t> counts(rows.size(), 1);
  if (star != rows.end()) {
    if (auto found = counts_of_rows(rows)) {
      counts = std::move(*found);
    } else {
      faults.add(star->at, star_fault(rows, static_cast<std::size_t>(star - rows.begin())));
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].offset && !rows[i].offset->is_row_offset) dump.little_endian_halves = true;
    if (rows[i].offset && rows[i].offset->digits.find('`') != std::string_view::npos) dump.little_endian_halves = true;
    if (rows[i].repeats && i == 0) continue;
    const Row& shown = rows[i].repeats ? rows[i - 1] : rows[i];
    for (std::uint64_t k = 0; k < counts[i] && dump.numbers.size() <= kMostNumbers && !shown.repeats; ++k) {
      for (DumpNumber number : shown.numbers) {
        if (rows[i].repeats) number.offset = rows[i].at;
        dump.numbers.push_back(number);
      }
      if (shown.numbers.empty()) break;
    }
  }
  return dump;
}

bool is_number_list(std::string_view text) {
  constexpr std::size_t kFew = 4;
  constexpr int kLines = 64;
  constexpr std::size_t kLooked = 4096;
  std::size_t found = 0;
  text = without_mark(text);
  for (int lines = 0; !text.empty() && found < kFew && lines < kLines; ++lines) {
    DumpLine line(take_line(text).substr(0, kLooked), 0);
    while (const std::optional<DumpNumber> number = line.take()) {
      if (line.in_characters()) break;
      // An offset may have any number of digits.
      const bool fits =
          line.leads() ? may_be_row_offset(*number) || (found > 0 && number->digits == "*") : is_dump_number(*number);
      if (!fits) return false;
      found += std::max<std::size_t>(1, number->digits.size() / 8);
    }
  }
  return found >= kFew;
}

bool is_hex_dump(std::string_view text) {
  constexpr std::size_t kLooked = std::size_t{1} << 14, kLeastBytes = 8;
  if (!is_number_list(text)) return false;
  // The last line that is looked at may be cut.
  if (text.size() > kLooked) text = text.substr(0, std::min(text.rfind('\n', kLooked), kLooked));
  Rows rows = split_rows(text);
  if (rows.size() < kFewRows || rows[0].bytes() <= kLeastBytes) return false;
  const bool marked = rows[0].numbers.front().is_row_offset;
  const auto numbers_fit = [](const Row& row) {
    return row.repeats || std::all_of(row.numbers.begin() + 1, row.numbers.end(), is_dump_number);
  };
  if (!std::all_of(rows.begin(), rows.end(), numbers_fit)) return false;
  rows = with_offsets(std::move(rows), marked);
  if (rows[0].bytes() < kLeastBytes) return false;
  while (!rows.empty() && rows.back().repeats) rows.pop_back();
  return rows.size() >= kFewRows - 1 && counts_of_rows(rows).has_value();
}

}  // namespace ninebit::xbox
