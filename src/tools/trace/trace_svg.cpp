#include "src/tools/trace/trace_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "src/page/diagram_page.h"
#include "src/system/quoting.h"
#include "src/tools/input/host.h"

namespace ninebit::tools {
namespace {

// In pixels. A letter of a monospaced font is 0.6 times as wide as high.
constexpr double kFont = 13.0, kLetter = 0.6 * kFont;
constexpr int kLine = 18, kInside = 14, kGap = 28, kMargin = 24, kSwatch = 40;

constexpr std::string_view kStyle =
    "text { font: 13px ui-monospace, \"SF Mono\", \"Cascadia Mono\", Menlo, Consolas, \"DejaVu Sans Mono\", "
    "monospace;\n"
    "  fill: #1d1d1b; white-space: pre; }\n"
    ".result { font-weight: 700; }\n"
    ".loss { fill: #8a5a00; font-weight: 700; }\n"
    ".cut { fill: #b3261e; font-weight: 700; }\n"
    ".paper { fill: #ffffff; }\n"
    ".box { fill: #fcfbf9; stroke: #b9a9d6; stroke-width: 1.5; }\n"
    ".head { fill: #f1f5ee; stroke: #9cb38a; stroke-width: 1.5; }\n"
    ".out { stroke: #1d1d1b; }\n"
    ".wire { stroke: #62605b; stroke-width: 2; fill: none; }\n";

struct SvgLine {
  std::string text{};
  std::string_view look{};  // its class
};

struct SvgPart {
  std::vector<SvgLine> lines{};
  [[nodiscard]] int width() const {
    int columns = 0;
    for (const SvgLine& line : lines) columns = std::max(columns, width_of(line.text));
    return static_cast<int>(columns * kLetter) + 2 * kInside;
  }
  [[nodiscard]] int height() const { return static_cast<int>(lines.size()) * kLine + 2 * kInside; }
};

// The escapes of a terminal's line become the name of a look.
SvgLine line_of(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kLooks{
      {{"\x1b[1m", "result"}, {"\x1b[33m", "loss"}, {"\x1b[31m", "cut"}}};
  constexpr std::string_view kEnd = "\x1b[0m";
  SvgLine line;
  for (const auto& [escape, look] : kLooks) {
    if (!text.starts_with(escape)) continue;
    text.erase(0, escape.size());
    line.look = look;
  }
  if (text.ends_with(kEnd)) text.erase(text.size() - kEnd.size());
  line.text = std::move(text);
  return line;
}

std::vector<SvgPart> parts_of(std::string_view text) {
  std::vector<SvgPart> parts(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    SvgLine line = line_of(std::string(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.text.empty()) {
      parts.back().lines.push_back(std::move(line));
    } else if (!parts.back().lines.empty()) {
      parts.emplace_back();
    }
  }
  if (parts.size() > 1 && parts.back().lines.empty()) parts.pop_back();
  return parts;
}

// Takes the lines of texture-shader stages out of the fragment's part, wrapped ones whole.
std::vector<std::string> stage_lines_of(SvgPart& fragment) {
  std::vector<std::string> stages;
  std::vector<SvgLine> others;
  bool is_inside = false;  // a stage's line, which may go on in the next one
  for (SvgLine& line : fragment.lines) {
    const bool is_stage = line.text.starts_with("  texture stage ");
    is_inside = is_stage || (is_inside && line.text.starts_with("    "));
    if (is_stage) {
      stages.push_back(line.text.substr(2));
    } else if (is_inside) {
      stages.back() += ' ' + line.text.substr(line.text.find_first_not_of(' '));
    } else {
      others.push_back(std::move(line));
    }
  }
  fragment.lines = std::move(others);
  return stages;
}

// The texture-shader stages, a part a stage, with a line for each value.
std::vector<SvgPart> texture_stages_of(SvgPart& fragment) {
  std::vector<SvgPart> stages;
  for (const std::string& line : stage_lines_of(fragment)) {
    // "texture stage 1: dot_product by stage 0, s, t, r, q = (0, 0, 1, 0), dot product 1 with (0, 0, 1), texel (0, 0,
    // 0, 0)".
    std::string_view rest = line;
    SvgPart& stage = stages.emplace_back();
    const auto add = [&](std::string_view text) {
      const bool is_title = stage.lines.empty();
      stage.lines.push_back({(is_title ? "" : "  ") + std::string(text), is_title ? "result" : ""});
    };
    for (const std::string_view next :
         {", s, t, r, q = ", ", dot product ", ", texture read at ", ", texel ", ", codes "}) {
      const std::size_t end = rest.find(next);
      if (end == std::string_view::npos) continue;
      add(rest.substr(0, end));
      rest.remove_prefix(end + 2);
    }
    add(rest);
  }
  return stages;
}

// "stage 0" of "stage 0, RGB portion".
std::string_view combiner_of(const SvgPart& part) {
  const std::string_view title = part.lines.empty() ? std::string_view() : part.lines[0].text;
  return title.substr(0, title.find(','));
}

std::string box_of(const SvgPart& part, int x, int y, int width, std::string_view look) {
  std::string out = fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"8\"/>\n", look, x,
                                y, width, part.height());
  for (std::size_t i = 0; i < part.lines.size(); ++i) {
    const SvgLine& line = part.lines[i];
    const int base = y + kInside + static_cast<int>(i) * kLine + static_cast<int>(kFont);
    out += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\" xml:space=\"preserve\">{}</text>\n", line.look,
                       x + kInside, base, escaped_markup(line.text));
  }
  return out;
}

std::string arrow(int from, int to, int y) {
  return fmt::format("<path class=\"wire\" d=\"M{0} {1}H{2}M{3} {4}L{2} {1}L{3} {5}\"/>\n", from + 4, y, to - 4,
                     to - 10, y - 5, y + 5);
}

// Columns of parts, from left to right: the fragment and its registers, with its texture-shader stages between the two
// if it has some; each combiner; the result below the last.
std::vector<std::vector<SvgPart>> columns_of(std::vector<SvgPart> parts, bool has_result) {
  constexpr std::size_t kRegisters = 1;
  std::vector<SvgPart> stages = texture_stages_of(parts[0]);
  const bool has_stages = !stages.empty();
  std::vector<std::vector<SvgPart>> columns(1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_result = has_result && i + 1 == parts.size();
    const bool is_beside =
        i == kRegisters ? has_stages
                        : i > kRegisters && !is_result && combiner_of(parts[i]) != combiner_of(columns.back().back());
    if (i == kRegisters && has_stages) columns.push_back(std::move(stages));
    if (is_beside) columns.emplace_back();
    columns.back().push_back(std::move(parts[i]));
  }
  return columns;
}

}  // namespace

std::string trace_svg(const std::string& text, const std::optional<std::array<std::uint8_t, 4>>& bytes) {
  const auto columns = columns_of(parts_of(text), bytes.has_value());
  std::string inside;
  int x = kMargin, lowest = 0;
  for (const std::vector<SvgPart>& column : columns) {
    const bool is_first = &column == &columns.front();
    int y = kMargin, width = 0;
    for (const SvgPart& part : column) width = std::max(width, part.width());
    if (!is_first) inside += arrow(x - kGap, x, kMargin + kGap);
    for (const SvgPart& part : column) {
      inside += box_of(part, x, y, width, is_first && y == kMargin ? "head" : "box");
      y += part.height() + kGap;
    }
    lowest = std::max(lowest, y - kGap);
    if (bytes && &column == &columns.back()) {
      const int side = column.back().height() - 2 * kInside;
      inside +=
          fmt::format("<rect class=\"out\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"rgb({},{},{})\"/>\n",
                      x + width - kInside - kSwatch, y - kGap - kInside - side, kSwatch, side, (*bytes)[0], (*bytes)[1],
                      (*bytes)[2]);
    }
    x += width + kGap;
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<style>\n{2}</style>\n<rect class=\"paper\" width=\"{0}\" height=\"{1}\"/>\n{3}</svg>\n",
      x - kGap + kMargin, lowest + kMargin, kStyle, inside);
}

}  // namespace ninebit::tools
