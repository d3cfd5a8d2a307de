// Aligned rows of traced values: label, unit, then a column per channel for each of integer, real and ideal.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "ninebit/combiner/trace.h"

namespace ninebit::tools {

// One value of any kind.
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

  // Starts a table: its title, and the names of the channels above the columns.
  void begin(const std::string& title, std::span<const std::string_view> channels);

  // Adds a row; `note` follows the last column.
  void codes(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis = TraceEmphasis::none,
             const std::string& note = "");
  void wide(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis = TraceEmphasis::none,
            const std::string& note = "");

  void line(const std::string& text, TraceEmphasis emphasis = TraceEmphasis::none);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void row(const std::string& label, const char* unit, const TraceCells& cells, TraceEmphasis emphasis,
           const std::string& note);

  bool colors_;
  std::string text_;
};

}  // namespace ninebit::tools
