// Rows of measured lines and points, drawn in a window that is large enough for each of them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/surface.h"
#include "src/tools/verify/measured_rows.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

constexpr int kSide = 256;  // of the window, in pixels

// Window corners in 1/16 pixel, y growing downwards.
struct Corner {
  int x, y;
};

// Corners that a table states in pixels; they were written with three digits.
std::vector<Corner> corners_of(const std::vector<double>& pixels) {
  std::vector<Corner> corners;
  const auto q4 = [](double pixel) { return static_cast<int>(std::lround(16.0 * pixel)); };
  for (std::size_t i = 0; i + 1 < pixels.size(); i += 2) corners.push_back({q4(pixels[i]), q4(pixels[i + 1])});
  return corners;
}

// The fault of corners that do not fit the window; empty: none.
std::string wrong_spread(std::span<const Corner> corners, double width) {
  for (int Corner::*const coordinate : {&Corner::x, &Corner::y}) {
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), [=](const Corner& a, const Corner& b) {
      return a.*coordinate < b.*coordinate;
    });
    const double spread = ((*high).*coordinate - (*low).*coordinate) / 16.0 + 2.0 * width;
    if (!(spread <= kSide)) {
      return fmt::format("the lines are too long or too wide; expected at most {} pixels with twice their width",
                         kSide);
    }
  }
  return "";
}

// The pixel halfway between the least and the greatest coordinate.
int middle_of(std::span<const Corner> corners, int Corner::*coordinate) {
  const auto [low, high] = std::minmax_element(
      corners.begin(), corners.end(), [=](const Corner& a, const Corner& b) { return a.*coordinate < b.*coordinate; });
  return ((*low).*coordinate + (*high).*coordinate) / 32;
}

// A window of the picture around the corners, and what is drawn into it; a thread has one at a time.
class MeasuredWindow {
 public:
  explicit MeasuredWindow(std::span<const Corner> corners) : surface_(cleared()) {
    left_ = middle_of(corners, &Corner::x) - kSide / 2;
    top_ = middle_of(corners, &Corner::y) - kSide / 2;
    for (const Corner& c : corners) {
      clip_.emplace_back(clip_of(c.x - 16 * left_), clip_of(16 * (top_ + kSide) - c.y), 0.0F, 1.0F);
    }
  }

  // Draws white, or with the corners' colours.
  void draw(const PipelineState& state, PrimitiveType type, std::span<const ColorBytes> colors = {}) {
    RenderTarget target = surface_.target();
    const VertexArrays arrays{.type = type, .homogeneous_positions = clip_, .vertex_colors = colors};
    // A row with a size that the rasterizer refuses draws nothing.
    is_drawn_ = rasterize(state, glm::mat4(1.0F), arrays, {}, target).ok();
  }

  [[nodiscard]] bool covers(int x, int y) const {
    return is_drawn_ && is_inside(x, y) && surface_.primitive()[at(x, y)] != kUntouched;
  }
  [[nodiscard]] int component(int x, int y, int k) const { return covers(x, y) ? surface_.color(k)[at(x, y)] : 0; }
  // The columns of the window.
  [[nodiscard]] int left() const { return left_; }
  [[nodiscard]] int right() const { return left_ + kSide; }

 private:
  static constexpr std::uint32_t kUntouched = 0xFFFFFFFF;

  // One for all rows of a thread: to get its memory from the system takes longer than to draw a row.
  static Surface& cleared() {
    thread_local Surface surface = Surface::make(kSide, kSide, {.with_primitive = true}).value();
    surface.fill({});
    return surface;
  }
  // The clip coordinate in the middle of the cell that is cut to this window coordinate.
  static float clip_of(int q4) { return static_cast<float>((q4 + (q4 < 0 ? -0.5 : 0.5)) / (8.0 * kSide) - 1.0); }
  [[nodiscard]] bool is_inside(int x, int y) const {
    return x >= left_ && x < left_ + kSide && y >= top_ && y < top_ + kSide;
  }
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(kSide * (top_ + kSide - 1 - y) + x - left_);
  }

  int left_ = 0, top_ = 0;
  bool is_drawn_ = false;
  std::vector<glm::vec4> clip_;
  Surface& surface_;
};

std::array<Corner, 2> ends_of(const MeasuredRow& row) {
  return {{{row.whole("Px"), row.whole("Py")}, {row.whole("Qx"), row.whole("Qy")}}};
}

// The pixels of a row of an object of lines that are drawn and not measured, or measured and not drawn.
std::vector<int> draw_lines(const MeasuredRow& row, const HardwareProfile& profile) {
  const bool is_quad = row.text("object") == "quad";
  MeasuredWindow window(corners_of(row.list(row.text("object"))));
  PipelineState state = plain_state(profile);
  state.line_width = static_cast<float>(row.real("width"));
  state.front_mode = state.back_mode = PolygonMode::line;
  window.draw(state, is_quad ? PrimitiveType::quads : PrimitiveType::line_loop);
  const std::vector<PixelRun> runs = pixel_runs(row.text("hw_runs")).value();
  int differ = 0;
  for (int x = window.left(); x < window.right(); ++x) {
    const auto holds = [x](const PixelRun& run) { return run.first <= x && x <= run.last; };
    const bool is_measured = std::any_of(runs.begin(), runs.end(), holds);
    differ += window.covers(x, row.whole("y")) != is_measured ? 1 : 0;
  }
  return {differ};
}

std::string wrong_line_color(const MeasuredRow& row, const HardwareProfile& /*profile*/) {
  return wrong_spread(ends_of(row), row.real("width"));
}

// A pixel of a line with two colours.
std::vector<int> draw_line_color(const MeasuredRow& row, const HardwareProfile& profile) {
  const std::array<Corner, 2> ends = ends_of(row);
  const std::array<ColorBytes, 2> colors{color_of(row.digits("c0")), color_of(row.digits("c1"))};
  MeasuredWindow window(ends);
  PipelineState state = plain_state(profile);
  state.line_width = static_cast<float>(row.real("width"));
  window.draw(state, PrimitiveType::lines, colors);
  const int x = row.whole("x"), y = row.whole("y");
  return {window.component(x, y, kRed), window.component(x, y, kGreen), window.component(x, y, kBlue)};
}

// The first and the last column of a point at a corner of pixels, from there.
std::vector<int> draw_point(const MeasuredRow& row, const HardwareProfile& profile) {
  const std::array<Corner, 1> place{{{0, 0}}};
  MeasuredWindow window(place);
  PipelineState state = plain_state(profile);
  state.point_size = static_cast<float>(row.whole("size_eighths")) / 8.0F;
  window.draw(state, PrimitiveType::points);
  // A column is drawn if the point has a pixel there, above the position or below.
  std::vector<int> extent{kNothingDrawn, kNothingDrawn};
  for (int x = window.left(); x < window.right(); ++x) {
    if (!window.covers(x, 0) && !window.covers(x, -1)) continue;
    if (extent[0] == kNothingDrawn) extent[0] = x;
    extent[1] = x;
  }
  return extent;
}

std::string wrong_lines(const MeasuredRow& row, const HardwareProfile& /*profile*/) {
  const std::string& object = row.text("object");
  if (object != "quad" && object != "loop") {
    return fmt::format("object must be one of quad, loop, not '{}'", shown(object));
  }
  if (row.has(object)) return wrong_spread(corners_of(row.list(object)), row.real("width"));
  return fmt::format(
      "the comments do not state the corners of the {0}; expected a comment such as # {0}: (160,398) "
      "(220,388) …",
      object);
}

// Lines: their width in pixels, and corners in window coordinates, y growing downwards.
constexpr StatedValue kLineWidth{"width", "Line_", StatedValue::Kind::real, 0, 64, "16"},
    kQuadCorners{"quad",
                 "quad = PRIMITIVE_QUADS in polygon mode LINE, corners ",
                 StatedValue::Kind::list,
                 0,
                 4095,
                 "(160,398) (220,388) (218.5,473.375) (172.75,455.5)",
                 8,
                 true},
    kLoopCorners{
        "loop", "loop = LINE_LOOP through ", StatedValue::Kind::list, 0, 4095, "(356,95) (354,67) (342,145)", 0, true};

}  // namespace

std::vector<MeasuredFormat> make_line_formats() {
  const Column note{}, word{{}, Kind::word}, digits{{}, Kind::digits}, real{{}, Kind::real},
      measured{{}, Kind::measured}, match{{}, Kind::match}, position = whole({}, -100'000, 100'000),
                                                            pixel = whole({}, 0, 4095);
  return {
      {"lines",
       columns({{"picture", note},
                {"width", real},
                {"object", word},
                {"y", pixel},
                {"hw_runs", {{}, Kind::runs}},
                {"model_runs", note},
                {"match", match}}),
       draw_lines,
       wrong_lines,
       {kQuadCorners, kLoopCorners}},
      {"colours of lines",
       columns({{"Px,Py,Qx,Qy", position},
                {"c0,c1", digits},
                {"x,y", pixel},
                {"hw_R,hw_G,hw_B", measured},
                {"model_R,model_G,model_B", note},
                {"match", match}}),
       draw_line_color,
       wrong_line_color,
       {kLineWidth}},
      {"points",
       columns({{"picture", note},
                {"size_eighths", whole({}, 0, 512)},
                {"hw_first,hw_last", {{}, Kind::extent}},
                {"model_first,model_last", note},
                {"match", match}}),
       draw_point},
  };
}

}  // namespace ninebit::tools
