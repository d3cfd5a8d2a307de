#include "src/study/report/report_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "src/study/report/chart_axis.h"
#include "src/study/report/report_colors.h"
#include "src/study/report/report_text.h"
#include "src/system/hashing/openssl.h"
#include "src/system/quoting.h"

namespace ninebit {
namespace {

// In pixels. Widths of letters are estimates: an SVG file does not know the font that it is shown with.
constexpr double kFont = 14.0, kLetter = 0.56 * kFont, kLine = 20.0, kMargin = 24.0, kTitle = 56.0;

constexpr std::string_view kStyle =
    "text { font: 14px system-ui, \"Segoe UI\", Roboto, \"Noto Sans\", \"DejaVu Sans\", sans-serif; fill: #1d1d1b; }\n"
    ".title { font-size: 20px; font-weight: 600; }\n"
    ".tick, .caption { fill: #62605b; }\n"
    ".paper { fill: #ffffff; }\n"
    ".grid { stroke: #d5d1c8; }\n"
    ".axis { stroke: #62605b; fill: none; }\n"
    ".line { fill: none; stroke-width: 2; }\n";

double width_of(std::string_view text) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return kLetter * static_cast<double>(std::count_if(text.begin(), text.end(), begins));
}

// XML has no place for control characters and invalid UTF-8: they become the replacement character.
std::string xml_text(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const PrintablePiece piece = first_printable_piece(text, false);
    valid += text.substr(0, piece.plain);
    if (piece.foreign != 0) valid += "\uFFFD";
    text.remove_prefix(piece.plain + piece.foreign);
  }
  return escaped(valid);
}

// The text in lines of at most `width`, broken at spaces.
std::vector<std::string> lines_of(std::string_view text, double width) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (lines.empty() || width_of(lines.back()) + width_of(word) + kLetter > width) {
      lines.emplace_back(word);
    } else {
      lines.back() += ' ';
      lines.back() += word;
    }
  }
  return lines;
}

struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return bottom - top; }
};

enum class Anchor { start, middle, end };

// The elements of an SVG file.
class Svg {
 public:
  void text(double x, double y, std::string_view look, Anchor anchor, std::string_view text, int degrees = 0) {
    constexpr std::array<std::string_view, 3> kAnchors{"start", "middle", "end"};
    const std::string turn = degrees == 0 ? "" : fmt::format(" transform=\"rotate({} {:.1f} {:.1f})\"", degrees, x, y);
    inside_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", look, x, y,
                           kAnchors[static_cast<std::size_t>(anchor)], turn, xml_text(text));
  }
  void line(double x1, double y1, double x2, double y2, std::string_view look) {
    inside_ += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", look, x1, y1, x2, y2);
  }
  void box(const Box& at, std::string_view attributes) {
    inside_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", at.left, at.top,
                           at.width(), at.height(), attributes);
  }
  void picture(const Box& at, std::string_view png) {
    inside_ += fmt::format(
        "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" preserveAspectRatio=\"none\" "
        "style=\"image-rendering: pixelated\" href=\"data:image/png;base64,{}\"/>\n",
        at.left, at.top, at.width(), at.height(), base64(png));
  }
  void raw(std::string_view element) { inside_ += element; }

  // Title above, caption below; the file.
  std::string file(std::string_view title, std::string_view caption, double width, double bottom) {
    text(kMargin, kMargin + kFont, "title", Anchor::start, title);
    for (const std::string& words : lines_of(caption, width - 2.0 * kMargin)) {
      bottom += kLine;
      text(kMargin, bottom, "caption", Anchor::start, words);
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" role=\"img\" aria-label=\"{2}\">\n<style>\n{3}</style>\n<rect class=\"paper\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\"/>\n{4}</svg>\n",
        width, bottom + kMargin, xml_text(title), kStyle, inside_);
  }

 private:
  std::string inside_;
};

// Labels below an axis: turned where they are too wide to stand side by side.
struct LowerLabels {
  bool turned = false;
  double height = kLine;

  LowerLabels(const std::vector<Tick>& ticks, double room) {
    constexpr double kSine = 0.6, kTallest = 150.0;
    double widest = 0.0;
    for (const Tick& tick : ticks) widest = std::max(widest, width_of(tick.label));
    turned = ticks.size() > 1 && widest + kLetter > room / static_cast<double>(ticks.size());
    if (turned) height = std::min(kLine + kSine * widest, kTallest);
  }
};

// Every n-th label is drawn, so that they fit into the room: n.
std::size_t step_of_labels(std::size_t count, double each, double room) {
  return std::max(std::size_t{1}, static_cast<std::size_t>(std::ceil(static_cast<double>(count) * each / room)));
}

void draw_left_axis(Svg& svg, const ChartAxis& axis, const Box& field, std::string_view label, bool grid) {
  double widest = 0.0;
  const std::size_t step = step_of_labels(axis.ticks.size(), 1.3 * kFont, field.height());
  for (std::size_t i = 0; i < axis.ticks.size(); i += step) {
    const Tick& tick = axis.ticks[i];
    const double y = field.bottom - axis.share_of(tick.value) * field.height();
    svg.line(field.left - 5.0, y, grid ? field.right : field.left, y, grid ? "grid" : "axis");
    svg.text(field.left - 9.0, y + 0.35 * kFont, "tick", Anchor::end, tick.label);
    widest = std::max(widest, width_of(tick.label));
  }
  const double x = std::max(kFont + 4.0, field.left - 9.0 - widest - kLine);
  svg.text(x, (field.top + field.bottom) / 2.0, "name", Anchor::middle, label, -90);
}

// The shares of ticks below are given: those of an even plot are not its axis's. Returns the lowest line used.
double draw_lower_axis(Svg& svg, const std::vector<Tick>& ticks, const std::vector<double>& shares, const Box& field,
                       std::string_view label) {
  const LowerLabels labels(ticks, field.width());
  const std::size_t step = step_of_labels(ticks.size(), 1.3 * kFont, field.width());
  for (std::size_t i = 0; i < ticks.size(); i += step) {
    const double x = field.left + shares[i] * field.width(), y = field.bottom + kLine;
    svg.line(x, field.bottom, x, field.bottom + 5.0, "axis");
    svg.text(x, y, "tick", labels.turned ? Anchor::end : Anchor::middle, ticks[i].label, labels.turned ? -38 : 0);
  }
  const double bottom = field.bottom + labels.height + kLine;
  svg.text((field.left + field.right) / 2.0, bottom, "name", Anchor::middle, label);
  return bottom;
}

// Plots.

struct Look {
  std::string color{};
  std::size_t marker = 0;
  bool dashed = false;
};

Look look_of(std::size_t number) {
  const std::size_t colors = kSeriesColors.size();
  return {css_color(kSeriesColors[number % colors]), number % 4, number / colors % 2 == 1};
}

std::string marker(const Look& look, double x, double y) {
  switch (look.marker) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x, y, look.color);
    case 1:
      return fmt::format("<path d=\"M{:.1f} {:.1f}h7v7h-7z\" fill=\"{}\"/>\n", x - 3.5, y - 3.5, look.color);
    case 2:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 8h-9z\" fill=\"{}\"/>\n", x, y - 4.5, look.color);
    default:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 4.5l-4.5 4.5l-4.5 -4.5z\" fill=\"{}\"/>\n", x, y - 4.5,
                         look.color);
  }
}

class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot) : plot_(plot), even_(is_even(plot)), positions_(even_positions(plot)) {
    std::vector<double> ys;
    for (const PlotSeries& series : plot.series) {
      for (const auto& point : series.points) {
        if (can_be_shown(plot, point)) ys.push_back(point.second);
      }
    }
    y_ = axis_of(ys, plot.log_y, plot.bars);
    x_ = axis_of(positions_, plot.log_x && !even_, false);
    if (!even_ && !positions_.empty()) end_with_points();
  }

  std::string file() {
    constexpr double kWidth = 900.0, kHeight = 400.0, kLeft = 110.0;
    field_ = {kLeft, kTitle, kWidth - kMargin, kTitle + kHeight};
    draw_left_axis(svg_, y_, field_, plot_.y_label, true);
    std::vector<Tick> ticks = x_.ticks;
    if (even_) {
      ticks.clear();
      for (const double x : positions_) ticks.push_back({x, position_label(plot_, x)});
    }
    std::vector<double> shares;
    for (const Tick& tick : ticks) shares.push_back(x_share(tick.value));
    double bottom = draw_lower_axis(svg_, ticks, shares, field_, plot_.x_label);
    svg_.line(field_.left, field_.bottom, field_.right, field_.bottom, "axis");
    for (std::size_t i = 0; i < plot_.series.size(); ++i) plot_.bars ? draw_bars(i) : draw_line(i);
    if (plot_.series.size() > 1) bottom = draw_legend(bottom + kLine);
    return svg_.file(plot_.title, plot_.caption, kWidth, bottom + 4.0);
  }

 private:
  // The axis x ends with its points; few points of a logarithmic one are its ticks.
  void end_with_points() {
    constexpr std::size_t kFew = 12;
    if (positions_.size() < 2) return;
    x_.low = positions_.front();
    x_.high = positions_.back();
    if (x_.logarithmic && positions_.size() <= kFew) {
      x_.ticks.clear();
      for (const double x : positions_) x_.ticks.push_back({x, position_label(plot_, x)});
    }
    std::erase_if(x_.ticks, [&](const Tick& tick) { return tick.value < x_.low || tick.value > x_.high; });
  }

  [[nodiscard]] double x_share(double x) const {
    if (!even_) return x_.share_of(x);
    const auto at = std::lower_bound(positions_.begin(), positions_.end(), x) - positions_.begin();
    return (static_cast<double>(at) + 0.5) / static_cast<double>(positions_.size());
  }
  [[nodiscard]] double left_of(double x) const { return field_.left + x_share(x) * field_.width(); }
  [[nodiscard]] double top_of(double y) const { return field_.bottom - y_.share_of(y) * field_.height(); }

  void draw_bars(std::size_t number) {
    const Look look = look_of(number);
    const double group = 0.8 * field_.width() / static_cast<double>(positions_.size());
    const double width = group / static_cast<double>(plot_.series.size());
    const double ground = plot_.log_y ? field_.bottom : top_of(0.0);
    for (const auto& point : plot_.series[number].points) {
      if (!can_be_shown(plot_, point)) continue;
      const double left = left_of(point.first) - group / 2.0 + width * static_cast<double>(number);
      const double end = top_of(point.second);
      svg_.box({left, std::min(end, ground), left + 0.9 * width, std::max(end, ground)},
               fmt::format("fill=\"{}\"", look.color));
    }
  }

  void draw_line(std::size_t number) {
    constexpr std::size_t kManyPoints = 60;
    const Look look = look_of(number);
    const auto& points = plot_.series[number].points;
    std::string path, markers;
    bool gap = true;  // a point that is left out breaks the line
    for (const auto& point : points) {
      if (!can_be_shown(plot_, point)) {
        gap = true;
        continue;
      }
      const double x = left_of(point.first), y = top_of(point.second);
      path += fmt::format("{}{:.1f} {:.1f}", gap ? 'M' : 'L', x, y);
      if (points.size() <= kManyPoints) markers += marker(look, x, y);
      gap = false;
    }
    svg_.raw(fmt::format("<path class=\"line\" stroke=\"{}\"{} d=\"{}\"/>\n", look.color,
                         look.dashed ? " stroke-dasharray=\"6 5\"" : "", path));
    svg_.raw(markers);
  }

  // Rows of samples and names. Returns the lowest line used.
  double draw_legend(double y) {
    constexpr double kSample = 30.0, kGap = 10.0;
    double x = field_.left;
    for (std::size_t i = 0; i < plot_.series.size(); ++i) {
      const double width = kSample + kGap + width_of(plot_.series[i].name) + 2.0 * kGap;
      if (x + width > field_.right + kMargin && x > field_.left) {
        x = field_.left;
        y += kLine;
      }
      const Look look = look_of(i);
      const double middle = y - 0.35 * kFont;
      if (plot_.bars) {
        svg_.box({x + 9.0, middle - 6.0, x + 21.0, middle + 6.0}, fmt::format("fill=\"{}\"", look.color));
      } else {
        svg_.raw(fmt::format("<path class=\"line\" stroke=\"{}\"{} d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", look.color,
                             look.dashed ? " stroke-dasharray=\"6 5\"" : "", x, middle, kSample));
        svg_.raw(marker(look, x + kSample / 2.0, middle));
      }
      svg_.text(x + kSample + kGap, y, "series", Anchor::start, plot_.series[i].name);
      x += width;
    }
    return y;
  }

  const Plot& plot_;
  const bool even_;
  std::vector<double> positions_;
  ChartAxis x_{}, y_{};
  Box field_{};
  Svg svg_{};
};

// Heat maps.

// The ticks along a side of a map from its first to its last column or row, and the shares of the way to their middles.
struct Side {
  std::vector<Tick> ticks{};
  std::vector<double> shares{};
};

Side side_of(double first, double last, const std::vector<double>& values, int count, int most_ticks) {
  Side side;
  const auto add = [&](const Tick& tick, double place) {
    side.ticks.push_back(tick);
    side.shares.push_back((place + 0.5) / count);
  };
  if (!values.empty()) {
    for (std::size_t i = 0; i < values.size(); ++i) add({values[i], readable(values[i])}, static_cast<double>(i));
    return side;
  }
  const bool whole = first == std::floor(first) && last == std::floor(last);
  for (const Tick& tick : round_ticks(std::min(first, last), std::max(first, last), most_ticks, whole)) {
    add(tick, first == last ? 0.0 : (tick.value - first) / (last - first) * (count - 1));
  }
  return side;
}

// The colours from the low end, at the bottom, to the high one.
Image8 color_bar(const HeatMap& map) {
  constexpr int kSteps = 256;
  Image8 bar{1, kSteps, 3, {}};
  for (int i = kSteps - 1; i >= 0; --i) {
    const float share = static_cast<float>(i) / static_cast<float>(kSteps - 1);
    const Rgb color = color_of(map, map.low + (map.high - map.low) * share);
    bar.pixels.insert(bar.pixels.end(), {color.r, color.g, color.b});
  }
  return bar;
}

void draw_color_bar(Svg& svg, const HeatMap& map, const Box& bar, const std::string& png) {
  constexpr int kTicks = 6;
  svg.picture(bar, png);
  svg.box(bar, "class=\"axis\"");
  const double low = static_cast<double>(map.low), high = static_cast<double>(map.high);
  const ChartAxis axis{.low = low, .high = high > low ? high : low + 1.0};
  std::vector<Tick> ticks = round_ticks(axis.low, axis.high, kTicks, false);
  // The ends of the scale are always named; round numbers close to them are not.
  constexpr double kClose = 0.06;
  std::erase_if(ticks,
                [&](const Tick& t) { return std::fabs(std::fabs(axis.share_of(t.value) - 0.5) - 0.5) < kClose; });
  for (const double end : {axis.low, axis.high}) ticks.push_back({end, readable(end)});
  for (const Tick& tick : ticks) {
    const double y = bar.bottom - axis.share_of(tick.value) * bar.height();
    svg.line(bar.right, y, bar.right + 5.0, y, "axis");
    svg.text(bar.right + 9.0, y + 0.35 * kFont, "tick", Anchor::start, tick.label);
  }
}

}  // namespace

std::string svg_of(const Plot& plot) {
  return PlotDrawing(plot).file();
}

Result<std::string> svg_of(const HeatMap& map) {
  constexpr double kSide = 512.0, kThinnest = 48.0, kLeft = 110.0, kGap = 32.0, kBar = 20.0, kBarText = 110.0;
  constexpr int kTicks = 8;
  const auto picture = picture_of(map, static_cast<int>(kSide));
  if (!picture) return picture.error();
  const auto png = encode_png(*picture);
  if (!png) return png.error();
  const auto bar_png = encode_png(color_bar(map));
  if (!bar_png) return bar_png.error();

  Svg svg;
  const double longest = std::max(map.width, map.height);
  const double width = std::max(kThinnest, kSide * map.width / longest);
  const double height = std::max(kThinnest, kSide * map.height / longest);
  const Box field{kLeft, kTitle, kLeft + width, kTitle + height};
  svg.picture(field, *png);
  svg.box(field, "class=\"axis\"");

  const Side rows = side_of(map.y_first, map.y_last, map.y_values, map.height, kTicks);
  ChartAxis y;
  for (std::size_t i = 0; i < rows.ticks.size(); ++i) {
    y.ticks.push_back({1.0 - rows.shares[i], rows.ticks[i].label});  // the first row is on top
  }
  draw_left_axis(svg, y, field, map.y_label, false);
  const Side columns = side_of(map.x_first, map.x_last, map.x_values, map.width, kTicks);
  double bottom = draw_lower_axis(svg, columns.ticks, columns.shares, field, map.x_label);

  const double bar_left = field.right + kGap;
  draw_color_bar(svg, map, {bar_left, field.top, bar_left + kBar, std::max(field.bottom, field.top + 120.0)}, *bar_png);
  bottom = std::max(bottom, field.top + 120.0);
  if (std::any_of(map.values.begin(), map.values.end(), [](float v) { return std::isnan(v); })) {
    bottom += kLine;
    svg.box({field.left, bottom - 12.0, field.left + 12.0, bottom}, fmt::format("fill=\"{}\"", css_color(kNoValue)));
    svg.text(field.left + kLine, bottom, "series", Anchor::start, map.none);
  }
  const double total = std::max(bar_left + kBar + kBarText, kMargin * 2.0 + 1.4 * width_of(map.title));
  return svg.file(map.title, map.caption, total, bottom + 4.0);
}

}  // namespace ninebit
