// Where a log's lines have the method and its data: in a form of a known tool, in columns that a header names, or in
// columns that most lines have them in.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/register_log/log_lines.h"
#include "src/language/register_words/register_words_layout.h"

namespace ninebit::reglog {

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
