// The lines of a table of comma-separated values, one at a time, in constant memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "src/tools/input/input_file.h"

namespace ninebit::tools {

inline constexpr std::size_t kLongestCsvLine = std::size_t{1} << 16;

struct CsvLine {
  std::string_view text;  // without its end; not blank; valid until the next line is asked for
  int number = 0;         // 1-based
};

// "FILE:LINE:COLUMN: MESSAGE".
[[nodiscard]] Diagnostic csv_fault(const std::string& file, int line, std::size_t column, std::string message);

// Without the blanks around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// Foreign bytes as they can be shown on one line.
[[nodiscard]] std::string shown(std::string_view field);

class CsvLines {
 public:
  // There is a ProgressLine: interrupts are noticed while waiting.
  explicit CsvLines(InputFile input) : input_(std::move(input)) {}

  [[nodiscard]] const std::string& name() const { return input_.name(); }

  // The file's first bytes, as far as they were read.
  [[nodiscard]] std::string_view beginning() const { return beginning_; }

  // The next line that is not blank, without "\n", "\r\n" and, on the first, a byte-order mark; empty at the end.
  [[nodiscard]] Result<std::optional<CsvLine>> next();

 private:
  // The next line, blank or not; empty at the end.
  Result<std::optional<std::string_view>> next_raw();

  InputFile input_;
  std::string_view piece_;  // what of the last read has not been looked at
  std::string carried_;     // a line that spans pieces
  std::string beginning_;   // what kind_of_file() needs
  bool ended_ = false;
  int number_ = 0;
};

// The fault of a table's header; where the file seems to be something else, that.
[[nodiscard]] Diagnostic table_fault(const CsvLines& lines, const Diagnostic& fault);

}  // namespace ninebit::tools
