// The lines of a table of comma-separated values, one at a time, in constant memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "src/system/lines.h"
#include "src/tools/input/input_file.h"

namespace ninebit::tools {

inline constexpr std::size_t kLongestCsvLine = std::size_t{1} << 16;

struct CsvLine {
  std::string_view text;  // without the line end; not blank; valid until the next call of next()
  int number = 0;         // 1-based
};

// The column of a field, a part of the line's text, from 1.
[[nodiscard]] inline std::size_t column_of(const CsvLine& line, std::string_view field) {
  return static_cast<std::size_t>(field.data() - line.text.data()) + 1;
}

// "FILE:LINE:COLUMN: MESSAGE".
[[nodiscard]] Diagnostic csv_fault(const std::string& file, int line, std::size_t column, std::string message);

// A field as one printable line of at most 40 characters.
[[nodiscard]] std::string shown(std::string_view field);

class CsvLines {
 public:
  // Requires a ProgressLine, so that an interrupt ends a wait for input.
  explicit CsvLines(InputFile input) : input_(std::move(input)) {}

  [[nodiscard]] const std::string& name() const { return input_.name(); }

  // The first bytes of the file that have been read.
  [[nodiscard]] std::string_view beginning() const { return beginning_; }

  // The next line that is not blank, without "\n", "\r\n" and, on the first, a byte-order mark; empty at the end.
  [[nodiscard]] Result<std::optional<CsvLine>> next();

 private:
  // The next line, blank or not; empty at the end.
  Result<std::optional<std::string_view>> next_raw();

  InputFile input_;
  LinePieces lines_{kLongestCsvLine};
  std::string beginning_;  // for kind_of_file()
  bool ended_ = false;     // all is read
};

// The fault to report for a table's header: if the file seems to be of another kind, that; else `fault`.
[[nodiscard]] Diagnostic table_fault(const CsvLines& lines, const Diagnostic& fault);

}  // namespace ninebit::tools
