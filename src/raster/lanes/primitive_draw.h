// The state that all fragments of one primitive in a tile share.
#pragma once

#include <array>
#include <cstdint>

#include "src/raster/lanes/lane_pass.h"
#include "src/raster/lanes/tile_lanes.h"
#include "src/raster/setup/primitive_depth.h"
#include "src/raster/setup/triangle_edges.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// The ways of drawing a triangle's fragments.
enum class Drawing {
  nearest,  // LanePass::draws_nearest_alone
  noted,    // the same, and notes_owners
  flat,     // one colour, through the fragment operations
  gathers   // into the batch
};

constexpr bool is_nearest(Drawing drawing) {
  return drawing == Drawing::nearest || drawing == Drawing::noted;
}

// Depths in real numbers on a triangle, with its edge functions at the centre of pixel (0, 0) and their steps.
struct TriangleRealDepth {
  explicit TriangleRealDepth(const SetupPrimitive& p) : TriangleRealDepth(p, TriangleEdges(p)) {}
  RealDepth depth;
  std::array<double, 3> edge, edge_x, edge_y;

 private:
  TriangleRealDepth(const SetupPrimitive& p, const TriangleEdges& edges) : depth(p, edges.area()) {
    const std::array<std::int64_t, 3> origin = edges.at(0, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      edge[i] = static_cast<double>(origin[i]);
      edge_x[i] = static_cast<double>(edges.step_x(i));
      edge_y[i] = static_cast<double>(edges.step_y(i));
    }
  }
};

struct PrimitiveDraw {
  LaneTile& tile;
  const LanePass& pass;
  const SetupPrimitive& primitive;
  const SetupBlock& block;
  const SetupCorners* corners;  // null for a flat result
  std::uint32_t number;         // see PixelOwners
  std::uint32_t color = 0;      // of a flat result, as it is stored unless it is blended
  std::uint32_t alpha = 0;      // of a flat result: the whole one, which tests read
};

// The same in a format of real numbers.
struct RealPrimitiveDraw : PrimitiveDraw {
  explicit RealPrimitiveDraw(const PrimitiveDraw& draw) : PrimitiveDraw(draw), real(draw.primitive) {}
  TriangleRealDepth real;
};

}  // namespace ninebit
