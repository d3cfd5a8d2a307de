// Coverage and depth of primitives within one tile.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "src/raster/draw_context.h"
#include "src/raster/fragment_batch.h"
#include "src/raster/setup_primitive.h"
#include "src/raster/tile_lanes.h"
#include "src/raster/tile_size.h"
#include "src/raster/window_transform.h"

namespace ninebit {

// Draws primitives of one block, in the order of `indices`, as far as they cover the tile. Fragments whose colour is
// the primitive's go through the fragment operations at once, the others into the batch: without a flat result there
// has to be one.
void draw_in_tile(const DrawContext& context, const PixelBox& tile, const SetupBlock& block,
                  std::span<const std::uint32_t> indices, FragmentBatch* batch);

// Draws tile after tile, in one thread: large, and to be used again for many tiles.
class TileRasterizer {
 public:
  // The arguments must outlive it.
  TileRasterizer(const DrawContext& context, const RenderTarget& target);

  // `pixels` lie in one tile. Blocks must stay until `end`.
  void begin(const PixelBox& pixels);
  void draw(const SetupBlock& block, std::span<const std::uint32_t> indices);
  void end();

 private:
  const DrawContext* context_;
  PixelBox pixels_;
  std::unique_ptr<LaneTile> lanes_;       // where vectors draw; else
  std::unique_ptr<FragmentBatch> batch_;  // none where the draw's result is flat
};

}  // namespace ninebit
