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

// Draws primitives of one block into a tile, in the order of `indices`. If the draw has a flat result, fragments go
// through the fragment operations at once; else they go into the batch, which must not be null.
void draw_in_tile(const DrawContext& context, const PixelBox& tile, const SetupBlock& block,
                  std::span<const std::uint32_t> indices, FragmentBatch* batch);

// Actions on a tile before and after its passes.
struct TileActions {
  const ClearValues* clear = nullptr;  // fills all planes first; nullptr: they keep their contents
  bool discards_depth = false;         // the depth plane need not be written
  bool is_sample = false;              // TileContents::is_sample
};

// Draws tile after tile in one thread, in each tile pass after pass. Large: one is used for many tiles.
class TileRasterizer {
 public:
  // The arguments must outlive it. Several passes and discards_depth require can_share_tiles, clear requires
  // can_clear_tiles.
  TileRasterizer(std::span<const DrawContext* const> passes, const RenderTarget& target, const TileActions& actions);

  // True if passes can be drawn tile by tile with the same result as one after the other.
  [[nodiscard]] static bool can_share_tiles(std::span<const DrawContext* const> passes, const RenderTarget& target);
  // True if, in addition, all planes can be cleared in the tiles.
  [[nodiscard]] static bool can_clear_tiles(std::span<const DrawContext* const> passes, const RenderTarget& target);

  // `pixels` lie in one tile. Blocks must stay until `end`.
  void begin(const PixelBox& pixels);
  void begin_pass(std::size_t pass);
  void draw(std::size_t pass, const SetupBlock& block, std::span<const std::uint32_t> indices);
  void end_pass(std::size_t pass);
  void end();

 private:
  const DrawContext* context_;  // of the only pass, where vectors do not draw
  const ClearValues* clear_;
  PixelBox pixels_;
  std::vector<LanePass> passes_;
  std::unique_ptr<LaneTile> lanes_;       // where vectors draw
  std::unique_ptr<FragmentBatch> batch_;  // elsewhere, unless the draw's result is flat
};

}  // namespace ninebit
