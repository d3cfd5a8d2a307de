#include "src/raster/tile_bins.h"

#include <algorithm>
#include <tuple>

namespace ninebit {
namespace {

constexpr int kShift = 10;  // 64 pixels of 16 steps

// Calls visit(tile) for every tile that the primitive's box meets.
template <class Visit>
void for_each_tile(const TileGrid& grid, int line_width, int point_size, const SetupPrimitive& p, Visit visit) {
  int x_low = p.x_q4[0], x_high = x_low, y_low = p.y_q4[0], y_high = y_low;
  switch (p.kind) {
    case SetupKind::triangle:
      std::tie(x_low, x_high) = std::minmax({p.x_q4[0], p.x_q4[1], p.x_q4[2]});
      std::tie(y_low, y_high) = std::minmax({p.y_q4[0], p.y_q4[1], p.y_q4[2]});
      break;
    case SetupKind::line: {
      // A pixel's diamond reaches half a pixel to each side of its centre.
      const int wide = 16 * line_width;
      x_low = std::min(p.x_q4[0], p.x_q4[1]) - 16;
      x_high = std::max(p.x_q4[0], p.x_q4[1]) + wide;
      y_low = std::min(p.y_q4[0], p.y_q4[1]) - 16;
      y_high = std::max(p.y_q4[0], p.y_q4[1]) + wide;
      break;
    }
    case SetupKind::point:
      x_high += 16 * point_size;
      y_high += 16 * point_size;
      break;
  }
  const int left = std::max(x_low >> kShift, 0), right = std::min(x_high >> kShift, grid.columns - 1);
  const int bottom = std::max(y_low >> kShift, 0), top = std::min(y_high >> kShift, grid.rows - 1);
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) {
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

void sort_into_tiles(const TileGrid& grid, int line_width, int point_size, BinnedBlock& block) {
  const auto visit_tiles = [&](const SetupPrimitive& p, auto visit) {
    for_each_tile(grid, line_width, point_size, p, visit);
  };
  block.first.assign(grid.count() + 1, 0);
  for (const SetupPrimitive& p : block.setup.primitives) {
    visit_tiles(p, [&](std::size_t tile) { ++block.first[tile + 1]; });
  }
  for (std::size_t tile = 0; tile < grid.count(); ++tile) block.first[tile + 1] += block.first[tile];
  block.indices.resize(block.first.back());
  std::vector<std::uint32_t> next(block.first.begin(), block.first.end() - 1);
  for (std::uint32_t i = 0; i < block.setup.primitives.size(); ++i) {
    visit_tiles(block.setup.primitives[i], [&](std::size_t tile) { block.indices[next[tile]++] = i; });
  }
}

}  // namespace ninebit
