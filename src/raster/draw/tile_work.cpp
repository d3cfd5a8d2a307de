#include "src/raster/draw/tile_work.h"

#include <algorithm>
#include <atomic>

#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// Starting a second thread takes some microseconds, as do this many primitives or pixels.
constexpr std::size_t kFewPrimitives = 128;
constexpr std::int64_t kFewPixels = 8192;

bool is_little_work(std::span<const BinnedBlock> blocks) {
  if (blocks.size() > 1 || blocks[0].setup.primitives.size() > kFewPrimitives) return false;
  std::int64_t pixels = 0;
  for (const SetupPrimitive& p : blocks[0].setup.primitives) {
    pixels += std::int64_t{p.box.right - p.box.left + 1} * (p.box.top - p.box.bottom + 1);
  }
  return pixels <= kFewPixels;
}

// Prefetches what the next blocks will read in the tile: the place of the third one's list, the second one's list, and
// the first primitives of the next one. (Drawing prefetches the rest of a long list.) In a large mesh, where a block
// has a few primitives a tile, each block would otherwise wait for memory.
void fetch_ahead(std::uint32_t tile, const BinnedBlock& third, const BinnedBlock& second, const BinnedBlock& next) {
  constexpr std::size_t kFirst = 32;
  __builtin_prefetch(&third.first[tile - third.first_tile]);
  const std::span<const std::uint32_t> list = second.in_tile(tile);
  for (std::size_t i = 0; i < std::min(list.size(), kFirst); i += 16) __builtin_prefetch(&list[i]);
  for (const std::uint32_t index : next.in_tile(tile).first(std::min(next.in_tile(tile).size(), kFirst))) {
    __builtin_prefetch(&next.setup.primitives[index]);
  }
}

}  // namespace

void TileWork::collect(std::span<const BinnedBlock> blocks) {
  tiles_.clear();
  blocks_.clear();
  is_little_ = true;
  std::uint32_t low = 0xFFFFFFFF, high = 0;
  for (const BinnedBlock& block : blocks) {
    if (block.indices.empty()) continue;
    low = std::min(low, block.first_tile);
    high = std::max(high, block.end_tile());
  }
  if (low >= high) return;
  is_little_ = is_little_work(blocks);

  tiles_.resize(high - low);
  for (const BinnedBlock& block : blocks) {
    for_each_tile(block, [&](std::uint32_t tile, std::uint32_t entries) {
      ++tiles_[tile - low].block_count;
      tiles_[tile - low].entries += entries;
    });
  }
  std::uint32_t place = 0;
  for (std::uint32_t i = 0; i < tiles_.size(); ++i) {
    tiles_[i].tile = low + i;
    tiles_[i].first_block = place;
    place += tiles_[i].block_count;
    tiles_[i].block_count = 0;
  }
  blocks_.resize(place);
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    for_each_tile(blocks[b], [&](std::uint32_t tile, std::uint32_t) {
      Tile& t = tiles_[tile - low];
      blocks_[t.first_block + t.block_count++] = b;
    });
  }
  std::erase_if(tiles_, [](const Tile& t) { return t.block_count == 0; });
  sort_tiles();
}

void TileWork::sort_tiles() {
  std::vector<std::uint64_t> most;
  for (const Tile& tile : tiles_) {
    const std::size_t group = tile.tile / kNeighbors;
    if (group >= most.size()) most.resize(group + 1);
    most[group] = std::max(most[group], tile.entries);
  }
  std::sort(tiles_.begin(), tiles_.end(), [&](const Tile& a, const Tile& b) {
    const std::uint64_t most_a = most[a.tile / kNeighbors], most_b = most[b.tile / kNeighbors];
    return most_a != most_b ? most_a > most_b : a.tile < b.tile;
  });
}

void TileLoop::draw_tile(std::span<const BinnedBlock> blocks, const TileWork& work, const TileWork::Tile& tile,
                         TileRasterizer& rasterizer) {
  const PixelBox pixels = state_.grid.pixels(tile.tile, state_.drawn);
  if (pixels.empty()) return;
  const std::span<const std::uint32_t> in_tile = work.blocks_of(tile);
  for (PixelProbe& probe : state_.probes) {
    if (!probe.lies_in(pixels)) continue;
    probe.meet_planes();
    for (const std::uint32_t b : in_tile) probe.run(blocks[b].setup, blocks[b].in_tile(tile.tile));
  }
  rasterizer.begin(pixels);
  for (std::size_t pass = 0; pass < state_.passes.size(); ++pass) {
    using Clock = std::chrono::steady_clock;
    const auto start = state_.is_timed ? Clock::now() : Clock::time_point();
    rasterizer.begin_pass(pass);
    for (std::size_t i = 0; i < in_tile.size(); ++i) {
      const auto block = [&](std::size_t ahead) { return &blocks[in_tile[std::min(i + ahead, in_tile.size() - 1)]]; };
      fetch_ahead(tile.tile, *block(3), *block(2), *block(1));
      rasterizer.draw(pass, block(0)->setup, block(0)->in_tile(tile.tile));
    }
    rasterizer.end_pass(pass);
    if (state_.is_timed) busy_[pass] += std::chrono::nanoseconds(Clock::now() - start).count();
  }
  rasterizer.end();
}

// The tiles, then all others of the target: they have to be cleared.
std::vector<TileWork::Tile> TileLoop::with_empty_tiles(std::span<const TileWork::Tile> tiles) const {
  std::vector<bool> has_work(state_.grid.count());
  for (const TileWork::Tile& tile : tiles) has_work[tile.tile] = true;
  std::vector<TileWork::Tile> all(tiles.begin(), tiles.end());
  for (std::uint32_t t = 0; t < state_.grid.count(); ++t) {
    if (!has_work[t]) all.push_back({.tile = t});
  }
  return all;
}

void TileLoop::draw(std::span<const BinnedBlock> blocks, const TileWork& work) {
  std::span<const TileWork::Tile> tiles = work.tiles();
  std::vector<TileWork::Tile> all;
  if (state_.actions.clear != nullptr) {
    all = with_empty_tiles(tiles);
    tiles = all;
  }
  if (tiles.empty()) return;
  const bool is_little = work.is_little() && state_.actions.clear == nullptr;
  const std::size_t workers = is_little ? 1 : std::min(tiles.size(), max_threads());
  if (rasterizers_.size() < workers) rasterizers_.resize(workers);
  // Tiles differ in cost: each worker takes the next ones when it is done with its last.
  const std::size_t at_a_time = std::clamp(tiles.size() / (8 * workers), std::size_t{1}, TileWork::kNeighbors);
  std::atomic<std::size_t> next = 0;
  const auto draw_tiles = [&](std::size_t worker) {
    std::size_t i = next.fetch_add(at_a_time);
    if (i >= tiles.size()) return;
    std::unique_ptr<TileRasterizer>& rasterizer = rasterizers_[worker];
    if (!rasterizer) rasterizer = std::make_unique<TileRasterizer>(state_.passes, state_.target, state_.actions);
    for (; i < tiles.size(); i = next.fetch_add(at_a_time)) {
      const std::size_t end = std::min(i + at_a_time, tiles.size());
      for (std::size_t t = i; t < end; ++t) draw_tile(blocks, work, tiles[t], *rasterizer);
    }
  };
  if (workers == 1) return draw_tiles(0);
  parallel_for(workers, draw_tiles);
}

}  // namespace ninebit
