// A trace as text for people.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "ninebit/combiner/trace.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// How a trace looks on the reader's terminal.
struct TraceLayout {
  bool colors = false;  // escape sequences highlight losses and cuts
  int columns = 80;     // of the terminal; at least 80 are used
};

// One table per portion, with aligned columns: the code that the hardware holds, the number that it represents, and the
// ideal number.
[[nodiscard]] std::string trace_text(const Program& program, const Trace& trace, TraceLayout layout);

// Aligned rows of traced values: label, unit, then integer, real and ideal. On at least 134 columns each of them is a
// column per channel; on fewer, each channel is a line, and neighbours with equal values share one.

// One value of any kind.
struct TraceCell {
  double held = 0;  // code or wide units
  double real = 0;
  double ideal = 0;
  TraceCell(const TracedCode& v) : held(v.code), real(v.real), ideal(v.ideal) {}
  TraceCell(const TracedWide& v) : held(v.units), real(v.real), ideal(v.ideal) {}
  bool operator==(const TraceCell&) const = default;
};
using TraceCells = std::vector<TraceCell>;  // one for each channel of the table

enum class TraceEmphasis { none, result, loss, cut };

class TraceTable {
 public:
  // Lines have at most `columns` code points where that is at least 80; on fewer they have at most 80.
  TraceTable(bool colors, int columns);

  // Starts a table: its title, and the names of the channels.
  void begin(const std::string& title, std::span<const std::string_view> channels);

  // Adds a row; `note` follows the last column. With a line per channel, loss and cut emphasize only the lines that are
  // not 0.
  void codes(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis = TraceEmphasis::none,
             const std::string& note = "");
  void wide(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis = TraceEmphasis::none,
            const std::string& note = "");

  void line(const std::string& text, TraceEmphasis emphasis = TraceEmphasis::none);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  struct Row {
    const std::string& label;
    const char* unit;
    const TraceCells& cells;
    TraceEmphasis emphasis;
    const std::string& note;
  };
  void row(const Row& row);
  void side_by_side(const Row& row);
  void line_by_channel(const Row& row);
  void end_line(const std::string& line, TraceEmphasis emphasis);

  bool colors_;
  int columns_;
  bool side_by_side_;
  std::string channels_;  // initials of the table's channels
  std::string text_;
};

}  // namespace ninebit::tools
