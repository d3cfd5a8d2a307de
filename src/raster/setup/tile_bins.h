// Which primitives of a block may cover which tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"
#include "src/raster/surface/raw_vector.h"
#include "src/raster/surface/tile_size.h"

namespace ninebit {

// A target cut into tiles, row by row, the lowest row first.
struct TileGrid {
  int columns;
  int rows;
  TileGrid(int width, int height)
      : columns((width + kTileSize - 1) / kTileSize), rows((height + kTileSize - 1) / kTileSize) {}
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  [[nodiscard]] std::uint32_t tile_of(int x, int y) const {
    return static_cast<std::uint32_t>(y / kTileSize * columns + x / kTileSize);
  }
  // The tile's pixels among those that may be drawn.
  [[nodiscard]] PixelBox pixels(std::size_t tile, const PixelBox& drawn) const;
};

inline constexpr std::uint32_t kSeveralTiles = 0xFFFFFFFF;

// One block's primitives sorted by tile, in drawing order within each tile.
struct BinnedBlock {
  SetupBlock setup;
  RawVector<std::uint32_t> tile;     // of each primitive the tile that holds its box, or kSeveralTiles
  RawVector<std::uint32_t> indices;  // into setup.primitives
  std::uint32_t first_tile = 0;      // of those that have primitives
  // For each tile from first_tile on its first place in indices; one more at the end.
  std::vector<std::uint32_t> first{0};

  void clear();
  [[nodiscard]] std::uint32_t end_tile() const { return first_tile + static_cast<std::uint32_t>(first.size()) - 1; }
  // The entries of a tile from first_tile to end_tile() - 1.
  [[nodiscard]] std::span<const std::uint32_t> in_tile(std::uint32_t t) const {
    const std::uint32_t* const at = &first[t - first_tile];
    return {indices.data() + at[0], at[1] - at[0]};
  }
};

// Calls visit(tile, entries) for the tiles in which the block has primitives.
template <class Visit>
void for_each_tile(const BinnedBlock& block, Visit visit) {
  for (std::size_t i = 0; i + 1 < block.first.size(); ++i) {
    const std::uint32_t entries = block.first[i + 1] - block.first[i];
    if (entries > 0) visit(block.first_tile + static_cast<std::uint32_t>(i), entries);
  }
}

// Fills `tile` for the primitives that have none yet.
void note_tiles(const TileGrid& grid, BinnedBlock& block);

// Sorts the primitives of the block by tile.
void sort_into_tiles(const TileGrid& grid, BinnedBlock& block);

}  // namespace ninebit
