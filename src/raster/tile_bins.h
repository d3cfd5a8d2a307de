// Which primitives of a block may cover which tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/raster/setup_primitive.h"
#include "src/raster/tile.h"
#include "src/raster/window_transform.h"

namespace ninebit {

// A target cut into tiles, row by row, the lowest row first.
struct TileGrid {
  int columns;
  int rows;
  TileGrid(int width, int height)
      : columns((width + kTileSize - 1) / kTileSize), rows((height + kTileSize - 1) / kTileSize) {}
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  // The tile's pixels among those that may be drawn.
  [[nodiscard]] PixelBox pixels(std::size_t tile, const PixelBox& drawn) const;
};

// One block's primitives sorted by tile, in drawing order within each tile.
struct BinnedBlock {
  SetupBlock setup;
  std::vector<std::uint32_t> indices;  // into setup.primitives
  std::vector<std::uint32_t> first;    // for each tile its first place in indices; one more at the end

  [[nodiscard]] std::span<const std::uint32_t> in_tile(std::size_t tile) const {
    return {indices.data() + first[tile], first[tile + 1] - first[tile]};
  }
};

// Sorts what has been set up.
void sort_into_tiles(const TileGrid& grid, BinnedBlock& block);

}  // namespace ninebit
