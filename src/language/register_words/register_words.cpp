// Parses and prints `NAME = 0x…` lines.
#include "ninebit/language/register_words.h"

#include <algorithm>
#include <charconv>

#include "src/language/c_like/c_lexer.h"
#include "src/language/c_like/c_number.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/language/source/source_faults.h"
#include "src/system/lines.h"

namespace ninebit {
namespace {

// With more words than the chip has, some are repeated; reading on would only repeat that fault.
constexpr std::size_t kMaxWords = 1000;

// The character at a place, for a message.
std::string what_is_at(std::string_view line, std::size_t at) {
  if (at >= line.size()) return "the end of the line";
  const char c = line[at];
  if (c > ' ' && c <= '~') return std::string("'") + c + "'";
  return "the byte " + words::hex_text(static_cast<unsigned char>(c), 2);
}

class Line {
 public:
  Line(std::string_view text, int number, TextFaults& faults) : text_(text), number_(number), faults_(faults) {}

  // Reads one line; empty if it has no word or a fault.
  std::optional<RegisterWord> read() {
    skip_blanks();
    if (at_end()) return std::nullopt;
    RegisterWord word;
    word.place = place();
    word.name = read_name();
    if (word.name.empty()) return fail("expected NAME = 0x…, where NAME is a register word");
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '<') return read_dumped(std::move(word));
    if (at_ >= text_.size() || (text_[at_] != '=' && text_[at_] != ':')) return fail("expected = after " + word.name);
    ++at_;
    skip_blanks();
    const TextPlace value_place = place();
    const std::string_view digits = read_token();
    if (digits.empty()) return fail("expected a value such as 0x08040000");
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    const std::string_view number = hexadecimal ? digits.substr(2) : digits;
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), word.value, hexadecimal ? 16 : 10);
    const bool octal_like = !hexadecimal && digits.size() > 1 && digits.front() == '0';
    if (error == std::errc::result_out_of_range) return fail_at(value_place, "the value does not fit in 32 bits");
    if (error != std::errc{} || end != number.data() + number.size() || octal_like) {
      return fail_at(value_place, "the value must be hexadecimal with 0x, or decimal without leading zeros");
    }
    skip_blanks();
    if (!at_end()) return fail("expected the end of the line after the value");
    return word;
  }

 private:
  [[nodiscard]] TextPlace place() const { return {number_, 1 + static_cast<int>(at_)}; }

  void skip_blanks() {
    while (at_ < text_.size() && detail::is_blank(text_[at_])) ++at_;
  }

  [[nodiscard]] bool at_end() const {
    return at_ >= text_.size() || text_[at_] == '#' || text_.substr(at_).starts_with("//");
  }

  std::string read_name() {
    const std::size_t start = at_;
    if (at_ < text_.size() &&
        (detail::is_letter(text_[at_]) || text_.substr(at_).starts_with("0x") || text_.substr(at_).starts_with("0X"))) {
      while (at_ < text_.size() && detail::is_word(text_[at_])) ++at_;
    }
    if (at_ > start && at_ < text_.size() && (text_[at_] == '[' || text_[at_] == '(')) {
      const char close = text_[at_] == '[' ? ']' : ')';
      std::size_t end = at_ + 1;
      while (end < text_.size() && detail::is_digit(text_[end])) ++end;
      if (end > at_ + 1 && end < text_.size() && text_[end] == close) at_ = end + 1;
    }
    return std::string(text_.substr(start, at_ - start));
  }

  std::string_view read_token() {
    const std::size_t start = at_;
    while (at_ < text_.size() && detail::is_word(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }

  // The rest of nv2a-trace's "NAME<0xADDRESS> (DECIMAL <0xHEXADECIMAL>)". Registers that are not of the combiners are
  // skipped: such a list has all of them.
  std::optional<RegisterWord> read_dumped(RegisterWord word) {
    const std::optional<std::uint32_t> address = read_number_after("<0x", 16);
    const std::optional<std::uint32_t> value = address && take('>') ? read_number_after("(", 10) : std::nullopt;
    const std::optional<std::uint32_t> again = value ? read_number_after("<0x", 16) : std::nullopt;
    if (!again || !take('>') || !take(')') || !at_end()) {
      return fail("expected NAME<0xADDRESS> (DECIMAL <0xHEXADECIMAL>)");
    }
    if (*value != *again)
      return fail_at(word.place,
                     word.name + " has two values: " + std::to_string(*value) + " and " + words::hex_text(*again));
    const bool is_known =
        words::find_slot(word.name, ChipClass::nv20).slot || !words::find_other_word(word.name).empty();
    const std::string at_address = words::hex_text(*address, 6);
    const bool is_known_there =
        words::find_slot(at_address, ChipClass::nv20).slot || !words::find_other_word(at_address).empty();
    if (is_known != is_known_there || (is_known && !is_same_word(word.name, at_address))) {
      return fail_at(word.place, word.name + " is not the register at " + at_address);
    }
    word.value = *value;
    return is_known ? std::optional(std::move(word)) : std::nullopt;
  }

  static bool is_same_word(const std::string& name, const std::string& address) {
    const words::FoundSlot one = words::find_slot(name, ChipClass::nv20),
                           other = words::find_slot(address, ChipClass::nv20);
    if (!one.slot || !other.slot) return words::find_other_word(name) == words::find_other_word(address);
    return one.slot->kind == other.slot->kind && one.slot->index == other.slot->index;
  }

  std::optional<std::uint32_t> read_number_after(std::string_view begin, int base) {
    skip_blanks();
    if (!text_.substr(std::min(at_, text_.size())).starts_with(begin)) return std::nullopt;
    at_ += begin.size();
    const std::string_view digits = read_token();
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    const bool is_number = error == std::errc{} && end == digits.data() + digits.size() && !digits.empty();
    return is_number ? std::optional(value) : std::nullopt;
  }

  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  std::nullopt_t fail(const std::string& expected) {
    faults_.add(place(), expected + "; found " + what_is_at(text_, at_));
    return std::nullopt;
  }

  std::nullopt_t fail_at(TextPlace where, const std::string& what) {
    faults_.add(where, what);
    return std::nullopt;
  }

  std::string_view text_;
  int number_;
  TextFaults& faults_;
  std::size_t at_ = 0;
};

// Reads a struct that gdb printed: "$1 = {combiner_control = 69889, rgb_inputs = {134479872, 0, …}, …}". Members that
// are not words are skipped, those of inner structs are read.
class PrintedStruct {
 public:
  PrintedStruct(std::string_view text, TextFaults& faults) : text_(text), faults_(faults), tokens_(text) {
    while (!tokens_.peek().is("{") && !tokens_.at_end()) tokens_.take();
  }

  std::vector<RegisterWord> read() {
    const bool is_whole = members(0);
    if (is_whole && !tokens_.at_end()) expected("the end of the text behind the struct");
    if (faults_.empty() && words_.empty()) faults_.add({}, "has no member such as combiner_control or rgb_inputs");
    return std::move(words_);
  }

 private:
  bool expected(const char* what) {
    faults_.add(place_of(text_, tokens_.peek().offset),
                std::string("expected ") + what + "; found " + shown(tokens_.peek()));
    return false;
  }

  // "{a = 1, b = {2, 3}}"; each function returns false after a fault.
  bool members(int depth) {
    constexpr int kDeepest = 32;
    if (depth > kDeepest) return expected("fewer braces");
    tokens_.take();
    while (!tokens_.takes("}")) {
      if (!tokens_.peek().is_name()) return expected("the name of a member, or '}'");
      const std::string name(tokens_.take().text);
      if (!tokens_.takes("=")) return expected("'='");
      if (!value(name, depth)) return false;
      tokens_.takes(",");
    }
    return true;
  }

  bool value(const std::string& name, int depth) {
    const bool is_row = tokens_.peek().is("{");
    const bool is_word =
        words::find_slot(is_row ? name + "[0]" : name, ChipClass::nv20).slot || !words::find_other_word(name).empty();
    if (!is_row && is_word) return number(name);
    if (!is_row) {
      while (!tokens_.peek().is(",") && !tokens_.peek().is("}") && !tokens_.at_end()) tokens_.take();
      return true;
    }
    code::TokenReader ahead = tokens_;
    ahead.take();
    if (ahead.take().is_name() && ahead.peek().is("=")) return members(depth + 1);
    if (!is_word) return skip();
    tokens_.take();
    for (int i = 0; !tokens_.takes("}"); ++i) {
      if (!number(name + "[" + std::to_string(i) + "]")) return false;
      tokens_.takes(",");
    }
    return true;
  }

  bool number(const std::string& name) {
    const code::Token token = tokens_.peek();
    if (words_.size() == kMaxWords) return expected("at most 1,000 words");
    const auto value = token.kind == code::Token::Kind::number ? code::read_number(token.text) : std::nullopt;
    if (!value || value->may_be_real() || value->integer < 0 || value->integer > 0xffff'ffff) {
      return expected("a number of 32 bits");
    }
    words_.push_back({name, static_cast<std::uint32_t>(value->integer), place_of(text_, token.offset)});
    tokens_.take();
    return true;
  }

  // Skips a row with its braces.
  bool skip() {
    int depth = 0;
    do {
      const code::Token token = tokens_.take();
      if (token.is("{")) ++depth;
      if (token.is("}")) --depth;
    } while (depth > 0 && !tokens_.at_end());
    return true;
  }

  std::string_view text_;
  TextFaults& faults_;
  code::TokenReader tokens_;
  std::vector<RegisterWord> words_;
};

// The text with blanks in place of a byte order mark and comments before its first word.
std::string without_first_comments(std::string_view text) {
  std::string plain(text);
  std::size_t begin = mark_size(text);
  detail::SourceFaults none({text, {}});
  if (!detail::skip_blanks(text, begin, {.hash_comments = true, .heading = {}}, none)) return plain;
  std::replace_if(
      plain.begin(), plain.begin() + static_cast<std::ptrdiff_t>(begin), [](char c) { return c != '\n'; }, ' ');
  return plain;
}

std::vector<RegisterWord> read_lines(std::string_view text, TextFaults& faults) {
  std::vector<RegisterWord> found;
  int number = 1;
  for (std::size_t start = 0; start <= text.size() && !faults.full() && found.size() < kMaxWords; ++number) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (auto word = Line(text.substr(start, end - start), number, faults).read()) found.push_back(std::move(*word));
    start = end + 1;
  }
  return found;
}

}  // namespace

bool words::is_printed_struct(std::string_view text) {
  if (text.starts_with('$')) {
    const std::size_t end = text.find_first_not_of("0123456789", 1);
    return end > 1 && end != std::string_view::npos && text.substr(end).starts_with(" = {");
  }
  return text.starts_with("{combiner_control = ");
}

bool words::is_listed_register(std::string_view text) {
  std::string_view line = text.substr(0, text.find('\n'));
  const std::size_t end = line.find_first_of("<: \t");
  if (end == std::string_view::npos) return false;
  const std::string name = bare_name(line.substr(0, end));
  const bool is_name = line.starts_with("NV_PGRAPH_") || (line.starts_with("0x") && !name.empty());
  line.remove_prefix(end);
  return is_name && (line.starts_with("<0x") || line.starts_with(": 0x") || line.starts_with(":0x"));
}

Parsed<CombinerState> parse_register_words(const SourceText& source, ChipClass chip, const HardwareProfile& profile,
                                           std::vector<RegisterWord>* other_words) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  const std::string text = without_first_comments(source.text);
  const bool printed =
      words::is_printed_struct(std::string_view(text).substr(std::min(text.find_first_not_of(" \n"), text.size())));
  const auto found = printed ? PrintedStruct(text, faults).read() : read_lines(text, faults);
  if (printed && !faults.empty()) return faults.take();
  Parsed<CombinerState> decoded = decode_register_words(found, source.file, chip, profile, other_words);
  if (faults.empty()) return decoded;
  faults.add(decoded.faults());
  return faults.take();
}

Result<std::string> print_register_words(const CombinerState& state, ChipClass chip, const HardwareProfile& profile,
                                         std::span<const RegisterWord> other_words) {
  const auto words = encode_register_words(state, chip, profile);
  if (!words) return words.error();
  std::string text;
  const auto add = [&](const RegisterWord& word) { text += word.name + " = " + words::hex_text(word.value) + '\n'; };
  std::for_each(words->begin(), words->end(), add);
  if (chip == ChipClass::nv20) std::for_each(other_words.begin(), other_words.end(), add);
  return text;
}

}  // namespace ninebit
