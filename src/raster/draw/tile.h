// Coverage and depth of primitives within one tile.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/raster/fragment/draw_context.h"
#include "src/raster/fragment/fragment_batch.h"
#include "src/raster/lanes/tile_lanes.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"
#include "src/raster/surface/tile_size.h"

namespace ninebit {

// Draws primitives of one block, in the order of `indices`, as far as they cover the tile. Fragments whose colour is
// the primitive's go through the fragment operations at once, the others into the batch: without a flat result there
// has to be one.
void draw_in_tile(const DrawContext& context, const PixelBox& tile, const SetupBlock& block,
                  std::span<const std::uint32_t> indices, FragmentBatch* batch);

// What is done with a tile before and after its passes.
struct TileActions {
  const ClearValues* clear = nullptr;  // what all planes are filled with first; nullptr: they keep what they hold
  bool discards_depth = false;         // the depth plane need not hold what was drawn
};

// Draws tile after tile, in one thread: large, and to be used again for many tiles. Passes are drawn one after the
// other in each tile.
class TileRasterizer {
 public:
  // The arguments must outlive it. Several passes only where can_share_tiles, discards_depth only
  // there, clear only where can_clear_tiles.
  TileRasterizer(std::span<const DrawContext* const> passes, const RenderTarget& target, const TileActions& actions);

  // Whether passes can be drawn tile by tile as if each were drawn by itself.
  [[nodiscard]] static bool can_share_tiles(std::span<const DrawContext* const> passes, const RenderTarget& target);
  // Whether, besides, all planes can be cleared in the tiles.
  [[nodiscard]] static bool can_clear_tiles(std::span<const DrawContext* const> passes, const RenderTarget& target);

  // `pixels` lie in one tile. Blocks must stay until `end`.
  void begin(const PixelBox& pixels);
  void begin_pass(std::size_t pass);
  void draw(std::size_t pass, const SetupBlock& block, std::span<const std::uint32_t> indices);
  void end_pass(std::size_t pass);
  void end();

 private:
  const DrawContext* context_;  // of the only pass, where not vectors draw
  const ClearValues* clear_;
  PixelBox pixels_;
  std::vector<LanePass> passes_;
  std::unique_ptr<LaneTile> lanes_;       // where vectors draw; else
  std::unique_ptr<FragmentBatch> batch_;  // none where the draw's result is flat
};

}  // namespace ninebit
