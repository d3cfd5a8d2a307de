// Rows of a target's planes to rows of a tile and back, and what is known of a tile as a whole.
#include "src/raster/lanes/tile_planes.h"

#include <algorithm>
#include <cstring>

#include "src/raster/lanes/tile_lanes.h"
#include "src/raster/surface/clear_values.h"
#include "src/raster/surface/color_words.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/tile_planes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void load_rows(LaneTile&, TileRow, int, int) {}
void store_rows(const LaneTile&, TileRow, int, int) {}
void find_farthest(LaneTile&) {}
void fill_planes(LaneTile&, std::uint32_t, std::uint32_t) {}

#else

using D32 = hn::CappedTag<std::uint32_t, 16>;
using D8 = hn::Rebind<std::uint8_t, D32>;
using Bytes = hn::Repartition<std::uint8_t, D32>;
using Pairs = hn::Repartition<std::uint16_t, D32>;
using V32 = hn::Vec<D32>;
constexpr D32 kD32;
constexpr D8 kD8;
constexpr Bytes kBytes;
constexpr Pairs kPairs;
constexpr std::size_t kLanes = hn::MaxLanes(kD32), kQuads = 4;  // vectors of words that a vector of bytes makes

// Bytes of the same significance side by side in each block of four words.
HWY_INLINE V32 sorted_bytes(V32 words) {
  alignas(16) static constexpr std::array<std::uint8_t, 16> kOrder{0, 4, 8,  12, 1, 5, 9,  13,
                                                                   2, 6, 10, 14, 3, 7, 11, 15};
  return hn::BitCast(kD32, hn::TableLookupBytes(hn::BitCast(kBytes, words), hn::LoadDup128(kBytes, kOrder.data())));
}

// Words of the colours from those of their bytes and back: four vectors for four.
struct ColorLanes {
  V32 v[kQuads];

  HWY_INLINE void load(const std::uint32_t* from) {
    for (std::size_t q = 0; q < kQuads; ++q) v[q] = sorted_bytes(hn::Load(kD32, from + q * kLanes));
    const V32 even_low = hn::ConcatEven(kD32, v[1], v[0]), even_high = hn::ConcatEven(kD32, v[3], v[2]);
    const V32 odd_low = hn::ConcatOdd(kD32, v[1], v[0]), odd_high = hn::ConcatOdd(kD32, v[3], v[2]);
    v[0] = hn::ConcatEven(kD32, even_high, even_low);
    v[1] = hn::ConcatEven(kD32, odd_high, odd_low);
    v[2] = hn::ConcatOdd(kD32, even_high, even_low);
    v[3] = hn::ConcatOdd(kD32, odd_high, odd_low);
  }

  HWY_INLINE void store(std::uint32_t* to) const {
    // Interleaving goes on within blocks of 16 bytes: block b gets what vector q needs there at word q.
    alignas(64) std::array<std::uint32_t, kLanes> word;
    for (std::size_t i = 0; i < kLanes; ++i) word[i] = static_cast<std::uint32_t>(i % 4 * (kLanes / 4) + i / 4);
    const auto order = hn::SetTableIndices(kD32, word.data());
    hn::Vec<Bytes> plane[kQuads];
    for (std::size_t k = 0; k < kQuads; ++k) plane[k] = hn::BitCast(kBytes, hn::TableLookupLanes(v[k], order));
    const auto pairs = [](hn::Vec<Bytes> bytes) HWY_ATTR { return hn::BitCast(kPairs, bytes); };
    const auto low = pairs(hn::InterleaveLower(kBytes, plane[0], plane[1]));
    const auto high = pairs(hn::InterleaveUpper(kBytes, plane[0], plane[1]));
    const auto next_low = pairs(hn::InterleaveLower(kBytes, plane[2], plane[3]));
    const auto next_high = pairs(hn::InterleaveUpper(kBytes, plane[2], plane[3]));
    hn::Store(hn::BitCast(kD32, hn::InterleaveLower(kPairs, low, next_low)), kD32, to);
    hn::Store(hn::BitCast(kD32, hn::InterleaveUpper(kPairs, low, next_low)), kD32, to + kLanes);
    hn::Store(hn::BitCast(kD32, hn::InterleaveLower(kPairs, high, next_high)), kD32, to + 2 * kLanes);
    hn::Store(hn::BitCast(kD32, hn::InterleaveUpper(kPairs, high, next_high)), kD32, to + 3 * kLanes);
  }
};

// A row of them, at any address.
HWY_INLINE void copy_words(const void* from, void* to) {
  for (std::size_t i = 0; i < kTileSize; i += kLanes) {
    const auto words = hn::LoadU(kBytes, static_cast<const std::uint8_t*>(from) + 4 * i);
    hn::StoreU(words, kBytes, static_cast<std::uint8_t*>(to) + 4 * i);
  }
}

void load_row(LaneTile& tile, const TileRow& from, std::size_t place) {
  if (tile.depth || tile.stencil) {
    for (std::size_t i = 0; i < kTileSize; i += kLanes) {
      auto v = hn::Zero(kD32);
      if (tile.depth) v = hn::ShiftLeft<8>(hn::LoadU(kD32, from.depth.data + i));
      if (tile.stencil) v = hn::Or(v, hn::PromoteTo(kD32, hn::LoadU(kD8, from.stencil.data + i)));
      hn::Store(v, kD32, tile.tile.depth_stencil.data() + place + i);
    }
  }
  if (!tile.has_color()) return;
  if (tile.has_words) return copy_words(from.color[0].data, tile.tile.color.data() + place);
  for (std::size_t i = 0; i < kTileSize; i += kQuads * kLanes) {
    ColorLanes color;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto bytes = tile.color[k] ? hn::LoadU(kBytes, from.color[k].data + i) : hn::Zero(kBytes);
      color.v[k] = hn::BitCast(kD32, bytes);
    }
    color.store(tile.tile.color.data() + place + i);
  }
}

void store_row(const LaneTile& tile, const TileRow& to, std::size_t place) {
  const std::uint32_t* const depth_stencil = tile.tile.depth_stencil.data() + place;
  for (std::size_t i = 0; i < kTileSize && tile.writes_depth; i += kLanes) {
    hn::StoreU(hn::ShiftRight<8>(hn::Load(kD32, depth_stencil + i)), kD32, to.depth.data + i);
  }
  for (std::size_t i = 0; i < kTileSize && tile.writes_stencil; i += kQuads * kLanes) {
    V32 v[kQuads];
    for (std::size_t q = 0; q < kQuads; ++q) v[q] = sorted_bytes(hn::Load(kD32, depth_stencil + i + q * kLanes));
    const V32 values = hn::ConcatEven(kD32, hn::ConcatEven(kD32, v[3], v[2]), hn::ConcatEven(kD32, v[1], v[0]));
    hn::StoreU(hn::BitCast(kBytes, values), kBytes, to.stencil.data + i);
  }
  if (!tile.has_color()) return;
  if (tile.has_words) return copy_words(tile.tile.color.data() + place, to.color[0].data);
  for (std::size_t i = 0; i < kTileSize; i += kQuads * kLanes) {
    ColorLanes color;
    color.load(tile.tile.color.data() + place + i);
    for (std::size_t k = 0; k < 4; ++k) {
      if (tile.color[k]) hn::StoreU(hn::BitCast(kBytes, color.v[k]), kBytes, to.color[k].data + i);
    }
  }
}

// Rows from one of the tile's on.
void load_rows(LaneTile& tile, TileRow from, int row, int count) {
  for (int y = row; y < row + count; ++y, from.move_up()) load_row(tile, from, static_cast<std::size_t>(y * kTileSize));
}

void store_rows(const LaneTile& tile, TileRow to, int row, int count) {
  for (int y = row; y < row + count; ++y, to.move_up()) store_row(tile, to, static_cast<std::size_t>(y * kTileSize));
}

void fill_planes(LaneTile& tile, std::uint32_t depth_stencil, std::uint32_t color) {
  static_assert(TilePlanes::kWords % kLanes == 0);
  for (std::size_t i = 0; i < TilePlanes::kWords; i += kLanes) {
    hn::Store(hn::Set(kD32, depth_stencil), kD32, tile.tile.depth_stencil.data() + i);
    hn::Store(hn::Set(kD32, color), kD32, tile.tile.color.data() + i);
  }
}

void find_farthest(LaneTile& tile) {
  constexpr std::size_t kRows = FarthestDepths::kBlock, kWidth = FarthestDepths::kBlock;
  alignas(64) std::array<std::uint32_t, kTileSize> column;
  for (std::size_t row = 0; row < FarthestDepths::kBlocks; ++row) {
    for (std::size_t x = 0; x < kTileSize; x += kLanes) {
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

HWY_EXPORT(load_rows);
HWY_EXPORT(store_rows);
HWY_EXPORT(find_farthest);
HWY_EXPORT(fill_planes);

// A row of which only some pixels are the draw's.
struct Staging {
  alignas(64) std::array<std::uint32_t, kTileSize> depth{};
  alignas(64) std::array<std::uint8_t, kTileSize> stencil{};
  alignas(64) std::array<std::uint8_t, std::size_t{4} * kTileSize> color{};

  // With colours as the tile wants them.
  TileRow row(const LaneTile& tile) {
    TileRow row{.depth = {depth.data()}, .stencil = {stencil.data()}, .color = {}};
    for (std::size_t k = 0; k < 4; ++k) {
      row.color[k] = {.data = color.data() + k * (tile.has_words ? 1 : kTileSize), .step = tile.has_words ? 4 : 1};
    }
    return row;
  }
};

// The tile's first row that may be drawn in the target's planes, of depth and stencil in those that are asked for.
TileRow first_row(const LaneTile& tile, bool depth, bool stencil) {
  const RenderTarget& target = tile.target;
  const auto start = [&](auto plane) {
    plane.data = &plane.at(tile.left, tile.pixels.bottom);
    return plane;
  };
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
  const int first = tile.pixels.left - tile.left, end = tile.pixels.right - tile.left;
  const auto copy_samples = [&](const auto& samples, const auto& target) {
    if (!samples || !target) return;
    if (samples.step == 1 && target.step == 1) {
      std::copy(samples.data + first, samples.data + end, target.data + first);
    } else {
      for (int x = first; x < end; ++x) target.at(x, 0) = samples.at(x, 0);
    }
  };
  copy_samples(from.depth, to.depth);
  copy_samples(from.stencil, to.stencil);
  for (std::size_t k = 0; k < 4; ++k) copy_samples(from.color[k], to.color[k]);
}

// Whether vectors read and write the target's rows.
bool has_whole_rows(const LaneTile& tile) {
  return tile.pixels.right - tile.pixels.left == kTileSize && !tile.has_gaps;
}

}  // namespace

void LaneTile::look_at_steps() {
  has_words = color[0] && color[1] && color[2] && color[3] && are_words(target.color);
  has_gaps = (depth && target.depth.step != 1) || (stencil && target.stencil.step != 1);
  for (std::size_t k = 0; k < 4 && !has_words; ++k) has_gaps = has_gaps || (color[k] && target.color[k].step != 1);
}

void load_tile(LaneTile& tile) {
  TileRow row = first_row(tile, tile.depth, tile.stencil);
  const int first = tile.pixels.bottom - tile.bottom, end = tile.pixels.top - tile.bottom;
  if (has_whole_rows(tile)) return HWY_DYNAMIC_DISPATCH(load_rows)(tile, row, first, end - first);
  Staging staging;
  for (int y = first; y < end; ++y, row.move_up()) {
    copy(tile, row, staging.row(tile));
    HWY_DYNAMIC_DISPATCH(load_rows)(tile, staging.row(tile), y, 1);
  }
}

void fill_tile(LaneTile& tile, const ClearValues& values) {
  const auto fetch = [](const auto& plane) {
    constexpr std::size_t kLine = 64;
    const std::size_t size = sizeof(*plane.data) * static_cast<std::size_t>(plane.step) * kTileSize;
    for (std::size_t i = 0; i < size && plane; i += kLine) {
      __builtin_prefetch(reinterpret_cast<const char*>(plane.data) + i, 1, 2);
    }
  };
  TileRow row = first_row(tile, tile.writes_depth, tile.writes_stencil);
  for (int y = tile.pixels.bottom; y < tile.pixels.top && has_whole_rows(tile); ++y, row.move_up()) {
    fetch(row.depth);
    fetch(row.stencil);
    for (std::size_t k = 0; k < (tile.has_words ? 1 : 4); ++k) fetch(row.color[k]);
  }
  const DepthStencilFormat format = tile.target.format;
  std::uint32_t color = 0;
  std::memcpy(&color, values.color.data(), sizeof(color));
  HWY_DYNAMIC_DISPATCH(fill_planes)
  (tile, depth_code(format, values.depth) << 8 | stencil_value(format, values.stencil), color);
}

void store_tile(const LaneTile& tile) {
  TileRow row = first_row(tile, tile.writes_depth, tile.writes_stencil);
  const int first = tile.pixels.bottom - tile.bottom, end = tile.pixels.top - tile.bottom;
  if (has_whole_rows(tile)) return HWY_DYNAMIC_DISPATCH(store_rows)(tile, row, first, end - first);
  Staging staging;
  for (int y = first; y < end; ++y, row.move_up()) {
    HWY_DYNAMIC_DISPATCH(store_rows)(tile, staging.row(tile), y, 1);
    copy(tile, staging.row(tile), row);
  }
}

// Depths that the pass itself writes only come nearer: looking for the farthest is left out there because it finds
// little.
void begin_pass(LaneTile& tile, LanePass& pass) {
  if (pass.repeats && tile.has_kept_all) return repeat_fragments(tile, pass);
  if (!pass.repeats) tile.keep_none();
  tile.next_number = 0;
  if (pass.operations.depth_write) tile.knows_owners = pass.notes_owners;
  if (pass.notes_owners) tile.tile.owner.fill(LaneTile::kNoOwner);
  tile.knows_farthest = pass.operations.loses_farther && !pass.operations.depth_write;
  if (tile.knows_farthest) HWY_DYNAMIC_DISPATCH(find_farthest)(tile);
}

}  // namespace ninebit
#endif
