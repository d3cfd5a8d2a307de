// Blocks of binned primitives drawn tile by tile.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/raster/draw/pixel_probe.h"
#include "src/raster/draw/tile.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/setup/tile_bins.h"

namespace ninebit {

// Which tiles have something to draw, and in which blocks.
class TileWork {
 public:
  struct Tile {
    std::uint32_t tile = 0;
    std::uint32_t first_block = 0;  // its blocks' place in blocks()
    std::uint32_t block_count = 0;
    std::uint64_t entries = 0;  // primitives, as often as they are drawn here
  };

  // So many tiles side by side are drawn one after the other: where a row of theirs ends within a line of the cache,
  // the next one finds the line there.
  static constexpr std::size_t kNeighbors = 4;

  // Replaces what was known of other blocks. These have been sorted into tiles.
  void look_at(std::span<const BinnedBlock> blocks);

  [[nodiscard]] std::span<const Tile> tiles() const { return tiles_; }
  [[nodiscard]] std::span<const std::uint32_t> blocks_of(const Tile& tile) const {
    return {blocks_.data() + tile.first_block, tile.block_count};
  }
  // Whether it is over before a second thread could have begun.
  [[nodiscard]] bool is_little() const { return is_little_; }

 private:
  void sort_tiles();

  std::vector<Tile> tiles_;            // those with the most entries first, neighbours together
  std::vector<std::uint32_t> blocks_;  // for each tile in ascending order
  bool is_little_ = true;
};

// Draws with the state of one draw call, or of several passes over the same primitives, in as many threads as there
// are.
class TileLoop {
 public:
  // The arguments must outlive the loop; see TileRasterizer. No probe: nullptr.
  TileLoop(const TileGrid& grid, const PixelBox& drawn, std::span<const DrawContext* const> passes,
           const RenderTarget& target, const TileActions& actions, bool is_timed, PixelProbe* probe)
      : grid_(grid),
        drawn_(drawn),
        passes_(passes),
        target_(target),
        actions_(actions),
        is_timed_(is_timed),
        probe_(probe),
        busy_(passes.size()) {}

  // In drawing order within each tile: blocks in theirs, after those of earlier calls.
  void draw(std::span<const BinnedBlock> blocks, const TileWork& work);

  // How long threads have drawn a pass, together, if that is timed.
  [[nodiscard]] std::chrono::nanoseconds busy(std::size_t pass) const {
    return std::chrono::nanoseconds(busy_[pass].load());
  }

 private:
  void draw_tile(std::span<const BinnedBlock> blocks, const TileWork& work, const TileWork::Tile& tile,
                 TileRasterizer& rasterizer);

  const TileGrid& grid_;
  const PixelBox& drawn_;
  std::span<const DrawContext* const> passes_;
  const RenderTarget& target_;
  TileActions actions_;
  bool is_timed_;
  PixelProbe* probe_;
  std::vector<std::unique_ptr<TileRasterizer>> rasterizers_;  // one for each that works at a time
  std::vector<std::atomic<std::int64_t>> busy_;
};

}  // namespace ninebit
