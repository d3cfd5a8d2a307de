// Triangles of one tile in the form that vectors draw: edge functions and depth planes, several triangles at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/raster/setup/coverage_samples.h"
#include "src/raster/setup/triangle_edges.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/surface/tile_size.h"

namespace ninebit {

// Depth in vectors is a fixed-point number with 32 fraction bits and an error of less than kDepthDoubt units of the
// last one. Where the fraction is nearer than that to a whole number, the exact plane has to be evaluated.
inline constexpr std::uint32_t kDepthDoubt = std::uint32_t{1} << 16;

// Several triangles, each in its region: the part of its box that lies in the tile. Functions are given by their value
// at the region's origin, its lower left pixel, and their steps from pixel to pixel.
struct TileTriangles {
  static constexpr std::size_t kMost = 16;
  template <class T>
  using Each = std::array<T, kMost>;

  // The region's pixels, both ends included.
  alignas(64) Each<std::int32_t> left, right, bottom, top;
  // Coverage: a pixel is inside where no value is negative. Unless is_narrow, an edge that has all of the region (of a
  // smoothed triangle: with its samples) inside has zeros.
  alignas(64) std::array<Each<std::int32_t>, 3> inside, inside_x, inside_y;
  // `inside` + threshold is the edge function.
  alignas(64) std::array<Each<std::int32_t>, 3> threshold;
  // Coverage in floats, for which a product and a sum are one operation. Where has_floats, they are exact for all of
  // the region's vectors; else they are meaningless.
  alignas(64) std::array<Each<float>, 3> float_inside, float_inside_x, float_inside_y;
  // Depth + the triangle's fraction with 32 fraction bits, and its steps. Zeros, whose fraction is in doubt, where only
  // the exact plane is good enough.
  alignas(64) Each<std::int64_t> depth, depth_x, depth_y;
  Each<bool> is_narrow;                       // true if the edge functions of all of the region's vectors fit 32 bits
  alignas(64) Each<std::int32_t> has_floats;  // not 0 if true
  std::array<Each<double>, 3> edge, edge_x, edge_y;  // the edge functions themselves, for those that are not narrow

  [[nodiscard]] bool has_region(std::size_t k) const { return left[k] <= right[k] && bottom[k] <= top[k]; }

  // Sets everything but the region, which is given, for a triangle of any size. False if it covers no pixel. `smooth`:
  // it covers the pixels that have any coverage sample inside (rule 47).
  bool place(std::size_t k, const SetupPrimitive& p, bool smooth = false);
};

// z = z0 + (e1 (z1 - z0) + e2 (z2 - z0)) / area + the triangle's fraction, the steps likewise; with 1/2 in place of the
// fraction for triangles of one depth, which is a whole number. Products of steps and depths are exact in doubles; each
// other operation has a relative error of a few 2^-53. Within these limits the error of the sum is below 2^-18 at every
// pixel of a tile. As numbers with 32 fraction bits the origin and the steps are cut, or rounded by some targets: less
// than 140 more units of the last bit, where kDepthDoubt has room for 2^16 and that error takes 2^14.
inline constexpr double kFractionUnit = 1.0 / (1 << kOffsetBits);
inline constexpr double kSteepestDepth = 0x1p24, kFarthestDepth = 64.0, kHighestDepth = 0x1p29, kDepthOne = 0x1p32;

inline bool TileTriangles::place(std::size_t k, const SetupPrimitive& p, bool smooth) {
  const TriangleEdges edges(p);
  const std::array<std::int64_t, 3> e = edges.at(left[k], bottom[k]);
  const std::int64_t columns = right[k] - left[k], rows = top[k] - bottom[k];
  constexpr std::int64_t kNarrow = std::int64_t{1} << 30, kFloats = std::int64_t{1} << 24;
  is_narrow[k] = true;
  has_floats[k] = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t across = edges.step_x(i) * columns, up = edges.step_y(i) * rows;
    threshold[i][k] = edges.threshold(i);
    const std::int64_t at_origin = e[i] - threshold[i][k];
    const std::int64_t steps = std::abs(edges.step_x(i)) + std::abs(edges.step_y(i));
    const std::int64_t reach = smooth ? steps * kCoverageReach_q4 / 16 : 0;  // of samples around a centre
    if (at_origin + std::max<std::int64_t>(across, 0) + std::max<std::int64_t>(up, 0) + reach < 0) return false;
    // Vectors reach a few pixels beyond the region.
    const std::int64_t farthest = std::abs(at_origin) + 2 * kTileSize * steps;
    const bool fits = farthest < kNarrow;
    const bool crosses = at_origin + std::min<std::int64_t>(across, 0) + std::min<std::int64_t>(up, 0) - reach < 0;
    is_narrow[k] = is_narrow[k] && fits;
    if (farthest >= kFloats) has_floats[k] = 0;
    inside[i][k] = crosses || fits ? static_cast<std::int32_t>(at_origin) : 0;
    inside_x[i][k] = crosses || fits ? static_cast<std::int32_t>(edges.step_x(i)) : 0;
    inside_y[i][k] = crosses || fits ? static_cast<std::int32_t>(edges.step_y(i)) : 0;
    float_inside[i][k] = static_cast<float>(inside[i][k]);
    float_inside_x[i][k] = static_cast<float>(inside_x[i][k]);
    float_inside_y[i][k] = static_cast<float>(inside_y[i][k]);
    edge[i][k] = static_cast<double>(e[i]);
    edge_x[i][k] = static_cast<double>(edges.step_x(i));
    edge_y[i][k] = static_cast<double>(edges.step_y(i));
  }
  const double scale = edges.inverse_area();
  const double z0 = p.z24[0], dz1 = p.z24[1] - z0, dz2 = p.z24[2] - z0;
  const double fraction = dz1 == 0.0 && dz2 == 0.0 ? 0.5 : p.fraction * kFractionUnit;
  const double slope_x = (edge_x[1][k] * dz1 + edge_x[2][k] * dz2) * scale;
  const double slope_y = (edge_y[1][k] * dz1 + edge_y[2][k] * dz2) * scale;
  const double origin = z0 + (edge[1][k] * dz1 + edge[2][k] * dz2) * scale + fraction;
  const bool is_sure = std::fabs(slope_x) <= kSteepestDepth && std::fabs(slope_y) <= kSteepestDepth &&
                       (std::fabs(edge[1][k]) + std::fabs(edge[2][k])) * scale <= kFarthestDepth &&
                       std::fabs(origin) <= kHighestDepth;
  const auto fixed = [is_sure](double v) { return is_sure ? static_cast<std::int64_t>(v * kDepthOne) : 0; };
  depth[k] = fixed(origin);
  depth_x[k] = fixed(slope_x);
  depth_y[k] = fixed(slope_y);
  return true;
}

}  // namespace ninebit
