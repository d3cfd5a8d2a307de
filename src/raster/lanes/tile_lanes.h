// Triangles drawn into one tile by vectors of fragments, with the results of tile.cpp, which draws one fragment after
// the other.
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
