#include "src/language/register_log/log_tokens.h"

#include <algorithm>
#include <charconv>

#include "src/language/source/source_faults.h"

namespace ninebit::reglog {
namespace {

bool is_letter_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool ends_word(char c) {
  return detail::is_blank(c) || std::string_view(",;()<>{}=|\"'").find(c) != std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && detail::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && detail::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

void split_words(std::string_view line, std::vector<LogToken>& into) {
  for (std::size_t at = 0; at < line.size() && into.size() < kMostTokens;) {
    const char c = line[at];
    const bool opens_tag = c == '<' && at + 1 < line.size() && (line[at + 1] == '/' || is_letter_of_name(line[at + 1]));
    if (opens_tag) {
      const std::size_t end = line.find('>', at);
      if (end != std::string_view::npos) {
        at = end + 1;
        continue;
      }
    }
    if (ends_word(c)) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !ends_word(line[end])) ++end;
    std::string_view word = line.substr(at, end - at);
    while (word.size() > 1 && word.back() == ':') word.remove_suffix(1);
    into.push_back({word, 1 + static_cast<int>(at)});
    at = end;
  }
}

void split_fields(std::string_view line, char separator, std::vector<LogToken>& into) {
  for (std::size_t at = 0; at <= line.size() && into.size() < kMostTokens;) {
    std::size_t start = at;
    while (start < line.size() && line[start] == ' ') ++start;
    const bool quoted = start < line.size() && line[start] == '"';
    const std::size_t close = quoted ? std::min(line.find('"', start + 1), line.size()) : at;
    const std::size_t end = std::min(line.find(separator, close), line.size());
    if (quoted) {
      into.push_back({trimmed(line.substr(start + 1, close - start - 1)), 2 + static_cast<int>(start)});
    } else {
      const std::string_view field = trimmed(line.substr(at, end - at));
      const std::size_t begin = field.empty() ? at : static_cast<std::size_t>(field.data() - line.data());
      into.push_back({field, 1 + static_cast<int>(begin)});
    }
    at = end + 1;
  }
}

}  // namespace

void split_line(std::string_view line, char separator, std::vector<LogToken>& into) {
  into.clear();
  if (separator == 0) {
    split_words(line, into);
  } else {
    split_fields(line, separator, into);
  }
}

bool has_hex_prefix(std::string_view token) {
  return token.size() > 2 && token[0] == '0' && (token[1] == 'x' || token[1] == 'X');
}

bool is_hex_digits(std::string_view token) {
  return !token.empty() && std::all_of(token.begin(), token.end(), [](char c) {
    return detail::is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
  });
}

std::optional<std::uint32_t> number_in(std::string_view token, bool hexadecimal) {
  int base = hexadecimal ? 16 : 10;
  if (has_hex_prefix(token)) {
    token.remove_prefix(2);
    base = 16;
  }
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value, base);
  if (token.empty() || error != std::errc{} || end != token.data() + token.size()) return std::nullopt;
  return value;
}

bool is_log_name(std::string_view token) {
  return !token.empty() && is_letter_of_name(token.front()) &&
         std::all_of(token.begin(), token.end(), [](char c) { return detail::is_word(c) || c == '[' || c == ']'; });
}

}  // namespace ninebit::reglog
