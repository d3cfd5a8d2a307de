#include "src/study/report/canvas.h"

#include <cairo.h>

#include <array>
#include <cstring>
#include <new>
#include <numbers>

#include "src/system/memory.h"

namespace ninebit {
namespace {

// The memory that fontconfig needs for its settings and fonts, with a margin. It crashes with less.
constexpr std::uint64_t kRoomForFonts = std::uint64_t{8} << 20U;

_cairo_surface* make_surface(int width, int height) {
  if (!posix::has_room(kRoomForFonts)) throw std::bad_alloc();
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
}

}  // namespace

void Canvas::Close::operator()(_cairo* context) const {
  cairo_destroy(context);
}

void Canvas::Close::operator()(_cairo_surface* surface) const {
  cairo_surface_destroy(surface);
}

Canvas::Canvas(int width, int height) : surface_(make_surface(width, height)), context_(cairo_create(surface_.get())) {
  // Makes glyphs independent of the machine's screen settings.
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  ink({255, 255, 255});
  cairo_paint(context_.get());
}

void Canvas::ink(Rgb color) {
  cairo_set_source_rgb(context_.get(), color.r / 255.0, color.g / 255.0, color.b / 255.0);
}

void Canvas::line(std::span<const Place> places, Rgb color, double width, bool dashed) {
  if (places.empty()) return;
  constexpr std::array kDashes{9.0, 8.0};
  ink(color);
  cairo_set_line_width(context_.get(), width);
  cairo_set_dash(context_.get(), kDashes.data(), dashed ? static_cast<int>(kDashes.size()) : 0, 0.0);
  cairo_move_to(context_.get(), places.front().x, places.front().y);
  for (const Place& place : places.subspan(1)) cairo_line_to(context_.get(), place.x, place.y);
  cairo_stroke(context_.get());
}

void Canvas::box(Place corner, double width, double height, Rgb color) {
  ink(color);
  cairo_rectangle(context_.get(), corner.x, corner.y, width, height);
  cairo_fill(context_.get());
}

void Canvas::marker(Marker shape, Place middle, Rgb color) {
  constexpr double kReach = 6.0;
  cairo_t* const c = context_.get();
  const auto polygon = [&](std::initializer_list<Place> corners) {
    for (const Place& corner : corners) cairo_line_to(c, middle.x + corner.x * kReach, middle.y + corner.y * kReach);
    cairo_close_path(c);
  };
  ink(color);
  cairo_new_path(c);
  switch (shape) {
    case Marker::circle:
      cairo_arc(c, middle.x, middle.y, 0.95 * kReach, 0.0, 2.0 * std::numbers::pi);
      break;
    case Marker::square:
      polygon({{-0.85, -0.85}, {0.85, -0.85}, {0.85, 0.85}, {-0.85, 0.85}});
      break;
    case Marker::triangle:
      polygon({{0.0, -1.15}, {1.1, 0.8}, {-1.1, 0.8}});
      break;
    case Marker::diamond:
      polygon({{0.0, -1.2}, {1.2, 0.0}, {0.0, 1.2}, {-1.2, 0.0}});
      break;
  }
  cairo_fill(c);
}

void Canvas::choose(const TextStyle& style) {
  cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), style.size);
}

void Canvas::text(std::string_view text, Place place, Align align, const TextStyle& style, bool upward) {
  const double width = align == Align::begin ? 0.0 : width_of(text, style);
  choose(style);
  ink(style.color);
  cairo_save(context_.get());
  cairo_translate(context_.get(), place.x, place.y);
  if (upward) cairo_rotate(context_.get(), -std::numbers::pi / 2.0);
  cairo_move_to(context_.get(), align == Align::middle ? -width / 2.0 : -width, 0.0);
  cairo_show_text(context_.get(), std::string(text).c_str());
  cairo_restore(context_.get());
}

double Canvas::width_of(std::string_view text, const TextStyle& style) {
  choose(style);
  cairo_text_extents_t extents{};
  cairo_text_extents(context_.get(), std::string(text).c_str(), &extents);
  return extents.x_advance;
}

std::string Canvas::shortened(const std::string& text, double width, const TextStyle& style) {
  std::string fitting = text;
  while (!fitting.empty() && width_of(fitting == text ? text : fitting + "…", style) > width) {
    // Removes whole UTF-8 characters: continuation bytes go with their first byte.
    while (fitting.size() > 1 && (static_cast<unsigned char>(fitting.back()) & 0xC0U) == 0x80U) fitting.pop_back();
    fitting.pop_back();
  }
  return fitting == text ? text : fitting + "…";
}

void Canvas::clip_on(Place corner, double width, double height) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), corner.x, corner.y, width, height);
  cairo_clip(context_.get());
}

void Canvas::clip_off() {
  cairo_restore(context_.get());
}

Result<Image8> Canvas::picture() {
  cairo_surface_flush(surface_.get());
  if (const cairo_status_t status = cairo_status(context_.get()); status != CAIRO_STATUS_SUCCESS) {
    if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
    return Diagnostic{std::string("a plot could not be drawn: ") + cairo_status_to_string(status)};
  }
  Image8 image{cairo_image_surface_get_width(surface_.get()), cairo_image_surface_get_height(surface_.get()), 3, {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  const unsigned char* const top = cairo_image_surface_get_data(surface_.get());
  for (int y = 0; y < image.height; ++y) {
    const unsigned char* const row = top + std::ptrdiff_t{y} * cairo_image_surface_get_stride(surface_.get());
    for (std::ptrdiff_t x = 0; x < image.width; ++x) {
      std::uint32_t pixel = 0;  // 0x00RRGGBB in native byte order
      std::memcpy(&pixel, row + x * 4, sizeof(pixel));
      image.pixels.insert(image.pixels.end(),
                          {static_cast<std::uint8_t>(pixel >> 16U & 0xFFU),
                           static_cast<std::uint8_t>(pixel >> 8U & 0xFFU), static_cast<std::uint8_t>(pixel & 0xFFU)});
    }
  }
  return image;
}

}  // namespace ninebit
