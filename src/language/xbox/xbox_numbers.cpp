#include "src/language/xbox/xbox_numbers.h"

#include <algorithm>
#include <charconv>

#include "src/language/source/source_blanks.h"
#include "src/language/source/source_faults.h"

namespace ninebit::xbox {
namespace {

// More numbers than any dump of one definition has; reading on would only repeat that fault.
constexpr std::size_t kMostNumbers = 1000;

struct Number {
  std::string_view digits{};  // without 0x and suffix
  TextPlace place{};
  bool prefixed = false;  // with 0x
  bool leads = false;     // the first of its line
  bool offset = false;    // with a colon
};

bool is_hex_digit(char c) {
  return detail::is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

bool is_separator(char c) {
  return detail::is_blank(c) || c == ',' || c == ';';
}

// Splits a line at blanks and commas, up to a comment or to the characters behind a |.
class NumberLine {
 public:
  NumberLine(std::string_view line, int number) : line_(line), number_(number) {
    const std::size_t end = std::min({line.find('|'), line.find("//"), line.find('#'), line.find("/*"), line.size()});
    rest_ = line.substr(0, end);
  }

  // The next token; empty at the end of the line.
  std::optional<Number> take() {
    const std::size_t start = std::min(at_, rest_.size());
    while (at_ < rest_.size() && is_separator(rest_[at_])) ++at_;
    if (at_ >= rest_.size()) return std::nullopt;
    gap_ = at_ - start;
    const std::size_t begin = at_;
    while (at_ < rest_.size() && !is_separator(rest_[at_])) ++at_;
    Number number{rest_.substr(begin, at_ - begin), {number_, 1 + static_cast<int>(begin)}};
    number.leads = !any_;
    any_ = true;
    if (number.leads && number.digits.ends_with(':')) {
      number.offset = true;
      number.digits.remove_suffix(1);
    }
    if (number.digits.starts_with("0x") || number.digits.starts_with("0X")) {
      number.prefixed = true;
      number.digits.remove_prefix(2);
      while (!number.digits.empty() && std::string_view("uUlL").find(number.digits.back()) != std::string_view::npos) {
        number.digits.remove_suffix(1);
      }
    }
    return number;
  }

  // Whether two blanks or more stand before the token that was taken last.
  [[nodiscard]] bool after_gap() const { return gap_ > 1; }

 private:
  std::string_view line_, rest_;
  int number_;
  std::size_t at_ = 0, gap_ = 0;
  bool any_ = false;
};

bool is_hex(const Number& number) {
  return !number.digits.empty() && number.digits.size() <= 2 * kXboxDefinitionBytes &&
         std::all_of(number.digits.begin(), number.digits.end(), is_hex_digit);
}

// A number that a dump has: 0x…, or two, four or eight digits, or many bytes without blanks.
bool is_dump_number(const Number& number) {
  const std::size_t digits = number.digits.size();
  if (!is_hex(number)) return false;
  return number.prefixed ? digits <= 8 : digits == 2 || digits == 4 || (digits >= 8 && digits % 2 == 0);
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(detail::kByteOrderMark)) text.remove_prefix(detail::kByteOrderMark.size());
  return text;
}

// The tokens of a text, without the characters at the ends of xxd's lines.
struct Tokens {
  std::vector<Number> numbers{};
  std::size_t lines = 0;  // that have any
};

Tokens split(std::string_view text) {
  Tokens tokens;
  int line = 1;
  const auto mark = static_cast<int>(text.size() - without_mark(text).size());
  text = without_mark(text);
  for (; !text.empty() && tokens.numbers.size() <= kMostNumbers; ++line) {
    NumberLine split(next_line(text), line);
    bool has_offset = false;
    std::size_t width = 0;
    while (std::optional<Number> number = split.take()) {
      if (number->leads) ++tokens.lines;
      if (line == 1) number->place.column += mark;
      has_offset = has_offset || number->offset;
      if (!number->offset && width == 0) width = number->digits.size();
      const bool characters = has_offset && !number->offset && split.after_gap() && width != 0 &&
                              (!is_hex(*number) || number->digits.size() != width);
      if (characters && !number->leads) break;
      tokens.numbers.push_back(*number);
      if (tokens.numbers.size() > kMostNumbers) break;
    }
  }
  return tokens;
}

// Takes the offsets out: tokens with a colon, or the first of each line if they are longer or shorter than the others
// or as many more as a definition does not have.
void drop_offsets(Tokens& tokens) {
  std::vector<Number>& numbers = tokens.numbers;
  const auto is_first = [](const Number& number) { return number.leads; };
  const auto drop = [&](const auto& which) {
    numbers.erase(std::remove_if(numbers.begin(), numbers.end(), which), numbers.end());
  };
  if (std::any_of(numbers.begin(), numbers.end(), [](const Number& number) { return number.offset; })) {
    return drop([](const Number& number) { return number.offset; });
  }
  if (tokens.lines < 2) return;
  const auto other = std::find_if_not(numbers.begin(), numbers.end(), is_first);
  if (other == numbers.end()) return;
  const std::size_t width = other->digits.size();
  bool differ = true, alike = true;
  for (const Number& number : numbers) {
    (number.leads ? differ : alike) &= (number.digits.size() != width) == number.leads;
  }
  const bool one_more_each =
      numbers.size() != kXboxDefinitionWords && numbers.size() - tokens.lines == kXboxDefinitionWords;
  if ((differ && alike) || (one_more_each && !other->prefixed)) drop(is_first);
}

std::uint32_t value_of(std::string_view digits) {
  std::uint32_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value;
}

// How the numbers of a list are written.
struct Style {
  explicit Style(const std::vector<Number>& numbers) {
    prefixed = std::any_of(numbers.begin(), numbers.end(), [](const Number& number) { return number.prefixed; });
    if (!prefixed && !numbers.empty()) digits = numbers.front().digits.size();
  }

  [[nodiscard]] bool words() const { return prefixed || digits == 8; }
  [[nodiscard]] bool fits(const Number& number) const {
    const std::size_t found = number.digits.size();
    if (!is_hex(number)) return false;
    if (prefixed) return found <= 8 && (number.prefixed || number.digits == "0");
    return digits > 8 ? found % 2 == 0 : found == digits;
  }
  [[nodiscard]] std::string expected() const {
    if (prefixed) return "0x and up to 8 hexadecimal digits";
    return digits > 8 ? "an even number of hexadecimal digits" : std::to_string(digits) + " hexadecimal digits";
  }

  bool prefixed = false;  // with 0x; a 0 may stand alone
  std::size_t digits = 8;
};

void check_count(std::size_t found, const char* what, std::size_t expected, TextPlace place, TextFaults& faults) {
  if (found == expected) return;
  const std::string count = found > kMostNumbers ? "more than " + std::to_string(kMostNumbers) : std::to_string(found);
  faults.add(place, count + " " + what + "; expected the " + std::to_string(expected) + " of a D3DPIXELSHADERDEF");
}

}  // namespace

bool is_binary(std::string_view bytes) {
  return bytes.find('\0') != std::string_view::npos;
}

Definition read_bytes(std::string_view bytes, TextFaults& faults) {
  Definition definition;
  if (bytes.size() != kXboxDefinitionBytes) {
    const bool several = !bytes.empty() && bytes.size() % kXboxDefinitionBytes == 0;
    faults.add({}, std::to_string(bytes.size()) + " bytes" +
                       (several ? ", which are " + std::to_string(bytes.size() / kXboxDefinitionBytes) + " definitions"
                                : std::string()) +
                       "; expected the 240 of one D3DPIXELSHADERDEF");
    return definition;
  }
  for (std::size_t i = 0; i < kXboxDefinitionWords; ++i) {
    definition.places[i] = place_of(bytes, 4 * i);
    for (std::size_t k = 0; k < 4; ++k) {
      definition.words[i] |= std::uint32_t{static_cast<unsigned char>(bytes[4 * i + k])} << (8 * k);
    }
  }
  return definition;
}

bool is_number_list(std::string_view text) {
  constexpr std::size_t kFew = 4;
  std::size_t found = 0;
  text = without_mark(text);
  for (int lines = 0; !text.empty() && found < kFew && lines < 64; ++lines) {
    const std::string_view shown = next_line(text);
    NumberLine line(shown.substr(0, 4096), 1);
    bool has_offset = false;
    for (bool first = true;; first = false) {
      const std::optional<Number> number = line.take();
      if (!number) break;
      has_offset = has_offset || number->offset;
      const bool characters = has_offset && !number->offset && !first && line.after_gap();
      // An offset may have any number of digits.
      if (!(first ? is_hex(*number) : is_dump_number(*number))) return characters && found > 0;
      found += std::max<std::size_t>(1, number->digits.size() / 8);
    }
  }
  return found >= kFew;
}

Definition read_number_list(std::string_view text, TextFaults& faults) {
  Definition definition;
  Tokens tokens = split(text);
  drop_offsets(tokens);
  const Style style(tokens.numbers);
  std::size_t bytes = 0;
  TextPlace last;
  for (const Number& number : tokens.numbers) {
    last = number.place;
    if (!style.fits(number)) {
      faults.add(number.place,
                 detail::quoted(number.digits) + " is not a number of this list; expected " + style.expected());
      bytes += style.words() ? std::size_t{4} : style.digits / 2;
      continue;
    }
    // Bytes stand in their order, the first one of a word at its right.
    const std::size_t step = style.words() ? number.digits.size() : 2, size = style.words() ? 4 : 1;
    for (std::size_t at = 0; at < number.digits.size(); at += step, bytes += size) {
      if (bytes >= kXboxDefinitionBytes) continue;
      std::optional<TextPlace>& place = definition.places[bytes / 4];
      if (!place) place = number.place;
      definition.words[bytes / 4] |= value_of(number.digits.substr(at, step)) << (8 * (bytes % 4));
    }
  }
  if (style.words()) {
    check_count(bytes / 4, "words of 32 bits", kXboxDefinitionWords, last, faults);
  } else {
    check_count(bytes, "bytes", kXboxDefinitionBytes, last, faults);
  }
  return definition;
}

}  // namespace ninebit::xbox
