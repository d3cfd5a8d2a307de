// Rows of a target's planes to rows of a tile and back, and what is known of a tile as a whole.
#include "src/raster/tile_planes.h"

#include <algorithm>
#include <cstring>

#include "src/raster/clear_values.h"
#include "src/raster/tile_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/tile_planes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void load_row(LaneTile&, const TileRow&, std::size_t) {}
void store_row(const LaneTile&, const TileRow&, std::size_t) {}
void find_farthest(LaneTile&) {}

#else

using D32 = hn::CappedTag<std::uint32_t, 16>;
using D8 = hn::Rebind<std::uint8_t, D32>;
using Bytes = hn::CappedTag<std::uint8_t, 64>;
constexpr D32 kD32;
constexpr D8 kD8;
constexpr Bytes kBytes;

void load_row(LaneTile& tile, const TileRow& from, std::size_t place) {
  if (tile.depth || tile.stencil) {
    for (std::size_t i = 0; i < kTileSize; i += hn::Lanes(kD32)) {
      auto v = hn::Zero(kD32);
      if (tile.depth) v = hn::ShiftLeft<8>(hn::LoadU(kD32, from.depth + i));
      if (tile.stencil) v = hn::Or(v, hn::PromoteTo(kD32, hn::LoadU(kD8, from.stencil + i)));
      hn::Store(v, kD32, tile.tile.depth_stencil.data() + place + i);
    }
  }
  if (!tile.has_color()) return;
  auto* const to = reinterpret_cast<std::uint8_t*>(tile.tile.color.data() + place);
  for (std::size_t i = 0; i < kTileSize; i += hn::Lanes(kBytes)) {
    const auto samples = [&](std::size_t k) HWY_ATTR {
      return tile.color[k] ? hn::LoadU(kBytes, from.color[k] + i) : hn::Zero(kBytes);
    };
    hn::StoreInterleaved4(samples(0), samples(1), samples(2), samples(3), kBytes, to + 4 * i);
  }
}

void store_row(const LaneTile& tile, const TileRow& to, std::size_t place) {
  const bool stencil = tile.writes_stencil, depth = tile.writes_depth;
  if (stencil || depth) {
    for (std::size_t i = 0; i < kTileSize; i += hn::Lanes(kD32)) {
      const auto v = hn::Load(kD32, tile.tile.depth_stencil.data() + place + i);
      if (depth) hn::StoreU(hn::ShiftRight<8>(v), kD32, to.depth + i);
      if (stencil) hn::StoreU(hn::U8FromU32(hn::And(v, hn::Set(kD32, 0xFF))), kD8, to.stencil + i);
    }
  }
  if (!tile.has_color()) return;
  const auto* const from = reinterpret_cast<const std::uint8_t*>(tile.tile.color.data() + place);
  for (std::size_t i = 0; i < kTileSize; i += hn::Lanes(kBytes)) {
    hn::Vec<Bytes> v0, v1, v2, v3;
    hn::LoadInterleaved4(kBytes, from + 4 * i, v0, v1, v2, v3);
    if (tile.color[0]) hn::StoreU(v0, kBytes, to.color[0] + i);
    if (tile.color[1]) hn::StoreU(v1, kBytes, to.color[1] + i);
    if (tile.color[2]) hn::StoreU(v2, kBytes, to.color[2] + i);
    if (tile.color[3]) hn::StoreU(v3, kBytes, to.color[3] + i);
  }
}

void find_farthest(LaneTile& tile) {
  constexpr std::size_t kRows = FarthestDepths::kBlock, kWidth = FarthestDepths::kBlock;
  alignas(64) std::array<std::uint32_t, kTileSize> column;
  for (std::size_t row = 0; row < FarthestDepths::kBlocks; ++row) {
    for (std::size_t x = 0; x < kTileSize; x += hn::Lanes(kD32)) {
      auto farthest = hn::Zero(kD32);
      for (std::size_t y = row * kRows; y < (row + 1) * kRows; ++y) {
        farthest = hn::Max(farthest, hn::Load(kD32, &tile.tile.depth_stencil[y * kTileSize + x]));
      }
      hn::Store(hn::ShiftRight<8>(farthest), kD32, column.data() + x);
    }
    for (std::size_t b = 0; b < FarthestDepths::kBlocks; ++b) {
      const auto* const first = column.data() + b * kWidth;
      tile.farthest.code[row * FarthestDepths::kBlocks + b] = *std::max_element(first, first + kWidth);
    }
  }
}

#endif

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {
namespace {

HWY_EXPORT(load_row);
HWY_EXPORT(store_row);
HWY_EXPORT(find_farthest);

// A row of which only some pixels are the draw's.
struct Staging {
  alignas(64) std::array<std::uint32_t, kTileSize> depth{};
  alignas(64) std::array<std::uint8_t, kTileSize> stencil{};
  alignas(64) std::array<std::array<std::uint8_t, kTileSize>, 4> color{};

  TileRow row() {
    return {depth.data(), stencil.data(), {color[0].data(), color[1].data(), color[2].data(), color[3].data()}};
  }
};

// Where row y of the tile starts in the target's planes, of depth and stencil in those that are asked for.
TileRow row_of(const LaneTile& tile, int y, bool depth, bool stencil) {
  const RenderTarget& target = tile.target;
  const auto start = [&](const auto& plane) { return plane.row(y) + tile.left; };
  TileRow row;
  if (depth) row.depth = start(target.depth);
  if (stencil) row.stencil = start(target.stencil);
  for (std::size_t k = 0; k < 4; ++k) {
    if (tile.color[k]) row.color[k] = start(target.color[k]);
  }
  return row;
}

// Copies the pixels that may be drawn, of the planes that both rows have.
void copy(const LaneTile& tile, const TileRow& from, const TileRow& to) {
  const auto copy_samples = [&](const auto* samples, auto* target) {
    if (samples == nullptr || target == nullptr) return;
    const int first = tile.pixels.left - tile.left, count = tile.pixels.right - tile.pixels.left;
    std::memcpy(target + first, samples + first, static_cast<std::size_t>(count) * sizeof(*samples));
  };
  copy_samples(from.depth, to.depth);
  copy_samples(from.stencil, to.stencil);
  for (std::size_t k = 0; k < 4; ++k) copy_samples(from.color[k], to.color[k]);
}

bool has_whole_rows(const LaneTile& tile) {
  return tile.pixels.right - tile.pixels.left == kTileSize;
}

std::size_t place_of_row(const LaneTile& tile, int y) {
  return static_cast<std::size_t>(y - tile.bottom) * kTileSize;
}

}  // namespace

void load_tile(LaneTile& tile) {
  Staging staging;
  for (int y = tile.pixels.bottom; y < tile.pixels.top; ++y) {
    TileRow row = row_of(tile, y, tile.depth, tile.stencil);
    if (!has_whole_rows(tile)) {
      copy(tile, row, staging.row());
      row = staging.row();
    }
    HWY_DYNAMIC_DISPATCH(load_row)(tile, row, place_of_row(tile, y));
  }
}

void fill_tile(LaneTile& tile, const ClearValues& values) {
  const auto fetch = [](const auto* first) {
    constexpr std::size_t kLine = 64;
    for (std::size_t i = 0; i < sizeof(*first) * kTileSize; i += kLine) {
      __builtin_prefetch(reinterpret_cast<const char*>(first) + i, 1, 2);
    }
  };
  for (int y = tile.pixels.bottom; y < tile.pixels.top && has_whole_rows(tile); ++y) {
    const TileRow row = row_of(tile, y, tile.writes_depth, tile.writes_stencil);
    if (row.depth != nullptr) fetch(row.depth);
    if (row.stencil != nullptr) fetch(row.stencil);
    for (const std::uint8_t* samples : row.color) {
      if (samples != nullptr) fetch(samples);
    }
  }
  const DepthStencilFormat format = tile.target.format;
  tile.tile.depth_stencil.fill(depth_code(format, values.depth) << 8 | stencil_value(format, values.stencil));
  std::uint32_t color = 0;
  std::memcpy(&color, values.color.data(), sizeof(color));
  tile.tile.color.fill(color);
}

void store_tile(const LaneTile& tile) {
  Staging staging;
  for (int y = tile.pixels.bottom; y < tile.pixels.top; ++y) {
    const TileRow row = row_of(tile, y, tile.writes_depth, tile.writes_stencil);
    if (has_whole_rows(tile)) {
      HWY_DYNAMIC_DISPATCH(store_row)(tile, row, place_of_row(tile, y));
      continue;
    }
    HWY_DYNAMIC_DISPATCH(store_row)(tile, staging.row(), place_of_row(tile, y));
    copy(tile, staging.row(), row);
  }
}

// Depths that the pass itself writes only come nearer: looking for the farthest is left out there because it finds
// little.
void begin_pass(LaneTile& tile, LanePass& pass) {
  if (pass.repeats && tile.has_kept_all) return repeat_fragments(tile, pass);
  if (!pass.repeats) tile.keep_none();
  tile.knows_farthest = pass.operations.loses_farther && !pass.operations.depth_write;
  if (tile.knows_farthest) HWY_DYNAMIC_DISPATCH(find_farthest)(tile);
}

}  // namespace ninebit
#endif
