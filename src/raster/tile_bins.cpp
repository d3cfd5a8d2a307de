#include "src/raster/tile_bins.h"

#include <algorithm>

namespace ninebit {
namespace {

// Calls visit(tile) for every tile that the primitive's box meets.
template <class Visit>
void for_each_tile(const TileGrid& grid, const PixelBounds& box, Visit visit) {
  for (int row = box.bottom / kTileSize; row <= box.top / kTileSize; ++row) {
    for (int column = box.left / kTileSize; column <= box.right / kTileSize; ++column) {
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column));
    }
  }
}

}  // namespace

PixelBox TileGrid::pixels(std::size_t tile, const PixelBox& drawn) const {
  const int left = static_cast<int>(tile) % columns * kTileSize, bottom = static_cast<int>(tile) / columns * kTileSize;
  return {std::max(left, drawn.left), std::max(bottom, drawn.bottom), std::min(left + kTileSize, drawn.right),
          std::min(bottom + kTileSize, drawn.top)};
}

void sort_into_tiles(const TileGrid& grid, BinnedBlock& block) {
  block.first.assign(grid.count() + 1, 0);
  for (const SetupPrimitive& p : block.setup.primitives) {
    for_each_tile(grid, p.box, [&](std::size_t tile) { ++block.first[tile + 1]; });
  }
  for (std::size_t tile = 0; tile < grid.count(); ++tile) block.first[tile + 1] += block.first[tile];
  block.indices.resize(block.first.back());
  std::vector<std::uint32_t> next(block.first.begin(), block.first.end() - 1);
  for (std::uint32_t i = 0; i < block.setup.primitives.size(); ++i) {
    for_each_tile(grid, block.setup.primitives[i].box, [&](std::size_t tile) { block.indices[next[tile]++] = i; });
  }
}

}  // namespace ninebit
