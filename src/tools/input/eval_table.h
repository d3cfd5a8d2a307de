// The columns of eval's tables, and the conversion of their rows to batches of registers.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/tools/input/csv_lines.h"

namespace ninebit::tools {

inline constexpr std::string_view kComponents = "rgba";

// One component of a register, named as in "tex0.a".
struct EvalColumn {
  Register reg = Register::zero;
  int component = 0;
  [[nodiscard]] std::string name() const;
  friend bool operator==(const EvalColumn&, const EvalColumn&) = default;
};

// The components of a name in any language (register_named): one of "tex0.a" or "t0.a", four of "tex0"; none for
// others.
[[nodiscard]] std::vector<EvalColumn> columns_named(std::string_view name, const HardwareProfile& profile);

// Every register component that a table may have with the profile, in the order of the registers.
[[nodiscard]] std::vector<EvalColumn> eval_columns(const HardwareProfile& profile);

// The columns of a header. Reports its first fault.
[[nodiscard]] Result<std::vector<EvalColumn>> read_header(const CsvLine& line, const std::string& file,
                                                          const HardwareProfile& profile);

// The first line of a table. Reports an empty table.
[[nodiscard]] Result<CsvLine> header_line(CsvLines& lines);

// Up to kBatchSize fragments.
struct EvalBatch {
  RegisterBatch registers{};  // constants only if the table has their columns
  OutputBatch out{};
  std::size_t count = 0;
};

// A table after its header.
struct EvalTable {
  CsvLines lines;
  std::vector<EvalColumn> columns;

  // Requires a ProgressLine, so that an interrupt ends a wait for input.
  [[nodiscard]] static Result<EvalTable> open(const std::string& file, const HardwareProfile& profile);
};

class EvalRows {
 public:
  EvalRows(std::vector<EvalColumn> columns, const HardwareProfile& profile);

  // Empties the batch and sets the defaults of missing columns.
  void begin(EvalBatch& batch) const;
  // Adds a row to a batch that is not full.
  [[nodiscard]] Status add(const CsvLine& line, const std::string& file, EvalBatch& batch) const;
  // Call after the last row of a batch.
  void end(EvalBatch& batch) const;

  [[nodiscard]] bool has(const EvalColumn& column) const;

 private:
  std::vector<EvalColumn> columns_;
  int lowest_, one_;
  RegisterFile defaults_;
};

}  // namespace ninebit::tools
