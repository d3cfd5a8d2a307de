// Lines of a log as tokens, and tokens as numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace ninebit::reglog {

struct LogToken {
  std::string_view text{};
  int column = 1;  // of its first byte, from 1
};

inline constexpr std::size_t kMostTokens = 64;  // of a line; further ones are not looked at

// Splits a line at a separator (',', ';', '|' or a tab), quotes and blanks around the fields removed; or, for 0, into
// words: at blanks, brackets, commas, quotes, = and |, without the tags of HTML and without colons at their ends.
void split_line(std::string_view line, char separator, std::vector<LogToken>& into);

// The value of a token: 0x and hexadecimal digits, or digits that are hexadecimal if `hexadecimal`, else decimal.
// Empty: it is not a number of 32 bits.
[[nodiscard]] std::optional<std::uint32_t> number_in(std::string_view token, bool hexadecimal);

// Whether a token begins with 0x; whether it consists of hexadecimal digits alone.
[[nodiscard]] bool has_hex_prefix(std::string_view token);
[[nodiscard]] bool is_hex_digits(std::string_view token);
// Whether a token is a name: a letter first, then letters, digits, underscores and an index.
[[nodiscard]] bool is_log_name(std::string_view token);

}  // namespace ninebit::reglog
