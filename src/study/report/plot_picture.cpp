#include "src/study/report/plot_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/study/report/canvas.h"
#include "src/study/report/plot_axis.h"

namespace ninebit {
namespace {

constexpr int kWidth = 1280, kHeight = 800;
constexpr double kMargin = 36.0;
constexpr double kWidestLegend = 460.0;
constexpr std::size_t kMostMarkers = 60;  // a series with more points has no markers
constexpr std::size_t kMostBarLabels = 16;
constexpr Rgb kGrid{0xe4, 0xe4, 0xe4}, kFineGrid{0xf2, 0xf2, 0xf2}, kFrame{0x66, 0x66, 0x66};
const TextStyle kTitle{26.0, true}, kLabel{20.0}, kTickText{18.0, false, {0x44, 0x44, 0x44}},
    kNameText{13.5, false, {0x44, 0x44, 0x44}};

// The look of a series: its colour, and its markers and dashes for readers who do not see colours.
struct SeriesLook {
  Rgb color;
  Marker marker = Marker::circle;
  bool dashed = false;
};

SeriesLook look_of(std::size_t series) {
  constexpr std::array kMarkers{Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  return {kSeriesColors[series % kSeriesColors.size()], kMarkers[series % kMarkers.size()],
          series / kSeriesColors.size() % 2 == 1};
}

// The area within the axes.
struct Frame {
  Axis x, y;
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;

  [[nodiscard]] Place at(double x_share, double y_share) const {
    return {left + x_share * (right - left), bottom - y_share * (bottom - top)};
  }
};

class PlotPainter {
 public:
  explicit PlotPainter(const Plot& plot) : plot_(plot), canvas_(kWidth, kHeight) {}

  Result<Image8> paint() {
    lay_out();
    draw_axes();
    canvas_.clip_on({frame_.left - 8.0, frame_.top - 8.0}, frame_.right - frame_.left + 16.0,
                    frame_.bottom - frame_.top + 16.0);
    if (plot_.bars) {
      draw_bars();
    } else {
      for (std::size_t s = 0; s < plot_.series.size(); ++s) draw_line(s);
    }
    canvas_.clip_off();
    label_bars();
    draw_legend();
    return canvas_.picture();
  }

 private:
  void lay_out() {
    std::vector<double> xs, ys;
    for (const PlotSeries& series : plot_.series) {
      for (const auto& point : series.points) {
        if (!can_be_shown(plot_, point)) continue;
        xs.push_back(point.first);
        ys.push_back(point.second);
      }
    }
    empty_ = xs.empty();
    frame_.y = plot_.log_y ? logarithmic_axis(ys, 8) : linear_axis(ys, 7, plot_.bars);
    if (plot_.bars) {
      groups_ = bar_groups(plot_);
    } else {
      frame_.x = plot_.log_x ? logarithmic_axis(xs, 10) : linear_axis(xs, 10, false);
    }
    double widest = 0.0;
    for (const Tick& tick : frame_.y.ticks) widest = std::max(widest, canvas_.width_of(tick.label, kTickText));
    frame_.left = kMargin + (plot_.y_label.empty() ? 0.0 : 34.0) + widest + 14.0;
    if (plot_.series.size() > 1) lay_out_legend();
    frame_.right = kWidth - kMargin - (legend_width_ > 0.0 ? legend_width_ + 28.0 : 0.0);
    frame_.top = plot_.title.empty() ? kMargin : 92.0;
    frame_.bottom = kHeight - kMargin - (plot_.x_label.empty() ? 34.0 : 74.0);
  }

  // Uses smaller letters if names are long or many.
  void lay_out_legend() {
    const auto widest = [this] {
      double width = 0.0;
      for (const PlotSeries& series : plot_.series) width = std::max(width, canvas_.width_of(series.name, legend_));
      return width + 52.0;
    };
    legend_width_ = widest();
    if (legend_width_ > 340.0 || plot_.series.size() > 20) {
      legend_.size = 15.0;
      row_height_ = 24.0;
      legend_width_ = std::min(widest(), kWidestLegend);
    }
  }

  void draw_axes() {
    canvas_.text(canvas_.shortened(plot_.title, kWidth - 2.0 * kMargin, kTitle), {kMargin, 56.0}, Align::begin, kTitle);
    // Labelled grid lines are drawn over the others.
    for (const bool labelled : {false, true}) {
      for (const Tick& tick : frame_.y.ticks) {
        if (tick.label.empty() != labelled)
          grid_line(frame_.at(0.0, frame_.y.place(tick.value)), frame_.at(1.0, frame_.y.place(tick.value)), labelled);
      }
      for (const Tick& tick : frame_.x.ticks) {
        if (tick.label.empty() != labelled)
          grid_line(frame_.at(frame_.x.place(tick.value), 0.0), frame_.at(frame_.x.place(tick.value), 1.0), labelled);
      }
    }
    for (const Tick& tick : frame_.y.ticks) {
      const Place place = frame_.at(0.0, frame_.y.place(tick.value));
      canvas_.text(tick.label, {place.x - 12.0, place.y + 6.5}, Align::end, kTickText);
    }
    for (const Tick& tick : frame_.x.ticks) x_tick_label(frame_.x.place(tick.value), tick.label);
    const std::array corner{frame_.at(0.0, 1.0), frame_.at(0.0, 0.0), frame_.at(1.0, 0.0)};
    canvas_.line(corner, kFrame, 1.5);
    canvas_.text(plot_.x_label, {(frame_.left + frame_.right) / 2.0, kHeight - kMargin}, Align::middle, kLabel);
    canvas_.text(plot_.y_label, {kMargin + 16.0, (frame_.top + frame_.bottom) / 2.0}, Align::middle, kLabel, true);
    if (empty_) {
      canvas_.text("no values", {(frame_.left + frame_.right) / 2.0, (frame_.top + frame_.bottom) / 2.0}, Align::middle,
                   kLabel);
    }
  }

  void grid_line(Place from, Place to, bool labelled) {
    canvas_.line(std::array{from, to}, labelled ? kGrid : kFineGrid, 1.0);
  }

  void x_tick_label(double share, const std::string& label, const TextStyle& style = kTickText) {
    const Place place = frame_.at(share, 0.0);
    canvas_.text(label, {place.x, place.y + 27.0}, Align::middle, style);
  }

  void draw_line(std::size_t number) {
    const SeriesLook look = look_of(number);
    std::vector<Place> places;
    for (const auto& point : plot_.series[number].points) {
      if (!can_be_shown(plot_, point)) continue;
      places.push_back(frame_.at(frame_.x.place(point.first), frame_.y.place(point.second)));
    }
    canvas_.line(places, look.color, 3.0, look.dashed);
    if (places.size() > kMostMarkers) return;
    for (const Place& place : places) canvas_.marker(look.marker, place, look.color);
  }

  // Draws a group of bars at each x, one bar per series, from 0 or from the bottom of a logarithmic axis.
  void draw_bars() {
    const double group = 1.0 / static_cast<double>(std::max<std::size_t>(groups_.size(), 1));
    const double bar = 0.8 * group / static_cast<double>(std::max<std::size_t>(plot_.series.size(), 1));
    const double base = plot_.log_y ? 0.0 : frame_.y.place(0.0);
    for (std::size_t s = 0; s < plot_.series.size(); ++s) {
      for (const auto& point : plot_.series[s].points) {
        if (!can_be_shown(plot_, point)) continue;
        const auto at = std::lower_bound(groups_.begin(), groups_.end(), point.first) - groups_.begin();
        const double left = (static_cast<double>(at) + 0.1) * group + static_cast<double>(s) * bar;
        const double end = frame_.y.place(point.second);
        const Place low = frame_.at(left, std::min(base, end)), high = frame_.at(left + bar, std::max(base, end));
        const double gap = std::min(1.0, (high.x - low.x) / 8.0);
        canvas_.box({low.x + gap, high.y}, high.x - low.x - 2.0 * gap, low.y - high.y, look_of(s).color);
      }
    }
    if (base > 0.0) canvas_.line(std::array{frame_.at(0.0, base), frame_.at(1.0, base)}, kFrame, 1.5);
  }

  void label_bars() {
    const double group = 1.0 / static_cast<double>(std::max<std::size_t>(groups_.size(), 1));
    const std::size_t every = (groups_.size() + kMostBarLabels - 1) / kMostBarLabels;
    for (std::size_t i = 0; i < groups_.size(); i += every) {
      const TextStyle& style = plot_.x_names.empty() ? kTickText : kNameText;
      const double room = group * static_cast<double>(every) * (frame_.right - frame_.left) - 6.0;
      x_tick_label((static_cast<double>(i) + 0.5) * group, canvas_.shortened(bar_label(plot_, groups_[i]), room, style),
                   style);
    }
  }

  void draw_legend() {
    if (legend_width_ == 0.0) return;
    const double left = frame_.right + 28.0;
    const auto room = static_cast<std::size_t>((frame_.bottom - frame_.top) / row_height_);
    const std::size_t all = plot_.series.size(), shown = all <= room ? all : room - 1;
    for (std::size_t s = 0; s < shown; ++s) {
      const SeriesLook look = look_of(s);
      const double y = frame_.top + 8.0 + static_cast<double>(s) * row_height_;
      if (plot_.bars) {
        canvas_.box({left + 8.0, y - 9.0}, 22.0, 18.0, look.color);
      } else {
        canvas_.line(std::array{Place{left + 2.0, y}, Place{left + 36.0, y}}, look.color, 3.0, look.dashed);
        canvas_.marker(look.marker, {left + 19.0, y}, look.color);
      }
      canvas_.text(canvas_.shortened(plot_.series[s].name, legend_width_ - 50.0, legend_), {left + 48.0, y + 6.0},
                   Align::begin, legend_);
    }
    if (shown < all) {
      canvas_.text(fmt::format("and {} more", all - shown),
                   {left, frame_.top + 14.0 + static_cast<double>(shown) * row_height_}, Align::begin, legend_);
    }
  }

  const Plot& plot_;
  Canvas canvas_;
  Frame frame_;
  std::vector<double> groups_;  // the positions of bars
  TextStyle legend_{18.0};
  double row_height_ = 30.0;
  double legend_width_ = 0.0;  // 0: no legend
  bool empty_ = false;
};

}  // namespace

bool can_be_shown(const Plot& plot, const std::pair<double, double>& point) {
  constexpr double kGreatest = 1e150;  // keeps the lengths of axes finite
  if (!(std::fabs(point.first) < kGreatest) || !(std::fabs(point.second) < kGreatest)) return false;
  return (!plot.log_x || plot.bars || point.first > 1.0 / kGreatest) && (!plot.log_y || point.second > 1.0 / kGreatest);
}

std::string bar_label(const Plot& plot, double x) {
  const bool named = x >= 1.0 && x <= static_cast<double>(plot.x_names.size());
  return named ? plot.x_names[static_cast<std::size_t>(x) - 1] : text_of(x);
}

std::vector<double> bar_groups(const Plot& plot) {
  std::vector<double> groups;
  for (const PlotSeries& series : plot.series) {
    for (const auto& point : series.points) {
      if (can_be_shown(plot, point)) groups.push_back(point.first);
    }
  }
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

Result<Image8> picture_of(const Plot& plot) {
  return PlotPainter(plot).paint();
}

}  // namespace ninebit
