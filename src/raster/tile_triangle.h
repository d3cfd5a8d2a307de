// A triangle's edge functions and depth plane as the vectors of one tile need them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "src/raster/setup_primitive.h"
#include "src/raster/tile_size.h"
#include "src/raster/triangle_edges.h"

namespace ninebit {

// Depth in vectors is a fixed-point number with 32 fraction bits, which carries an error of less than kDepthDoubt of
// them: where the fraction is nearer than that to a whole number, the exact plane has to be asked.
inline constexpr std::uint32_t kDepthDoubt = std::uint32_t{1} << 16;

// What the region of a tile that a triangle may draw needs, from the origin on: the left end of the first vector of its
// lowest row.
struct TileTriangle {
  // Fills in what follows the region; false: nothing is drawn. `p` is the triangle.
  bool place(const SetupPrimitive& p);
  // The depth plane from 1 / area and, of edges 1 and 2, functions at the origin and steps.
  void place_depth(const SetupPrimitive& p, double inverse_area, double edge1, double edge2, double x1, double x2,
                   double y1, double y2);

  int left, right, bottom, top;  // the region's pixels, both ends included
  int origin_x;
  // Coverage: a pixel is inside where no value is negative. An edge that no pixel of the region can be outside of has
  // zeros, unless is_narrow. (Four lanes, the last without meaning.)
  alignas(16) std::array<std::int32_t, 4> inside, inside_x, inside_y;
  // Whether `inside` + threshold is the edge function at each pixel of the region's vectors.
  bool is_narrow;
  alignas(16) std::array<std::int32_t, 4> threshold;
  // Unless is_narrow, the edge functions themselves, at the origin, and their steps.
  std::array<double, 3> edge, edge_x, edge_y;
  // Depth with 32 fraction bits, and 1/2; or only the exact plane will do.
  bool is_depth_exact_only;
  double depth, depth_x, depth_y;
};

// z = z0 + (e1 (z1 - z0) + e2 (z2 - z0)) / area + 1/2, the steps likewise. Products of steps and depths are exact in
// doubles, and each of the others below is off by a few 2^-53 of itself: within these limits the sum is good to 2^-18 at
// every pixel of a tile.
inline void TileTriangle::place_depth(const SetupPrimitive& p, double inverse_area, double edge1, double edge2,
                                      double x1, double x2, double y1, double y2) {
  constexpr double kSteepest = 0x1p24, kFarthest = 64.0, kHighest = 0x1p29, kOne = 0x1p32;
  const double z0 = p.z24[0], dz1 = p.z24[1] - z0, dz2 = p.z24[2] - z0;
  const double slope_x = (x1 * dz1 + x2 * dz2) * inverse_area;
  const double slope_y = (y1 * dz1 + y2 * dz2) * inverse_area;
  const double at_origin = z0 + (edge1 * dz1 + edge2 * dz2) * inverse_area + 0.5;
  is_depth_exact_only = !(std::fabs(slope_x) <= kSteepest && std::fabs(slope_y) <= kSteepest &&
                          (std::fabs(edge1) + std::fabs(edge2)) * inverse_area <= kFarthest &&
                          std::fabs(at_origin) <= kHighest);
  const double one = is_depth_exact_only ? 0.0 : kOne;
  depth = at_origin * one;
  depth_x = slope_x * one;
  depth_y = slope_y * one;
}

inline bool TileTriangle::place(const SetupPrimitive& p) {
  const TriangleEdges edges(p);
  const std::array<std::int64_t, 3> e = edges.at(origin_x, bottom);
  const std::int64_t columns = right - origin_x, rows = top - bottom;
  constexpr std::int64_t kNarrow = std::int64_t{1} << 30;
  is_narrow = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t across = edges.step_x(i) * columns, up = edges.step_y(i) * rows;
    threshold[i] = edges.threshold(i);
    const std::int64_t at_origin = e[i] - threshold[i];
    if (at_origin + std::max<std::int64_t>(across, 0) + std::max<std::int64_t>(up, 0) < 0) return false;
    // Vectors reach beyond the region, but not beyond the tile.
    const std::int64_t steps = std::abs(edges.step_x(i)) + std::abs(edges.step_y(i));
    const bool fits = std::abs(at_origin) + kTileSize * steps < kNarrow;
    const bool crosses = at_origin + std::min<std::int64_t>(across, 0) + std::min<std::int64_t>(up, 0) < 0;
    is_narrow = is_narrow && fits;
    inside[i] = crosses || fits ? static_cast<std::int32_t>(at_origin) : 0;
    inside_x[i] = crosses || fits ? static_cast<std::int32_t>(edges.step_x(i)) : 0;
    inside_y[i] = crosses || fits ? static_cast<std::int32_t>(edges.step_y(i)) : 0;
    edge[i] = static_cast<double>(e[i]);
    edge_x[i] = static_cast<double>(edges.step_x(i));
    edge_y[i] = static_cast<double>(edges.step_y(i));
  }
  place_depth(p, edges.inverse_area(), edge[1], edge[2], edge_x[1], edge_x[2], edge_y[1], edge_y[2]);
  return true;
}

}  // namespace ninebit
