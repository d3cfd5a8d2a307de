#include "src/raster/setup/tile_bins.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "src/raster/surface/raw_vector.h"

namespace ninebit {
namespace {

// Whether a triangle may draw a pixel centre of a tile: false if all centres are on the outer side of an edge. (This
// excludes the tiles in the corners of a large triangle's box.)
class TriangleReach {
 public:
  explicit TriangleReach(const SetupPrimitive& t) : is_triangle_(t.kind == SetupKind::triangle) {
    const std::array<std::int32_t, 3> x = t.x_q4(), y = t.y_q4();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      dx_[i] = x[b] - x[a];
      dy_[i] = y[b] - y[a];
      origin_[i] = dy_[i] * x[a] - dx_[i] * y[a];
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
  std::array<std::int64_t, 3> dx_{}, dy_{}, origin_{};
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

// The primitives first to end - 1 of a block, all in one tile; or one in more than 2 × 2, whose tile is kSeveralTiles.
struct TileRun {
  std::uint32_t tile, first, end;
};

// Adds primitive `i`, which is in several tiles, at `to`, where there is room for four; returns the number of runs.
std::size_t add_to_several(const TileGrid& grid, const PixelBounds& box, std::uint32_t i, TileRun* to) {
  const int left = box.left / kTileSize, bottom = box.bottom / kTileSize;
  const auto across = static_cast<std::uint32_t>(box.right / kTileSize - left);
  const auto up = static_cast<std::uint32_t>(box.top / kTileSize - bottom);
  if ((across | up) > 1) {
    *to = {kSeveralTiles, i, i + 1};
    return 1;
  }
  const auto columns = static_cast<std::uint32_t>(grid.columns);
  const std::uint32_t first = static_cast<std::uint32_t>(bottom) * columns + static_cast<std::uint32_t>(left);
  // Without a branch: all four are written, and kept if they are there.
  std::size_t count = 0;
  to[count++] = {first, i, i + 1};
  to[count] = {first + 1, i, i + 1};
  count += across;
  to[count] = {first + columns, i, i + 1};
  count += up;
  to[count] = {first + columns + 1, i, i + 1};
  return count + (across & up);
}

// The block's primitives in order: neighbours lie in the same tile most often.
RawVector<TileRun> find_runs(const TileGrid& grid, const BinnedBlock& block) {
  const std::uint32_t* const tile = block.tile.data();
  const auto primitives = static_cast<std::uint32_t>(block.tile.size());
  RawVector<std::uint32_t> start(std::size_t{primitives} + 1);
  std::size_t starts = 0;
  for (std::uint32_t i = 0; i < primitives; ++i) {  // without a branch
    start[starts] = i;
    starts += i == 0 || tile[i] != tile[i - 1] || tile[i] == kSeveralTiles ? 1 : 0;
  }
  start[starts] = primitives;
  RawVector<TileRun> runs(4 * starts);
  std::size_t count = 0;
  for (std::size_t s = 0; s < starts; ++s) {
    const std::uint32_t first = start[s];
    if (tile[first] != kSeveralTiles) {
      runs[count++] = {tile[first], first, start[s + 1]};
    } else {
      count += add_to_several(grid, block.setup.primitives[first].box, first, &runs[count]);
    }
  }
  runs.resize(count);
  return runs;
}

// Calls visit(tile, first, end) for all runs in order, with each of the tiles that one in more than 2 × 2 may draw
// into.
template <class Visit>
void for_each_run(const TileGrid& grid, const BinnedBlock& block, const RawVector<TileRun>& runs, Visit visit) {
  for (const TileRun& run : runs) {
    if (run.tile != kSeveralTiles) {
      visit(run.tile, run.first, run.end);
    } else {
      for_each_tile(grid, block.setup.primitives[run.first],
                    [&](std::uint32_t tile) { visit(tile, run.first, run.end); });
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
  const RawVector<TileRun> runs = find_runs(grid, block);
  std::uint32_t low = 0xFFFFFFFF, high = 0;
  for (const TileRun& run : runs) {
    const bool several = run.tile == kSeveralTiles;
    const PixelBounds& box = block.setup.primitives[run.first].box;
    low = std::min(low, several ? grid.tile_of(box.left, box.bottom) : run.tile);
    high = std::max(high, several ? grid.tile_of(box.right, box.top) : run.tile);
  }
  block.first_tile = low;
  block.first.assign(std::size_t{high} - low + 2, 0);
  std::uint32_t* const places = block.first.data();
  for_each_run(grid, block, runs, [places, low](std::uint32_t tile, std::uint32_t first, std::uint32_t end) {
    places[tile - low] += end - first;
  });
  std::exclusive_scan(block.first.begin(), block.first.end(), block.first.begin(), std::uint32_t{0});
  block.indices.resize(block.first.back());
  std::uint32_t* const indices = block.indices.data();
  for_each_run(grid, block, runs, [places, low, indices](std::uint32_t tile, std::uint32_t first, std::uint32_t end) {
    std::uint32_t place = places[tile - low];
    for (std::uint32_t i = first; i != end; ++i) indices[place++] = i;
    places[tile - low] = place;
  });
  // Each tile's place has moved to the next one's.
  std::copy_backward(block.first.begin(), block.first.end() - 1, block.first.end());
  block.first.front() = 0;
}

}  // namespace ninebit
