// From clip-space triangles to integer triangles in the window.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace ninebit {

// A triangle ready for the tiles, counter-clockwise in the window (y up). Bounds that the integer arithmetic relies on:
// positions lie within 8,192 pixels of the viewport's centre, so differences of positions stay within 2^18 sixteenths
// of a pixel, edge functions and the area within 2^37, and edge function × depth difference within 2^61.
struct SetupTriangle {
  std::array<std::int32_t, 3> x_q4;  // window position in 1/16 pixel (less with fewer subpixel bits, scaled up)
  std::array<std::int32_t, 3> y_q4;
  std::array<std::uint32_t, 3> z24;
  std::array<float, 3> inv_w;
  std::array<std::uint8_t, 3> corner;  // which vertex of the original triangle each is (clipped ones: see weights)
  bool clipped;
  std::uint32_t weights;    // clipped: index into SetupBlock::weights
  std::uint32_t primitive;  // number of the original triangle
};

// What one block of triangles of a draw call became, in order.
struct SetupBlock {
  std::vector<SetupTriangle> triangles;
  // For each clipped triangle, its corners in barycentric coordinates of the original triangle (column = corner).
  std::vector<glm::mat3> weights;
};

struct Viewport {
  int width = 0;
  int height = 0;
  int subpixel_bits = 4;  // at most 4
};

// Appends what is to be drawn of one triangle: nothing, the triangle, or the fan of its clipped polygon. `clip` holds
// its vertices in clip coordinates. Facing is decided per piece, in the window; `cull_front` and `cull_back` drop.
void set_up_triangle(const Viewport& viewport, const std::array<glm::vec4, 3>& clip, std::uint32_t primitive,
                     bool cull_front, bool cull_back, SetupBlock& block);

}  // namespace ninebit
