// Where a log's lines have the method and its data: in a form of a known tool, in columns that a header names, or in
// columns that most lines have them in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/register_words/register_words_layout.h"

namespace ninebit::reglog {

// Lines of a log as tokens, and tokens as numbers.

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

// A column, from 0.
struct Column {
  std::size_t at = 0;
  bool hexadecimal = true;  // numbers without 0x are
};

class LogLayout {
 public:
  // Decides by the first lines of a log. `chip` is the one whose methods' names are looked for. Empty: no line of them
  // is a register write.
  [[nodiscard]] static std::optional<LogLayout> choose(const std::vector<std::string_view>& lines, ChipClass chip);

  // The write of a line; empty: it is none, or it is the header.
  [[nodiscard]] std::optional<LogWrite> read(std::string_view line);

  // Whether a header names the columns; where it stands among the lines, from 0.
  [[nodiscard]] bool has_header() const { return header_.has_value(); }
  [[nodiscard]] std::size_t header_line() const { return header_.value_or(0); }
  // The guess, for a note: "method in column 3, data in column 5"; empty: nothing.
  [[nodiscard]] const std::string& guess() const { return guess_; }
  // In a table with a header: what is wrong with the line that read() was given last, and at which column. A line with
  // wrong data is a write without data nevertheless.
  struct Wrong {
    std::string message{};
    int column = 1;
  };
  [[nodiscard]] const Wrong& wrong() const { return wrong_; }

 private:
  LogLayout() = default;
  [[nodiscard]] static std::optional<LogLayout> by_header(const std::vector<std::string_view>& lines);
  [[nodiscard]] static std::optional<LogLayout> by_columns(const std::vector<std::string_view>& lines, ChipClass chip);
  void find_bases(const std::vector<std::string_view>& lines, ChipClass chip);
  [[nodiscard]] std::optional<LogWrite> read_columns(std::string_view line);

  bool known_ = true;     // lines may have a known form
  bool columns_ = false;  // the others have the columns below
  char separator_ = 0;
  Column method_{}, data_{};
  std::optional<Column> object_class_{}, frame_{};
  std::optional<std::size_t> header_{};
  std::string guess_{};
  Wrong wrong_{};
  std::vector<LogToken> tokens_{};
};

}  // namespace ninebit::reglog
