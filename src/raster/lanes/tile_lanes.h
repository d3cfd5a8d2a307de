// Triangles drawn into one tile by vectors of fragments, with the results of tile.cpp, which draws one fragment after
// the other.
//
// Why so, and not otherwise: a triangle of an index map covers few pixels, and the programs that run on them are short.
// What costs is everything between: finding the pixels, their depths, and filling vectors. So a pass is drawn in one of
// four ways (`Drawing` in primitive_draw.h), chosen once for all its triangles:
//
// - nearest, noted, flat: one colour a triangle and no program. Vectors are written into the tile at once; `noted`
//   keeps the number of the triangle that left each depth (pixel_owners.h), so that a later pass for equal depth
//   compares numbers instead of depths.
// - gathers: fragments of many triangles fill a batch (lane_fragments.h), as combiners run over hundreds of fragments
//   at a time. No two fragments of a batch share a pixel: a batch may then be drawn in any order of its vectors.
//
// The steps, each in its file: triangles of a block are placed in the tile several at a time, as 32-bit edge functions
// and depth planes relative to the tile (tile_triangles-inl.h); slim ones are drawn with two or four rows in a vector,
// or one with AVX2 (lane_rows-inl.h), others row by row (lane_triangle-inl.h; smoothed ones: lane_smooth-inl.h);
// fragments of lines and points are found one by one (lane_lines-inl.h); fragments that pass the tests that can be made
// early are pushed into the batch (lane_gather-inl.h); a full batch is interpolated, textured, combined and stored
// (lane_batch.cpp).
//
// Exactness: coverage is decided by whole numbers, which are the edge functions or have their signs. Depth is a
// fixed-point number whose error has a proven bound; within the bound of a whole number the exact plane of 64 bits is
// evaluated (lane_depth-inl.h). Weights are floats in the order of operations of the scalar code. So a tile's contents
// do not depend on the target, on the order of batches, or on tile.cpp being used instead. Tests compare all of them.
//
// Passes that draw the same triangles share their fragments (fragment_reuse.h), which holds the proof.
// What vectors do not draw, lanes_can_draw() lists: lines and points of one colour, output planes. tile.cpp draws
// those.
#pragma once

#include <cstdint>
#include <span>

#include "src/raster/fragment/draw_context.h"
#include "src/raster/lanes/fragment_reuse.h"
#include "src/raster/lanes/lane_pass.h"
#include "src/raster/lanes/pixel_owners.h"
#include "src/raster/lanes/tile_planes.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// One thread's tile, which passes draw into one after the other: large.
struct LaneTile {
  LaneTile(const RenderTarget& target, const TileContents& contents) : planes(target, contents) {}

  TilePlanes planes;
  FarthestDepths farthest;
  PixelOwners owners;
  FragmentReuse fragments;
};

// True if vectors can draw all of a draw.
[[nodiscard]] bool lanes_can_draw(const DrawContext& context, const RenderTarget& target);

// Starts a pass over the primitives of a tile. A pass that repeats fragments draws them here.
void begin_pass(LaneTile& tile, const LanePass& pass);

// Draws triangles of one block; the block must stay until the batch is flushed.
void draw_lanes(LaneTile& tile, const LanePass& pass, const SetupBlock& block, std::span<const std::uint32_t> indices);

// Draws the fragments that have been gathered, and starts the next batch.
void flush_lanes(LaneTile& tile, const LanePass& pass);

}  // namespace ninebit
