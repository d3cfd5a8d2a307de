// One line of a log as a register write, in the forms that known tools print.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

// Lines of a log as tokens, and tokens as numbers.

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

// A method: its number or, where the line has only that, its name.
struct LogWrite {
  std::uint32_t method = 0;
  std::string_view name{};                      // empty: `method` is the number
  std::optional<std::uint32_t> data{};          // empty: the log does not have it
  std::optional<std::uint32_t> object_class{};  // empty: the log does not have it
  std::optional<std::uint32_t> frame{};         // of a column
  std::uint32_t count = 1;                      // equal writes in one line
  bool foreign = false;                         // of an object that is neither of the known classes
  int column = 1;                               // of the method
};

// Reads a line if it has one of these forms:
//   nv2a_pgraph_method 0: 0x97 -> 0x0ac0 NV097_SET_COMBINER_COLOR_ICW[0] 0x8040000     xemu
//   nv2a_pgraph_method 0: 0x97 -> 0xac0 0x8040000                                      xbdm_gdb_bridge, ntrc
//   nv2a_pgraph_method_abbrev 0: 0x97 -> 0x1800 NV097_ARRAY_ELEMENT16 * 11             xemu
//   nv2a_pgraph_method 0: NV20_KELVIN_PRIMITIVE<0x97> -> NV097_X<0xAC0> (0x8040000 …)  nv2apretty
//   pgraph method (0): 0x97 -> 0x0ac0 (0x8040000)                                      XQEMU, Cxbx, nv2a-trace
//   <command op="0xac0" … class="0x97" … value="0x8040000"/>                           nv2apretty
//   PB: 0x08040000   NV20_3D.RC_IN_RGB[0x0] = …                                        demmt
// Anything may stand before, such as a time.
[[nodiscard]] std::optional<LogWrite> read_known_line(std::string_view line);

}  // namespace ninebit::reglog
