#include "src/tools/compare/compare_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "src/tools/compare/lettering.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

using Ink = std::array<std::uint8_t, 3>;

constexpr Ink kBlack{29, 29, 27}, kQuiet{98, 96, 91};
constexpr std::uint8_t kPaper = 255, kEmpty = 236;
constexpr int kLeastWidth = 360;  // of a picture on the sheet, so that its caption fits
constexpr int kLettersInWidth = 42;
constexpr int kMostSide = 16384;  // of a PNG
constexpr std::int64_t kMostSheetPixels = std::int64_t{1} << 27;
constexpr double kSlide = 16.0 / 9.0;
constexpr int kMostNameLines = 3, kCountLines = 4, kHeadLines = 2, kFootLines = 1;

// Where things are on the sheet, in pixels.
struct SheetPlan {
  int columns = 1, rows = 1;
  int enlarged = 1;               // width and height in pixels of a pixel of a picture
  int width = 0, height = 0;      // of a picture on the sheet
  int gap = 0;                    // around pictures
  double cell = 0.0, line = 0.0;  // of letters
  int pictures = 2;               // one below the other: the colours, and the wrong pixels
  int name_lines = 1;
  int head = 0, foot = 0;  // heights

  [[nodiscard]] int lines(int count) const { return static_cast<int>(std::ceil(count * line)); }
  [[nodiscard]] int step_x() const { return width + gap; }
  [[nodiscard]] int step_y() const {
    return lines(name_lines) + pictures * height + (pictures - 1) * gap / 2 + lines(kCountLines) + gap;
  }
  [[nodiscard]] std::int64_t sheet_width() const { return gap + std::int64_t{columns} * step_x(); }
  [[nodiscard]] std::int64_t sheet_height() const { return head + std::int64_t{rows} * step_y() + foot; }
};

// The number of columns whose sheet is nearest to a slide's shape, and has few empty places.
SheetPlan plan_of(const Comparison& comparison) {
  SheetPlan plan;
  plan.enlarged = std::max(1, (kLeastWidth + comparison.width - 1) / comparison.width);
  plan.width = plan.enlarged * comparison.width;
  plan.height = plan.enlarged * comparison.height;
  plan.gap = std::max(12, plan.width / 24);
  plan.cell = static_cast<double>(plan.width) / (kLettersInWidth * kLetterCells);
  plan.line = kLineCells * plan.cell;
  for (const ComparedPoint& point : comparison.compared.points) {
    const std::string name = wrapped(printable(point.name), kLettersInWidth);
    const auto lines = 1 + static_cast<int>(std::count(name.begin(), name.end(), '\n'));
    plan.name_lines = std::min(std::max(plan.name_lines, lines), kMostNameLines);
  }
  plan.head = plan.gap + plan.lines(kHeadLines) + plan.gap;
  plan.foot = plan.lines(kFootLines) + plan.gap;
  const int count = static_cast<int>(comparison.compared.points.size());
  double best = std::numeric_limits<double>::infinity();
  SheetPlan chosen = plan;
  for (int columns = 1; columns <= count; ++columns) {
    plan.columns = columns;
    plan.rows = (count + columns - 1) / columns;
    const double shape = static_cast<double>(plan.sheet_width()) / static_cast<double>(plan.sheet_height());
    // Empty places count as much as a shape that is off by their share.
    const double off = std::abs(std::log(shape / kSlide)) + static_cast<double>(columns * plan.rows - count) / count;
    if (off >= best) continue;
    best = off;
    chosen = plan;
  }
  return chosen;
}

// Digits in groups of three: "72,912".
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

class Sheet {
 public:
  explicit Sheet(const SheetPlan& plan) : plan_(plan) {
    image_ = {static_cast<int>(plan.sheet_width()), static_cast<int>(plan.sheet_height()), 3, {}};
    image_.pixels.assign(static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height) * 3, kPaper);
  }

  // Lines that fit the width; more than `most` end in an ellipsis.
  void text(int x, int y, const std::string& words, int width, int most, const Ink& ink, bool is_bold) {
    const double advance = kLetterCells * plan_.cell;
    std::string rest = wrapped(words, std::max(1, static_cast<int>(width / advance)));
    for (int i = 0; i < most && !rest.empty(); ++i) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      std::string line = rest.substr(0, end);
      rest.erase(0, end + 1);
      if (i + 1 == most && !rest.empty()) line += " …";
      draw_text(image_, x, y + i * plan_.line, line, {.cell = plan_.cell, .ink = ink, .is_bold = is_bold});
    }
  }

  // A picture, enlarged; an empty one is a grey area.
  void picture(int left, int top, const Image8& from) {
    const auto width = static_cast<std::size_t>(image_.width);
    for (int y = 0; y < plan_.height; ++y) {
      for (int x = 0; x < plan_.width; ++x) {
        const auto to = 3 * (static_cast<std::size_t>(top + y) * width + static_cast<std::size_t>(left + x));
        const auto at = static_cast<std::size_t>((y / plan_.enlarged) * from.width + x / plan_.enlarged) * 3;
        for (std::size_t c = 0; c < 3; ++c) image_.pixels[to + c] = from.pixels.empty() ? kEmpty : from.pixels[at + c];
      }
    }
  }

  Image8 image_{};

 private:
  const SheetPlan& plan_;
};

// "12 wrong pixels, 1.2 % of the scene", the two kinds, and the causes.
std::string counts_of(const ComparedRow& row) {
  if (!row.errors) return "no shadows drawn";
  const ComparedErrors& errors = *row.errors;
  const std::uint64_t wrong = errors.false_lit + errors.false_shadowed;
  const double scene = static_cast<double>(std::max<std::uint64_t>(1, row.lit + row.shadowed));
  std::string text =
      fmt::format("{} wrong pixels, {:.2f} % of the scene", grouped(wrong), 100.0 * static_cast<double>(wrong) / scene);
  if (wrong == 0) return text;
  text +=
      fmt::format("\n{} falsely lit, {} falsely shadowed\n", grouped(errors.false_lit), grouped(errors.false_shadowed));
  const char* comma = "";
  for (const auto& [cause, count] : errors.by_cause) {
    if (count == 0) continue;
    text += fmt::format("{}{} {}", comma, cause, grouped(count));
    comma = ", ";
  }
  return text;
}

void draw_row(Sheet& sheet, const SheetPlan& plan, const ComparedPoint& point, const ComparedRow& row, int x, int y) {
  sheet.text(x, y, printable(point.name), plan.width, plan.name_lines, kBlack, true);
  y += plan.lines(plan.name_lines);
  sheet.picture(x, y, row.picture);
  if (!row.refused.empty()) {
    const int inside = plan.gap / 2, fitting = std::max(1, static_cast<int>((plan.height - inside) / plan.line));
    sheet.text(x + inside, y + inside, "not drawn: " + printable(row.refused), plan.width - 2 * inside, fitting, kQuiet,
               false);
    return;
  }
  y += plan.height + plan.gap / 2;
  if (row.errors) {
    sheet.picture(x, y, row.error_picture);
    y += plan.height;
  }
  const int below = y + static_cast<int>(plan.line / 3);
  sheet.text(x, below, counts_of(row), plan.width, kCountLines, kBlack, false);
}

}  // namespace

Status check_sheet(const Comparison& comparison) {
  const SheetPlan plan = plan_of(comparison);
  const std::int64_t width = plan.sheet_width(), height = plan.sheet_height();
  if (width <= kMostSide && height <= kMostSide && width * height <= kMostSheetPixels) return {};
  return Diagnostic{.message = fmt::format("--sheet: {} × {} pixels; expected at most {} a side and {} in all: fewer "
                                           "pictures or a smaller --size",
                                           width, height, kMostSide, kMostSheetPixels)};
}

Image8 compare_sheet(const CompareFlags& flags, const Comparison& comparison) {
  const SheetPlan plan = plan_of(comparison);
  Sheet sheet(plan);
  const int across = static_cast<int>(plan.sheet_width()) - 2 * plan.gap;
  const std::string scene = printable(std::filesystem::path(flags.scene.file).filename().string());
  const bool is_varied = !flags.vary.empty();
  sheet.text(plan.gap, plan.gap, fmt::format("{}: {} side by side", scene, is_varied ? "settings" : "techniques"),
             across, 1, kBlack, true);
  const std::string enlarged = plan.enlarged == 1 ? "" : fmt::format(", shown {} times as large", plan.enlarged);
  sheet.text(plan.gap, plan.gap + plan.lines(1),
             fmt::format("{}; {} triangles; {} × {} pixels{}", comparison.light, grouped(comparison.triangles),
                         comparison.width, comparison.height, enlarged),
             across, 1, kQuiet, false);
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const int column = static_cast<int>(i) % plan.columns, line = static_cast<int>(i) / plan.columns;
    draw_row(sheet, plan, comparison.compared.points[i], comparison.rows[i], plan.gap + column * plan.step_x(),
             plan.head + line * plan.step_y());
  }
  sheet.text(plan.gap, static_cast<int>(plan.sheet_height()) - plan.foot,
             "Orange: lit, but in shadow by ray casting. Blue: the reverse. ninebit " NINEBIT_VERSION, across,
             kFootLines, kQuiet, false);
  return std::move(sheet.image_);
}

}  // namespace ninebit::tools
