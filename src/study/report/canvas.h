// Drawing on a picture with Cairo.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "ninebit/image/image_io.h"
#include "src/study/report/report_colors.h"

// Cairo's types, declared here so that only canvas.cpp includes its header.
struct _cairo;          // NOLINT(bugprone-reserved-identifier): Cairo's name
struct _cairo_surface;  // NOLINT(bugprone-reserved-identifier)

namespace ninebit {

struct Place {
  double x = 0.0, y = 0.0;  // pixels from the top left corner
};

struct TextStyle {
  double size = 20.0;  // pixels
  bool bold = false;
  Rgb color{0x22, 0x22, 0x22};
};

// The part of a text that is at its place: its beginning, middle or end.
enum class Align { begin, middle, end };

enum class Marker { circle, square, triangle, diamond };

class Canvas {
 public:
  // Starts white.
  Canvas(int width, int height);

  void line(std::span<const Place> places, Rgb color, double width, bool dashed = false);
  void box(Place corner, double width, double height, Rgb color);
  void marker(Marker shape, Place middle, Rgb color);
  // The baseline is at the place's y. `upward`: the text runs from bottom to top, and its baseline is at the place's x.
  void text(std::string_view text, Place place, Align align, const TextStyle& style, bool upward = false);
  // The width of a text in pixels.
  [[nodiscard]] double width_of(std::string_view text, const TextStyle& style);
  // The text, or as much of its beginning as fits into `width` pixels, followed by "…".
  [[nodiscard]] std::string shortened(const std::string& text, double width, const TextStyle& style);
  // Clips all drawing to this box until clip_off().
  void clip_on(Place corner, double width, double height);
  void clip_off();

  // Reports Cairo's errors.
  [[nodiscard]] Result<Image8> picture();

 private:
  void choose(const TextStyle& style);
  void ink(Rgb color);

  struct Close {
    void operator()(_cairo* context) const;
    void operator()(_cairo_surface* surface) const;
  };
  std::unique_ptr<_cairo_surface, Close> surface_;
  std::unique_ptr<_cairo, Close> context_;
};

}  // namespace ninebit
