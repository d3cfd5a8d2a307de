// Blocks of binned primitives drawn tile by tile.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "src/raster/draw/pixel_probe.h"
#include "src/raster/draw/tile.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/setup/tile_bins.h"

namespace ninebit {

// The tiles in which something is drawn, with the blocks that have primitives there.
class TileWork {
 public:
  struct Tile {
    std::uint32_t tile = 0;
    std::uint32_t first_block = 0;  // where blocks_of() begins
    std::uint32_t block_count = 0;
    std::uint64_t entries = 0;  // primitives in the tile
  };

  // This many tiles side by side are drawn one after the other: where a row of one ends within a cache line, the line
  // is still in the cache for the next one.
  static constexpr std::size_t kNeighbors = 4;

  // Collects the tiles of blocks that have been sorted into tiles. Replaces earlier ones.
  void collect(std::span<const BinnedBlock> blocks);

  [[nodiscard]] std::span<const Tile> tiles() const { return tiles_; }
  [[nodiscard]] std::span<const std::uint32_t> blocks_of(const Tile& tile) const {
    return {blocks_.data() + tile.first_block, tile.block_count};
  }
  // True if the work takes less time than starting a second thread.
  [[nodiscard]] bool is_little() const { return is_little_; }

 private:
  void sort_tiles();

  std::vector<Tile> tiles_;            // in drawing order: most entries first, neighbours together
  std::vector<std::uint32_t> blocks_;  // of all tiles, ascending in each
  bool is_little_ = true;
};

// The state that a TileLoop draws with; see TileRasterizer. All that it refers to must outlive the loop.
struct TileLoopState {
  const TileGrid& grid;
  const PixelBox& drawn;
  std::span<const DrawContext* const> passes;
  const RenderTarget& target;
  std::deque<PixelProbe>& probes;
  TileActions actions;
  bool is_timed = false;
};

// Draws with the state of one draw call, or of several passes over the same primitives, in all available threads.
class TileLoop {
 public:
  explicit TileLoop(const TileLoopState& state) : state_(state), busy_(state.passes.size()) {}

  // Draws the blocks in their order within each tile, after those of earlier calls.
  void draw(std::span<const BinnedBlock> blocks, const TileWork& work);

  // The time that all threads together have spent on a pass, if that is timed.
  [[nodiscard]] std::chrono::nanoseconds busy(std::size_t pass) const {
    return std::chrono::nanoseconds(busy_[pass].load());
  }

 private:
  void draw_tile(std::span<const BinnedBlock> blocks, const TileWork& work, const TileWork::Tile& tile,
                 TileRasterizer& rasterizer);
  [[nodiscard]] std::vector<TileWork::Tile> with_empty_tiles(std::span<const TileWork::Tile> tiles) const;

  const TileLoopState state_;
  std::vector<std::unique_ptr<TileRasterizer>> rasterizers_;  // one for each worker
  std::vector<std::atomic<std::int64_t>> busy_;
};

}  // namespace ninebit
