#include "src/raster/tile_bins.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace ninebit {
namespace {

// Whether a triangle can draw a centre within a tile: none where an edge has all of them on its outer side. (What is
// kept out so are the tiles in the corners of a large triangle's box.)
class TriangleReach {
 public:
  TriangleReach() = default;  // of what may reach everywhere
  explicit TriangleReach(const SetupPrimitive& t) : is_triangle_(t.kind == SetupKind::triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      dx_[i] = t.x_q4[b] - t.x_q4[a];
      dy_[i] = t.y_q4[b] - t.y_q4[a];
      origin_[i] = dy_[i] * t.x_q4[a] - dx_[i] * t.y_q4[a];
    }
  }

  [[nodiscard]] bool meets(int column, int row) const {
    if (!is_triangle_) return true;
    constexpr std::int64_t kFirst = 8, kLast = 16 * (kTileSize - 1) + 8;  // the centres, in 1/16 pixel
    const std::int64_t left = 16 * kTileSize * std::int64_t{column}, bottom = 16 * kTileSize * std::int64_t{row};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t x = left + (dy_[i] > 0 ? kFirst : kLast), y = bottom + (dx_[i] > 0 ? kLast : kFirst);
      if (origin_[i] + dx_[i] * y - dy_[i] * x < 0) return false;
    }
    return true;
  }

 private:
  bool is_triangle_ = false;
  std::array<std::int64_t, 3> dx_{}, dy_{}, origin_{};
};

// Calls visit(tile) for every tile that the primitive may draw into.
template <class Visit>
void for_each_tile(const TileGrid& grid, const SetupPrimitive& p, Visit visit) {
  const int left = p.box.left / kTileSize, right = p.box.right / kTileSize;
  const int bottom = p.box.bottom / kTileSize, top = p.box.top / kTileSize;
  const bool is_large = right - left > 1 || top - bottom > 1;
  const TriangleReach reach = is_large ? TriangleReach(p) : TriangleReach();
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) {
      if (reach.meets(column, row)) visit(static_cast<std::uint32_t>(row * grid.columns + column));
    }
  }
}

// Calls visit(tile, first, end) for the primitives first to end - 1 of the block, in order: neighbours lie in the same
// tile most often, and a run's tile needs to be looked up but once.
template <class Visit>
void for_each_run(const TileGrid& grid, const BinnedBlock& block, Visit visit) {
  const std::uint32_t* const tile = block.tile.data();
  const auto count = static_cast<std::uint32_t>(block.tile.size());
  for (std::uint32_t i = 0; i < count;) {
    const std::uint32_t first = i;
    do ++i;
    while (i < count && tile[i] == tile[first]);
    if (tile[first] != kSeveralTiles) {
      visit(tile[first], first, i);
      continue;
    }
    for (std::uint32_t k = first; k < i; ++k) {
      for_each_tile(grid, block.setup.primitives[k], [&](std::uint32_t t) { visit(t, k, k + 1); });
    }
  }
}

}  // namespace

PixelBox TileGrid::pixels(std::size_t tile, const PixelBox& drawn) const {
  const int left = static_cast<int>(tile) % columns * kTileSize, bottom = static_cast<int>(tile) / columns * kTileSize;
  return {std::max(left, drawn.left), std::max(bottom, drawn.bottom), std::min(left + kTileSize, drawn.right),
          std::min(bottom + kTileSize, drawn.top)};
}

void BinnedBlock::clear() {
  setup.primitives.clear();
  setup.corners.clear();
  setup.weights.clear();
  tile.clear();
  indices.clear();
  first_tile = 0;
  first.assign(1, 0);
}

void note_tiles(const TileGrid& grid, BinnedBlock& block) {
  for (std::size_t i = block.tile.size(); i < block.setup.primitives.size(); ++i) {
    const PixelBounds& box = block.setup.primitives[i].box;
    const std::uint32_t low = grid.tile_of(box.left, box.bottom), high = grid.tile_of(box.right, box.top);
    block.tile.push_back(low == high ? low : kSeveralTiles);
  }
}

void sort_into_tiles(const TileGrid& grid, BinnedBlock& block) {
  if (block.tile.empty()) return;
  std::uint32_t low = 0xFFFFFFFF, high = 0;
  for (std::size_t i = 0; i < block.tile.size(); ++i) {
    const bool several = block.tile[i] == kSeveralTiles;
    const PixelBounds& box = block.setup.primitives[i].box;
    low = std::min(low, several ? grid.tile_of(box.left, box.bottom) : block.tile[i]);
    high = std::max(high, several ? grid.tile_of(box.right, box.top) : block.tile[i]);
  }
  block.first_tile = low;
  block.first.assign(std::size_t{high} - low + 2, 0);
  std::uint32_t* const places = block.first.data();
  for_each_run(grid, block, [places, low](std::uint32_t tile, std::uint32_t first, std::uint32_t end) {
    places[tile - low] += end - first;
  });
  std::exclusive_scan(block.first.begin(), block.first.end(), block.first.begin(), std::uint32_t{0});
  block.indices.resize(block.first.back());
  std::uint32_t* const indices = block.indices.data();
  for_each_run(grid, block, [places, low, indices](std::uint32_t tile, std::uint32_t first, std::uint32_t end) {
    std::iota(indices + places[tile - low], indices + places[tile - low] + (end - first), first);
    places[tile - low] += end - first;
  });
  // Each tile's place has moved to the next one's.
  std::copy_backward(block.first.begin(), block.first.end() - 1, block.first.end());
  block.first.front() = 0;
}

}  // namespace ninebit
