// A slow and naive rasterizer in exact integers. Its only job is to judge the library's.
//
// It is written from the contract in rasterizer.h (snapped vertices, top-left rule, depth plane) and from chapter 4.1
// of the OpenGL 1.3 specification (fragment operations), and shares no code with what it judges: of the library's
// headers it includes pipeline_state.h alone, for the state as the question.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ninebit/raster/pipeline_state.h"

namespace ninebit::oracle {

using Bytes = std::array<std::uint8_t, 4>;  // red, green, blue, alpha

// A vertex as the rasterizer holds it after snapping.
struct WindowVertex {
  std::int64_t x_q4 = 0;
  std::int64_t y_q4 = 0;
  std::int64_t z24 = 0;
};
using WindowTriangle = std::array<WindowVertex, 3>;

// Whether the triangle draws the pixel: its centre lies inside, or on a top or left edge (y up).
[[nodiscard]] bool covers(const WindowTriangle& triangle, int px, int py);

// The triangle's depth plane at the pixel's centre, rounded to nearest, halves up. The triangle has an area.
[[nodiscard]] std::int64_t depth_at(const WindowTriangle& triangle, int px, int py);

// The colour at the pixel's centre, as a real number for each component: for triangles seen without perspective.
[[nodiscard]] std::array<double, 4> color_at(const WindowTriangle& triangle, const std::array<Bytes, 3>& colors, int px,
                                             int py);

struct DrawnTriangle {
  WindowTriangle corners;
  std::array<Bytes, 3> colors;
  std::uint32_t number = 0;
};

// All planes of a target, row by row, the lowest row first.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Bytes> color;
  std::vector<std::uint32_t> depth_z24;
  std::vector<std::uint8_t> stencil;
  std::vector<std::uint32_t> primitive;
  std::vector<int>
      captured;  // the red of the last fragment that would pass the depth test; as it was, if there is none
};

// What became of the fragments.
struct Tally {
  std::uint64_t fragments = 0;
  std::uint64_t alpha_fail = 0;
  std::uint64_t stencil_fail = 0;
  std::uint64_t depth_fail = 0;
  std::uint64_t drawn = 0;
};

// Draws in order. The state's program is not looked at: a fragment has its triangle's colour, by the state's shade
// model.
void draw(const PipelineState& state, const std::vector<DrawnTriangle>& triangles, Picture& picture, Tally& tally);

}  // namespace ninebit::oracle
