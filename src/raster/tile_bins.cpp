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
  bool is_triangle_;
  std::array<std::int64_t, 3> dx_, dy_, origin_;
};

// Calls visit(tile) for every tile that the primitive may draw into.
template <class Visit>
void for_each_tile(const TileGrid& grid, const SetupPrimitive& p, Visit visit) {
  const TriangleReach reach(p);
  for (int row = p.box.bottom / kTileSize; row <= p.box.top / kTileSize; ++row) {
    for (int column = p.box.left / kTileSize; column <= p.box.right / kTileSize; ++column) {
      if (reach.meets(column, row)) visit(static_cast<std::uint32_t>(row * grid.columns + column));
    }
  }
}

// A primitive in a tile.
struct Entry {
  std::uint32_t tile;
  std::uint32_t index;
};

// The entries in drawing order.
std::vector<Entry> entries_of(const TileGrid& grid, const BinnedBlock& block) {
  std::vector<Entry> entries;
  entries.reserve(2 * block.tile.size());
  for (std::uint32_t i = 0; i < block.tile.size(); ++i) {
    if (block.tile[i] != kSeveralTiles) {
      entries.push_back({block.tile[i], i});
    } else {
      for_each_tile(grid, block.setup.primitives[i], [&](std::uint32_t tile) { entries.push_back({tile, i}); });
    }
  }
  return entries;
}

// Neighbours lie in the same tile most often: a run's tile is looked up once.
template <class TileOf, class IndexOf>
void sort_entries(std::size_t count, TileOf tile_of, IndexOf index_of, BinnedBlock& block) {
  if (count == 0) return;
  std::uint32_t low = 0xFFFFFFFF, high = 0;
  for (std::size_t i = 0; i < count; ++i) {
    low = std::min(low, tile_of(i));
    high = std::max(high, tile_of(i));
  }
  block.first_tile = low;
  block.first.assign(std::size_t{high} - low + 2, 0);
  std::uint32_t* const places = block.first.data();
  for (std::size_t i = 0; i < count;) {
    const std::uint32_t tile = tile_of(i);
    std::size_t end = i + 1;
    while (end < count && tile_of(end) == tile) ++end;
    places[tile - low] += static_cast<std::uint32_t>(end - i);
    i = end;
  }
  std::exclusive_scan(block.first.begin(), block.first.end(), block.first.begin(), std::uint32_t{0});
  block.indices.resize(count);
  for (std::size_t i = 0; i < count;) {
    const std::uint32_t tile = tile_of(i);
    std::uint32_t to = places[tile - low];
    do block.indices[to++] = index_of(i++);
    while (i < count && tile_of(i) == tile);
    places[tile - low] = to;
  }
  // Each tile's place has moved to the next one's.
  std::copy_backward(block.first.begin(), block.first.end() - 1, block.first.end());
  block.first.front() = 0;
}

}  // namespace

PixelBox TileGrid::pixels(std::size_t tile, const PixelBox& drawn) const {
  const int left = static_cast<int>(tile) % columns * kTileSize, bottom = static_cast<int>(tile) / columns * kTileSize;
  return {std::max(left, drawn.left), std::max(bottom, drawn.bottom), std::min(left + kTileSize, drawn.right),
          std::min(bottom + kTileSize, drawn.top)};
}

void BinnedBlock::clear() {
  setup.primitives.clear();
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
  const std::uint32_t* const tile = block.tile.data();
  if (std::find(block.tile.begin(), block.tile.end(), kSeveralTiles) == block.tile.end()) {
    sort_entries(
        block.tile.size(), [tile](std::size_t i) { return tile[i]; },
        [](std::size_t i) { return static_cast<std::uint32_t>(i); }, block);
    return;
  }
  const std::vector<Entry> entries = entries_of(grid, block);
  sort_entries(
      entries.size(), [&](std::size_t i) { return entries[i].tile; }, [&](std::size_t i) { return entries[i].index; },
      block);
}

}  // namespace ninebit
