// Rows of traced values, aligned: label, unit, then a column for each channel in each of the three ways.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "ninebit/combiner/trace.h"

namespace ninebit::tools {

// One value, whichever kind it is.
struct TraceCell {
  double held = 0;  // code or wide units
  double real = 0;
  double ideal = 0;
  TraceCell(const TracedCode& v) : held(v.code), real(v.real), ideal(v.ideal) {}
  TraceCell(const TracedWide& v) : held(v.units), real(v.real), ideal(v.ideal) {}
};
using TraceCells = std::vector<TraceCell>;  // one for each channel of the table

enum class TraceEmphasis { none, result, loss, cut };

class TraceTable {
 public:
  explicit TraceTable(bool colors) : colors_(colors) {}

  // Begins a table: its title, and the channels' names above the columns.
  void begin(const std::string& title, std::span<const std::string_view> channels);

  // A row; `note` stands behind the last column.
  void codes(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis = TraceEmphasis::none,
             const std::string& note = "");
  void wide(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis = TraceEmphasis::none,
            const std::string& note = "");

  // A line of text.
  void line(const std::string& text, TraceEmphasis emphasis = TraceEmphasis::none);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void row(const std::string& label, const char* unit, const TraceCells& cells, TraceEmphasis emphasis,
           const std::string& note);

  bool colors_;
  std::string text_;
};

}  // namespace ninebit::tools
