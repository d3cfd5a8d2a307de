// A triangle's edge functions and depth plane as the vectors of one tile need them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "src/raster/setup_primitive.h"
#include "src/raster/triangle_edges.h"
#include "src/raster/window_transform.h"

namespace ninebit {

// Depth in vectors is a fixed-point number with 32 fraction bits, which carries an error of less than kDepthDoubt of
// them: where the fraction is nearer than that to a whole number, the exact plane has to be asked.
inline constexpr std::uint32_t kDepthDoubt = std::uint32_t{1} << 16;

// What the region of a tile that a triangle may draw needs, from the origin on: the left end of the first vector of its
// lowest row.
struct TileTriangle {
  // False: nothing is drawn.
  bool place(const TriangleEdges& edges, const SetupPrimitive& t, const PixelBounds& pixels, int first_column);

  int left = 0, right = 0, bottom = 0, top = 0;  // of the pixels, both ends included
  int origin_x = 0;
  // Coverage: a pixel is inside where no value is negative. An edge that no pixel of the region can be outside of has
  // zeros, unless is_narrow.
  std::array<std::int32_t, 3> inside{}, inside_x{}, inside_y{};
  // Whether `inside` + threshold is the edge function at each pixel of the region's vectors.
  bool is_narrow = false;
  std::array<std::int32_t, 3> threshold{};
  // The edge functions themselves, at the origin, and their steps.
  std::array<double, 3> edge{}, edge_x{}, edge_y{};
  // Depth; or only the exact plane will do.
  bool is_depth_exact_only = false;
  std::int64_t depth = 0, depth_x = 0, depth_y = 0;
};

inline bool TileTriangle::place(const TriangleEdges& edges, const SetupPrimitive& t, const PixelBounds& pixels,
                                int first_column) {
  left = pixels.left;
  right = pixels.right;
  bottom = pixels.bottom;
  top = pixels.top;
  origin_x = first_column;
  const std::array<std::int64_t, 3> e = edges.at(origin_x, bottom);
  const std::int64_t columns = right - origin_x, rows = top - bottom;
  is_narrow = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t across = edges.step_x(i) * columns, up = edges.step_y(i) * rows;
    threshold[i] = edges.threshold(i);
    const std::int64_t at_origin = e[i] - threshold[i];
    const std::int64_t largest = at_origin + (across > 0 ? across : 0) + (up > 0 ? up : 0);
    if (largest < 0) return false;
    // The vectors reach a few columns beyond the region.
    constexpr std::int64_t kLimit = std::int64_t{1} << 30;
    const std::int64_t reach = std::llabs(at_origin) + 64 * (std::llabs(edges.step_x(i)) + std::llabs(edges.step_y(i)));
    if (reach >= kLimit) is_narrow = false;
    const std::int64_t smallest = at_origin + (across < 0 ? across : 0) + (up < 0 ? up : 0);
    const bool crosses = smallest < 0 || reach < kLimit;
    inside[i] = crosses ? static_cast<std::int32_t>(at_origin) : 0;
    inside_x[i] = crosses ? static_cast<std::int32_t>(edges.step_x(i)) : 0;
    inside_y[i] = crosses ? static_cast<std::int32_t>(edges.step_y(i)) : 0;
    edge[i] = static_cast<double>(e[i]);
    edge_x[i] = static_cast<double>(edges.step_x(i));
    edge_y[i] = static_cast<double>(edges.step_y(i));
  }
  // z = z0 + (e1 (z1 - z0) + e2 (z2 - z0)) / area + 1/2, the steps likewise. Products of steps and depths are exact in
  // doubles, and each of the others below is off by a few 2^-53 of itself: within these limits the sum is good to 2^-18
  // at every pixel of a tile.
  const double scale = edges.inverse_area();
  const double z0 = t.z24[0], dz1 = t.z24[1] - z0, dz2 = t.z24[2] - z0;
  const double slope_x = (edge_x[1] * dz1 + edge_x[2] * dz2) * scale;
  const double slope_y = (edge_y[1] * dz1 + edge_y[2] * dz2) * scale;
  const double origin = z0 + (edge[1] * dz1 + edge[2] * dz2) * scale + 0.5;
  constexpr double kSteepest = 0x1p24, kFarthest = 64.0, kHighest = 0x1p29, kOne = 0x1p32;
  is_depth_exact_only = !(std::fabs(slope_x) <= kSteepest && std::fabs(slope_y) <= kSteepest &&
                          (std::fabs(edge[1]) + std::fabs(edge[2])) * scale <= kFarthest && std::fabs(origin) <= kHighest);
  if (is_depth_exact_only) return true;
  depth = static_cast<std::int64_t>(origin * kOne);
  depth_x = static_cast<std::int64_t>(slope_x * kOne);
  depth_y = static_cast<std::int64_t>(slope_y * kOne);
  return true;
}

}  // namespace ninebit
