// Triangles drawn into one tile by vectors of fragments: what tile.cpp does with one fragment after the other, with the
// same result.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "src/raster/draw_context.h"
#include "src/raster/lane_batch.h"
#include "src/raster/lane_operations.h"
#include "src/raster/setup_primitive.h"
#include "src/raster/tile_planes.h"
#include "src/raster/window_transform.h"

namespace ninebit {

// One thread's working state: large.
struct LaneTile {
  LaneTile(const DrawContext& draw, const RenderTarget& planes);

  const DrawContext& context;
  const RenderTarget& target;
  const LaneOperations operations;
  const bool depths_are_codes;         // window depths, without a polygon offset
  std::array<bool, 4> writes_color{};  // color planes
  std::unique_ptr<LaneBatch> batch;    // none where the draw's result is flat

  PixelBox pixels{};         // of this tile, may be drawn
  int left = 0, bottom = 0;  // the tile's lowest corner
  bool is_loaded = false;
  TilePlanes tile;
};

// Whether vectors can draw all of a draw.
[[nodiscard]] bool lanes_can_draw(const DrawContext& context, const RenderTarget& target);

// Draws triangles of one block; the block must stay until the batch is flushed.
void draw_lanes(LaneTile& tile, const SetupBlock& block, std::span<const std::uint32_t> indices);

// Sends what the batch has gathered through the combiners and the fragment operations.
void flush_lanes(LaneTile& tile);

// Takes over the pixels that may be drawn from the planes of the target, and gives them back.
void load_tile(LaneTile& tile);
void store_tile(const LaneTile& tile);

}  // namespace ninebit
