#include "src/tools/trace/trace_table.h"

#include <fmt/format.h>

#include <cmath>

namespace ninebit::tools {
namespace {

constexpr int kLabelWidth = 27;  // with the indent; the unit follows
constexpr std::size_t kColumnWidth = 9;

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

void end_line(std::string& text, const std::string& line, std::string_view escape) {
  const std::size_t end = line.find_last_not_of(' ') + 1;
  text += fmt::format("{}{}{}\n", escape, std::string_view(line).substr(0, end), escape.empty() ? "" : "\x1b[0m");
}

}  // namespace

void TraceTable::begin(const std::string& title, std::span<const std::string_view> channels) {
  constexpr std::array<std::string_view, 3> kWays{"integer", "real", "ideal"};
  const std::size_t width = channels.size() * kColumnWidth;
  std::string names = fmt::format("{:<{}}", "", kLabelWidth + 5), ways = fmt::format("{:<{}}", title, kLabelWidth + 5);
  for (const std::string_view way : kWays) {
    ways += fmt::format("  {:>{}}", way, width);
    names += "  ";
    for (const std::string_view channel : channels) names += fmt::format("{:>{}}", channel, kColumnWidth);
  }
  text_ += '\n';
  end_line(text_, ways, colors_ ? escape_of(TraceEmphasis::result) : "");
  if (channels.size() > 1) end_line(text_, names, "");
}

void TraceTable::codes(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis,
                       const std::string& note) {
  row(label, "code", cells, emphasis, note);
}

void TraceTable::wide(const std::string& label, const TraceCells& cells, TraceEmphasis emphasis,
                      const std::string& note) {
  row(label, "wide", cells, emphasis, note);
}

void TraceTable::line(const std::string& text, TraceEmphasis emphasis) {
  end_line(text_, text, colors_ ? escape_of(emphasis) : "");
}

void TraceTable::row(const std::string& label, const char* unit, const TraceCells& cells, TraceEmphasis emphasis,
                     const std::string& note) {
  std::string line = fmt::format("  {:<{}} {}", label, kLabelWidth - 2, unit);
  const auto columns = [&](auto text_of) {
    line += "  ";
    for (const TraceCell& cell : cells) line += fmt::format("{:>{}}", text_of(cell), kColumnWidth);
  };
  columns([](const TraceCell& cell) { return held_text(cell.held); });
  columns([](const TraceCell& cell) { return real_text(cell.real); });
  columns([](const TraceCell& cell) { return real_text(cell.ideal); });
  if (!note.empty()) line += "  <- " + note;
  end_line(text_, line, colors_ ? escape_of(emphasis) : "");
}

}  // namespace ninebit::tools
