// The table that `ninebit verify` reads: each row has a program, register codes and expected values, or it is a row of
// a measured table.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/state.h"
#include "src/tools/common/program_file.h"
#include "src/tools/input/csv_lines.h"
#include "src/tools/input/eval_table.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {

// One expected value.
struct Expectation {
  std::string column;        // "out.r", "stage0.spare0.a"; of a measured table its column
  std::optional<int> stage;  // of a register after this general combiner; empty: of the output colour
  Register reg = Register::spare0;
  int component = 0;
  std::vector<int> allowed;  // any of these is accepted
  int tolerance = 0;         // MeasuredFormat::tolerance
  [[nodiscard]] bool allows(int code) const { return distance(code) <= tolerance; }
  // How far a code is from the nearest of these; 0: it is one, or there are none.
  [[nodiscard]] std::int64_t distance(int code) const;
};

struct VerifyRow {
  int line = 0;
  std::string name;  // empty: none
  std::string program_file;
  const CombinerState* program = nullptr;
  RegisterFile registers;
  std::vector<std::pair<EvalColumn, s9>> constants;  // that replace the program's own
  std::vector<Expectation> expected;                 // in the order of execution: stages, then the colour
  const MeasuredFormat* format = nullptr;            // of a measured table; null: the row has a program
  MeasuredRow measured;                              // its cells
};

class VerifyTable {
 public:
  // `program` is the program of rows that name none; its file may be empty. Names in rows are relative to the table's
  // folder. Unless `allow_outside`, a program that is not a regular file below that folder is refused.
  [[nodiscard]] static Result<VerifyTable> open(const std::string& file, const ProgramFlags& program,
                                                bool allow_outside, const HardwareProfile& profile);

  // The next row, with at least one expectation; empty at the end. Reports invalid rows and invalid programs.
  [[nodiscard]] Result<std::optional<VerifyRow>> next();
  [[nodiscard]] const std::string& name() const { return lines_.name(); }

  [[nodiscard]] bool is_measured() const { return format_ != nullptr; }

  // The rows of a measured table so far that lie outside of the rule that was found for it.
  [[nodiscard]] std::size_t skipped() const { return skipped_; }

 private:
  struct Column {
    enum class Kind { program, name, input, expected } kind = Kind::input;
    std::string name;
    EvalColumn input{};
    Expectation expected{};
  };
  VerifyTable(CsvLines lines, ProgramFlags program, const HardwareProfile& profile)
      : lines_(std::move(lines)), program_(std::move(program)), profile_(&profile) {}

  Status read_header(const CsvLine& line, const std::vector<std::string>& comments);
  Status check_columns(const CsvLine& line) const;
  std::optional<Column> column_named(std::string_view field) const;
  Status read_cell(const Column& column, std::string_view field, const CsvLine& line, VerifyRow& row) const;
  Status find_program(const CsvLine& line, VerifyRow& row);
  // A row of a measured table; empty: it is skipped.
  Result<std::optional<VerifyRow>> measured_row(const CsvLine& line);

  CsvLines lines_;
  ProgramFlags program_;
  const HardwareProfile* profile_;
  std::filesystem::path folder_;
  bool allow_outside_ = false;
  std::vector<Column> columns_;
  std::map<std::string, CombinerState> programs_;  // by file; each file is read once
  const MeasuredFormat* format_ = nullptr;
  std::map<std::string, MeasuredRow> beside_;  // rows of the table beside a measured one
  MeasuredRow stated_;                         // cells of all its rows
  std::size_t skipped_ = 0;
};

}  // namespace ninebit::tools
