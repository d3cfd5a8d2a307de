#include "src/raster/tile_bins.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "src/raster/raw_vector.h"

namespace ninebit {
namespace {

// Whether a triangle can draw a centre within a tile: none where an edge has all of them on its outer side. (What is
// kept out so are the tiles in the corners of a large triangle's box.)
class TriangleReach {
 public:
  TriangleReach() = default;  // of what may reach everywhere
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
  bool is_triangle_ = false;
  std::array<std::int64_t, 3> dx_{}, dy_{}, origin_{};
};

// The primitives first to end - 1 of a block, all in one tile.
struct TileRun {
  std::uint32_t tile, first, end;
};

// Adds primitive `i` to `runs`, for every tile that it may draw into; there is room for four more.
void add_to_several(const TileGrid& grid, const SetupPrimitive& p, std::uint32_t i, RawVector<TileRun>& runs,
                    std::size_t& count) {
  const int left = p.box.left / kTileSize, right = p.box.right / kTileSize;
  const int bottom = p.box.bottom / kTileSize, top = p.box.top / kTileSize;
  const auto across = static_cast<std::uint32_t>(right - left), up = static_cast<std::uint32_t>(top - bottom);
  const auto columns = static_cast<std::uint32_t>(grid.columns);
  const auto first = static_cast<std::uint32_t>(bottom) * columns + static_cast<std::uint32_t>(left);
  if ((across | up) <= 1) {  // without a branch: all four are written, and kept if they are there
    runs[count++] = {first, i, i + 1};
    runs[count] = {first + 1, i, i + 1};
    count += across;
    runs[count] = {first + columns, i, i + 1};
    count += up;
    runs[count] = {first + columns + 1, i, i + 1};
    count += across & up;
    return;
  }
  if (left > right || bottom > top) return;
  const TriangleReach reach(p);
  runs.resize(runs.size() + (std::size_t{across} + 1) * (std::size_t{up} + 1));
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) {
      if (!reach.meets(column, row)) continue;
      runs[count++] = {static_cast<std::uint32_t>(row * grid.columns + column), i, i + 1};
    }
  }
}

// The block's primitives in order, each as often as it is drawn: neighbours lie in the same tile most often.
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
      add_to_several(grid, block.setup.primitives[first], first, runs, count);
    }
  }
  runs.resize(count);
  return runs;
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
  if (runs.empty()) return;
  std::uint32_t low = 0xFFFFFFFF, high = 0;
  for (const TileRun& run : runs) {
    low = std::min(low, run.tile);
    high = std::max(high, run.tile);
  }
  block.first_tile = low;
  block.first.assign(std::size_t{high} - low + 2, 0);
  std::uint32_t* const places = block.first.data();
  for (const TileRun& run : runs) places[run.tile - low] += run.end - run.first;
  std::exclusive_scan(block.first.begin(), block.first.end(), block.first.begin(), std::uint32_t{0});
  block.indices.resize(block.first.back());
  std::uint32_t* const indices = block.indices.data();
  for (const TileRun& run : runs) {
    std::uint32_t place = places[run.tile - low];
    for (std::uint32_t i = run.first; i != run.end; ++i) indices[place++] = i;
    places[run.tile - low] = place;
  }
  // Each tile's place has moved to the next one's.
  std::copy_backward(block.first.begin(), block.first.end() - 1, block.first.end());
  block.first.front() = 0;
}

}  // namespace ninebit
