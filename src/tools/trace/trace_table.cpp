#include "src/tools/trace/trace_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/tools/input/terminal.h"

namespace ninebit::tools {
namespace {

constexpr int kLabelWidth = 27;  // with the indent; the unit follows
constexpr std::size_t kColumnWidth = 9;
constexpr int kLeastColumns = 80;
constexpr int kSideBySideColumns = 134;

std::string held_text(double v) {
  return v == std::floor(v) ? fmt::format("{}", static_cast<long long>(v)) : fmt::format("{:.1f}", v);
}

// Five decimals; a number that is too small for them has one digit and an exponent.
std::string real_text(double v) {
  constexpr double kLeast = 0.000005;
  if (v == 0) return "0";
  return std::abs(v) < kLeast ? fmt::format("{:.0e}", v) : fmt::format("{:.5f}", v);
}

std::string_view escape_of(TraceEmphasis emphasis) {
  switch (emphasis) {
    case TraceEmphasis::none:
      return "";
    case TraceEmphasis::result:
      return "\x1b[1m";
    case TraceEmphasis::loss:
      return "\x1b[33m";
    case TraceEmphasis::cut:
      return "\x1b[31m";
  }
  return "";
}

constexpr std::array<std::string_view, 3> kWays{"integer", "real", "ideal"};

}  // namespace

TraceTable::TraceTable(bool colors, int columns)
    : colors_(colors), columns_(std::max(columns, kLeastColumns)), side_by_side_(columns >= kSideBySideColumns) {}

void TraceTable::end_line(const std::string& line, TraceEmphasis emphasis) {
  const std::string_view escape = colors_ ? escape_of(emphasis) : "";
  const std::size_t end = line.find_last_not_of(' ') + 1;
  text_ += fmt::format("{}{}{}\n", escape, std::string_view(line).substr(0, end), escape.empty() ? "" : "\x1b[0m");
}

void TraceTable::begin(const std::string& title, std::span<const std::string_view> channels) {
  channels_.clear();
  for (const std::string_view channel : channels) channels_ += channel.front();
  text_ += '\n';
  if (!side_by_side_) {
    const std::string line =
        fmt::format("{:<{}}    {:>10}{:>9}{:>9}", title, kLabelWidth + 5, kWays[0], kWays[1], kWays[2]);
    end_line(line, TraceEmphasis::result);
    return;
  }
  const std::size_t width = channels.size() * kColumnWidth;
  std::string names = fmt::format("{:<{}}", "", kLabelWidth + 5), ways = fmt::format("{:<{}}", title, kLabelWidth + 5);
  for (const std::string_view way : kWays) {
    ways += fmt::format("  {:>{}}", way, width);
    names += "  ";
    for (const std::string_view channel : channels) names += fmt::format("{:>{}}", channel, kColumnWidth);
  }
  end_line(ways, TraceEmphasis::result);
  if (channels.size() > 1) end_line(names, TraceEmphasis::none);
}

void TraceTable::codes(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis,
                       const std::string& note) {
  row({label, "code", cells, emphasis, note});
}

void TraceTable::wide(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis,
                      const std::string& note) {
  row({label, "wide", cells, emphasis, note});
}

void TraceTable::line(const std::string& text, TraceEmphasis emphasis) {
  const std::string broken = wrapped(text, columns_);
  for (std::size_t from = 0; from <= broken.size();) {
    const std::size_t end = std::min(broken.find('\n', from), broken.size());
    end_line(broken.substr(from, end - from), text.empty() ? TraceEmphasis::none : emphasis);
    from = end + 1;
  }
}

void TraceTable::row(const Row& row) {
  side_by_side_ ? side_by_side(row) : line_by_channel(row);
}

void TraceTable::side_by_side(const Row& row) {
  std::string line = fmt::format("  {:<{}} {}", row.label, kLabelWidth - 2, row.unit);
  const auto columns = [&](auto text_of) {
    line += "  ";
    for (const TraceCell& cell : row.cells) line += fmt::format("{:>{}}", text_of(cell), kColumnWidth);
  };
  columns([](const TraceCell& cell) { return held_text(cell.held); });
  columns([](const TraceCell& cell) { return real_text(cell.real); });
  columns([](const TraceCell& cell) { return real_text(cell.ideal); });
  if (!row.note.empty()) line += "  <- " + row.note;
  end_line(line, row.emphasis);
}

// Neighbours with equal values share a line.
void TraceTable::line_by_channel(const Row& row) {
  const bool of_losses = row.emphasis == TraceEmphasis::loss || row.emphasis == TraceEmphasis::cut;
  std::string label = row.label, unit = row.unit, note = row.note.empty() ? "" : "  <- " + row.note;
  if (width_of(label) > kLabelWidth - 2) {
    line("  " + label);
    label.clear();
  }
  for (std::size_t first = 0, end = 0; first < row.cells.size(); first = end) {
    const TraceCell& cell = row.cells[first];
    while (end < row.cells.size() && row.cells[end] == cell) ++end;
    const std::string text = fmt::format("  {:<{}} {:<4} {:<3}{:>10}{:>9}{:>9}{}", label, kLabelWidth - 2, unit,
                                         channels_.substr(first, end - first), held_text(cell.held),
                                         real_text(cell.real), real_text(cell.ideal), note);
    end_line(text, of_losses && cell.real == 0 && cell.ideal == 0 ? TraceEmphasis::none : row.emphasis);
    for (std::string* const once : {&label, &unit, &note}) once->clear();
  }
}

}  // namespace ninebit::tools
