#include "src/language/pixel_shader/shader_token_list.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include "src/system/lines.h"

namespace ninebit::detail {
namespace {

constexpr std::size_t kHexDigits = 8;  // of a token without 0x

bool is_version(std::uint32_t token) {
  const std::uint32_t kind = token >> 16, major = token >> 8 & 0xff, minor = token & 0xff;
  return (kind == kPixelShader || kind == kVertexShader) && major >= 1 && major <= 3 && minor <= 4;
}

// Moves to the next token of C. False: the text ends.
bool next_at(std::string_view text, std::size_t& at) {
  SourceFaults none({text, {}});
  return skip_blanks(text, at, {.hash_comments = true, .heading = {}}, none) && at < text.size();
}

// Moves behind the brace of "static const DWORD ps[] = {".
bool skip_array_head(std::string_view text, std::size_t& at) {
  constexpr std::string_view kMarks = "[]=:*()";
  bool has_brackets = false;
  while (next_at(text, at)) {
    const char c = text[at];
    if (c == '{') {
      ++at;
      return has_brackets;
    }
    if (!is_word(c) && kMarks.find(c) == std::string_view::npos) return false;
    has_brackets = has_brackets || c == '[';
    do {
      ++at;
    } while (at < text.size() && is_word(c) && is_word(text[at]));
  }
  return false;
}

// Takes a number and the comma behind it.
std::optional<PlacedToken> take_number(std::string_view text, std::size_t& at, TokenForm form) {
  if (!next_at(text, at)) return std::nullopt;
  PlacedToken out{.offset = at};
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  std::string_view digits = text.substr(at, end - at);
  const bool prefixed = digits.starts_with("0x") || digits.starts_with("0X");
  const bool hex = prefixed || form == TokenForm::hex_list;
  if (hex && !prefixed && digits.size() != kHexDigits) return std::nullopt;
  if (prefixed) digits.remove_prefix(2);
  while ((prefixed || !hex) && !digits.empty() &&
         std::string_view("uUlL").find(digits.back()) != std::string_view::npos) {
    digits.remove_suffix(1);
  }
  const int base = hex ? 16 : digits.size() > 1 && digits[0] == '0' ? 8 : 10;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out.value, base);
  if (digits.empty() || error != std::errc() || last != digits.data() + digits.size()) return std::nullopt;
  at = end;
  if (next_at(text, at) && text[at] == ',') ++at;
  return out;
}

// The form of numbers without braces by the first of them.
TokenForm form_of_list(std::string_view text, std::size_t at) {
  if (!next_at(text, at)) return TokenForm::list;
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  const std::string_view first = text.substr(at, end - at);
  const bool prefixed = first.starts_with("0x") || first.starts_with("0X");
  return !prefixed && first.size() == kHexDigits ? TokenForm::hex_list : TokenForm::list;
}

// Every four bytes as a word in little endian.
std::vector<PlacedToken> words_of_bytes(const std::vector<PlacedToken>& bytes, SourceFaults& faults) {
  std::vector<PlacedToken> words;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i].value > 0xff) faults.add(bytes[i].offset, "the value does not fit in 8 bits");
    if (i % 4 == 0) words.push_back({.offset = bytes[i].offset});
    words.back().value |= (bytes[i].value & 0xff) << (8 * (i % 4));
  }
  if (bytes.size() % 4 == 0) return words;
  faults.add(words.back().offset, "the last token has " + std::to_string(bytes.size() % 4) + " of 4 bytes");
  words.pop_back();
  return words;
}

std::vector<PlacedToken> bytes_of_file(std::string_view text) {
  std::vector<PlacedToken> bytes;
  for (std::size_t i = 0; i < text.size(); ++i) bytes.push_back({static_cast<unsigned char>(text[i]), i});
  return bytes;
}

// Behind a byte order mark and the text that the compiler writes before an array, between #if 0 and #endif.
std::size_t begin_of_tokens(std::string_view text) {
  std::size_t at = mark_size(text);
  SourceFaults none({text, {}});
  const bool skips = skip_blanks(text, at, {}, none) && text.substr(at).starts_with("#if 0");
  const std::size_t end = skips ? text.find("\n#endif", at) : std::string_view::npos;
  return end == std::string_view::npos ? at : std::min(text.find('\n', end + 1), text.size());
}

}  // namespace

TokenList tokens_in(std::string_view text, std::size_t most, SourceFaults& faults) {
  SourceFaults none({text, {}});
  const std::vector<PlacedToken> first = words_of_bytes(bytes_of_file(text.substr(0, 4)), none);
  if (!first.empty() && is_version(first[0].value)) {
    return {TokenForm::bytes_of_file, words_of_bytes(bytes_of_file(text.substr(0, 4 * most)), faults), text.size()};
  }
  TokenList list{.end = begin_of_tokens(text)};
  std::size_t& at = list.end;
  const std::size_t begin = at;
  const bool is_array = skip_array_head(text, at);
  if (!is_array) at = begin;
  list.form = is_array ? TokenForm::array : form_of_list(text, at);
  std::vector<PlacedToken>& numbers = list.tokens;
  bool are_bytes = false;
  while (numbers.size() < (are_bytes ? 4 * most : most)) {
    const auto number = take_number(text, at, list.form);
    if (!number) break;
    numbers.push_back(*number);
    if (numbers.size() > 1) continue;
    are_bytes = is_array && number->value <= 0xff;
    if (!are_bytes && !is_version(number->value)) return {};
  }
  if (are_bytes) {
    const bool is_shader =
        numbers.size() >= 4 && is_version(words_of_bytes({numbers.begin(), numbers.begin() + 4}, none)[0].value);
    numbers = is_shader ? words_of_bytes(numbers, faults) : std::vector<PlacedToken>{};
  }
  return list;
}

bool is_list_closed(code::TokenReader& rest, TokenForm form, SourceFaults& faults) {
  const bool is_array = form == TokenForm::array;
  if (form == TokenForm::bytes_of_file || (is_array && rest.takes("}"))) return true;
  if (!is_array && (rest.at_end() || rest.peek().is(";"))) return true;
  faults.add(rest.peek().offset, std::string("expected a number of 32 bits or ") +
                                     (is_array ? "'}'" : "the end of the text") + "; found " + shown(rest.peek()));
  return false;
}

void check_behind_list(code::TokenReader& rest, SourceFaults& faults) {
  while (!rest.at_end()) {
    const code::Token first = rest.take();
    if (first.is(";")) continue;
    if (first.is("#") && first.begins_line) {
      while (!rest.at_end() && !rest.peek().begins_line) rest.take();
      continue;
    }
    std::size_t names = first.is_name() ? 1 : 0;
    for (; names > 0 && rest.peek().is_name(); ++names) rest.take();
    if (names > 1 && rest.takes("=") && rest.take().kind == code::Token::Kind::number && rest.peek().is(";")) continue;
    return faults.add(first.offset, "more text stands behind the tokens; expected one shader and nothing else");
  }
}

}  // namespace ninebit::detail
