// A slow and naive rasterizer in exact integers. Its only job is to judge the library's.
//
// It is written from the contract in rasterizer.h (snapped vertices, top-left rule, depth planes, how polygons are
// cut) and from chapters 2.6.1 and 3.3 to 3.5 of the OpenGL 1.3 specification, and shares no code with what it judges:
// of the library's headers it includes pipeline_state.h and surface.h alone, for the state and formats as the question.
// raster_oracle_fragment.h follows a fragment further.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "combiner_tests/oracle/raster_oracle_fragment.h"
#include "ninebit/raster/pipeline_state.h"

namespace ninebit::oracle {

// A vertex as the rasterizer holds it after snapping: depth in 24 bits, the format's codes and fraction bits; or the
// number z or w, in formats that hold numbers.
struct WindowVertex {
  std::int64_t x_q4 = 0;
  std::int64_t y_q4 = 0;
  std::int64_t z24 = 0;
  double number = 0;
};
using WindowTriangle = std::array<WindowVertex, 3>;
using WindowLine = std::array<WindowVertex, 2>;

// Whether the triangle draws the pixel: its centre lies inside, or on a top or left edge (y up).
[[nodiscard]] bool covers(const WindowTriangle& triangle, int px, int py);

// The same for a place of the window in 1/16 pixel instead of a centre.
[[nodiscard]] bool covers_place(const WindowTriangle& triangle, std::int64_t x_q4, std::int64_t y_q4);

// Where the NV2A looks whether a pixel of a smoothed primitive is covered: sample i of eight lies i/8 of a pixel to the
// right of its upper left corner and (3 i mod 8)/8 below it. In 1/16 pixel, y up.
struct Place {
  std::int64_t x_q4 = 0;
  std::int64_t y_q4 = 0;
};
[[nodiscard]] Place coverage_place(int px, int py, int i);

// The triangle's depth plane at the pixel's centre, cut, or rounded to nearest, halves up. The triangle has an area.
[[nodiscard]] std::int64_t depth_at(const WindowTriangle& triangle, int px, int py, bool is_cut = true);
[[nodiscard]] std::int64_t depth_at_place(const WindowTriangle& triangle, const Place& place, bool is_cut = true);

// The shares of the corners at the pixel's centre, without those below 0, and their depth.
struct Within {
  std::array<long double, 3> share{};
  std::int64_t depth_sum = 0, parts = 1;  // the depth is their quotient
};
[[nodiscard]] Within nearest_within(const WindowTriangle& triangle, int px, int py);

// The diamond-exit rule for a line of width 1: whether the line, its ends moved by (-e, -e²), meets the open diamond of
// the pixel and does not end in it.
[[nodiscard]] bool exits_diamond(const WindowLine& line, int px, int py);

// Whether a line of the NV2A draws the pixel: its centre lies in the rectangle with the corners P ± h, Q ± h, where h
// is perpendicular to the line and |h| is half the width × (max(|dx|, |dy|) + min(|dx|, |dy|) / 2) / its length.
// Centres on the sides of a level or upright line follow the top-left rule; of other lines the sides to the right have
// them. `width` is in eighths of a pixel.
[[nodiscard]] bool rectangle_covers(const WindowLine& line, int width, int px, int py);
[[nodiscard]] bool rectangle_covers_place(const WindowLine& line, int width, const Place& place);

// Whether a point of the NV2A draws the pixel: its centre lies in the square around the position, or on its left or top
// side; unless the size is a power of two, also on another side. Without size, the pixel that holds the position has
// it. `size` is in eighths of a pixel.
[[nodiscard]] bool square_covers(const WindowVertex& position, int size, int px, int py);

// How far along the line the pixel's centre lies, as the fraction along / squared_length, clamped to [0, 1].
struct Along {
  std::int64_t along = 0;
  std::int64_t squared_length = 1;
};
[[nodiscard]] Along along_line(const WindowLine& line, int px, int py);

// A triangle's polygon offset in 1/65536 of a step of 24 bits, rounded to nearest, halves up; or, unless its fraction
// is kept, in whole steps.
[[nodiscard]] std::int64_t polygon_offset(const PolygonOffset& offset, const HardwareProfile& profile,
                                          DepthStencilFormat format, const WindowTriangle& triangle);

// The NV2A's other depth formats hold numbers: z, or w, whole or with 4 or 8 bits of exponent. `is_w` and
// `exponent_bits` are false and 0 where codes are steps of window depth.
struct NumberFormat {
  bool is_w = false;
  int exponent_bits = 0;
  [[nodiscard]] bool has_numbers() const { return is_w || exponent_bits > 0; }
};
[[nodiscard]] NumberFormat number_format(DepthStencilFormat format);
// The number that is all ones in a format of so many bits.
[[nodiscard]] double largest_number(int bits, int exponent_bits);
// The mean of z with these shares, which add up to 1; or w, of which 1/w is linear in the window.
template <std::size_t Count>
[[nodiscard]] double number_of(const std::array<WindowVertex, Count>& v, const std::array<long double, Count>& share,
                               bool is_w) {
  long double sum = 0;
  for (std::size_t i = 0; i < Count; ++i) sum += is_w ? share[i] / v[i].number : share[i] * v[i].number;
  return static_cast<double>(is_w ? 1 / sum : sum);
}
// The shares of the corners at the pixel's centre.
[[nodiscard]] std::array<long double, 3> shares_at(const WindowTriangle& triangle, int px, int py);
// The offset in numbers: bias + scale × slope, the slope of w being that at the first corner; the nearest float.
[[nodiscard]] double number_offset(const PolygonOffset& offset, OffsetSlope slope, const WindowTriangle& triangle,
                                   bool is_w);
// The code of a number: whole, or 4 or 8 bits of exponent (bias 7 or 127) above the mantissa; cut, or to nearest. Too
// large a number is all ones.
[[nodiscard]] std::uint32_t number_code(int bits, int exponent_bits, double number, bool is_cut = true);

// GL's primitive types by their GL numbers, GL_POINTS being 0.
enum class Primitive {
  points,
  lines,
  line_loop,
  line_strip,
  triangles,
  triangle_strip,
  triangle_fan,
  quads,
  quad_strip,
  polygon
};

struct DrawnVertex {
  WindowVertex position;
  Bytes color{255, 255, 255, 255};
};

// One draw call: the vertices in the order of the list.
struct DrawCall {
  Primitive type = Primitive::triangles;
  std::vector<DrawnVertex> vertices{};
  std::vector<Bytes> primitive_colors{};  // or none
};

// Draws in order, within viewport and scissor. The state's program is not looked at: a fragment has its primitive's
// colour, by the state's shade model (smooth colours as without perspective).
void draw(const PipelineState& state, const DrawCall& call, Picture& picture, Tally& tally);

// GL's clear of the planes that are named, of colour, depth (a code) and stencil.
struct Clear {
  bool clears_color = true, clears_depth = true, clears_stencil = true;
  Bytes color{};
  std::uint32_t depth = 0;
  std::uint8_t stencil = 0;
};
void clear(const PipelineState& state, const Clear& values, Picture& picture);

}  // namespace ninebit::oracle
