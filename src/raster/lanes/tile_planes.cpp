#include "src/raster/lanes/tile_planes.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "hwy/cache_control.h"
#include "src/numerics/simd_targets.h"
#include "src/raster/lanes/tile_row.h"
#include "src/raster/surface/color_words.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/tile_planes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void load_rows(TilePlanes&, TileRow, int, int, RowForm) {}
void store_rows(const TilePlanes&, TileRow, int, int, RowForm) {}
void find_farthest(const TilePlanes&, FarthestDepths&) {}
void fill_words(TileWords&, std::uint32_t) {}

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
constexpr std::size_t kLanes = hn::MaxLanes(kD32), kQuads = 4;  // vectors of words for one of bytes

// Moves bytes of the same significance side by side, in each block of four words.
HWY_INLINE V32 sorted_bytes(V32 words) {
  alignas(16) static constexpr std::array<std::uint8_t, 16> kOrder{0, 4, 8,  12, 1, 5, 9,  13,
                                                                   2, 6, 10, 14, 3, 7, 11, 15};
  return hn::BitCast(kD32, hn::TableLookupBytes(hn::BitCast(kBytes, words), hn::LoadDup128(kBytes, kOrder.data())));
}

// Four vectors of colour words as four of bytes, one for each component, and back.
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
    // Interleaving stays within blocks of 16 bytes: word q of block b is moved to where vector q needs it.
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

// The distance of a row's samples.
constexpr std::size_t step_of(RowForm form) {
  return form == RowForm::every_second ? 2 : 1;
}

// A vector of a row's samples. The second half of every second sample begins a sample early: nothing behind the last
// one is read, or written by put().
template <RowForm kForm, class D>
HWY_INLINE hn::Vec<D> load(D d, const hn::TFromD<D>* from) {
  if constexpr (kForm != RowForm::every_second) {
    return hn::LoadU(d, from);
  } else {
    const hn::RepartitionToWide<D> pairs;
    const auto high = hn::BitCast(pairs, hn::LoadU(d, from + hn::Lanes(d) - 1));
    return hn::ConcatEven(d, hn::BitCast(d, hn::ShiftRight<8 * sizeof(*from)>(high)), hn::LoadU(d, from));
  }
}

template <RowForm kForm, class D>
HWY_INLINE void put(hn::Vec<D> v, D d, hn::TFromD<D>* to) {
  if constexpr (kForm == RowForm::streamed) {
    hn::Stream(v, d, to);
  } else if constexpr (kForm == RowForm::side_by_side) {
    hn::StoreU(v, d, to);
  } else {
    const hn::Half<D> half;
    const hn::RepartitionToWide<D> pairs;
    hn::TFromD<D>* const above = to + hn::Lanes(d) - 1;
    const auto low = hn::BitCast(d, hn::PromoteTo(pairs, hn::LowerHalf(half, v)));
    const auto high = hn::BitCast(d, hn::ShiftLeft<8 * sizeof(*to)>(hn::PromoteTo(pairs, hn::UpperHalf(half, v))));
    const auto between_low = hn::LoadU(d, to), between_high = hn::LoadU(d, above);
    hn::StoreU(hn::OddEven(between_low, low), d, to);
    hn::StoreU(hn::OddEven(high, between_high), d, above);
  }
}

// Copies a row of colour words, at any address.
template <RowForm kForm>
HWY_INLINE void copy_words(const void* from, void* to) {
  for (std::size_t i = 0; i < kTileSize; i += kLanes) {
    const auto words = hn::LoadU(kBytes, static_cast<const std::uint8_t*>(from) + 4 * i);
    put<kForm>(words, kBytes, static_cast<std::uint8_t*>(to) + 4 * i);
  }
}

template <RowForm kForm>
HWY_INLINE void load_row(TilePlanes& tile, const TileRow& from, std::size_t place) {
  constexpr std::size_t kStep = step_of(kForm);
  if (tile.contents.depth || tile.contents.stencil) {
    for (std::size_t i = 0; i < kTileSize; i += kLanes) {
      auto v = hn::Zero(kD32);
      if (tile.contents.depth) v = hn::ShiftLeft<8>(load<kForm>(kD32, from.depth.data + i * kStep));
      if (tile.contents.stencil) v = hn::Or(v, hn::PromoteTo(kD32, load<kForm>(kD8, from.stencil.data + i * kStep)));
      hn::Store(v, kD32, tile.depth_stencil.data() + place + i);
    }
  }
  if (!tile.contents.has_color()) return;
  if (tile.colors_are_words) return copy_words<RowForm::side_by_side>(from.color[0].data, tile.color.data() + place);
  for (std::size_t i = 0; i < kTileSize; i += kQuads * kLanes) {
    ColorLanes color;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_held = tile.contents.color[k];
      const auto bytes = is_held ? load<kForm>(kBytes, from.color[k].data + i * kStep) : hn::Zero(kBytes);
      color.v[k] = hn::BitCast(kD32, bytes);
    }
    color.store(tile.color.data() + place + i);
  }
}

template <RowForm kForm>
HWY_INLINE void store_row(const TilePlanes& tile, const TileRow& to, std::size_t place) {
  constexpr std::size_t kStep = step_of(kForm);
  const std::uint32_t* const depth_stencil = tile.depth_stencil.data() + place;
  for (std::size_t i = 0; i < kTileSize && tile.contents.writes_depth; i += kLanes) {
    put<kForm>(hn::ShiftRight<8>(hn::Load(kD32, depth_stencil + i)), kD32, to.depth.data + i * kStep);
  }
  for (std::size_t i = 0; i < kTileSize && tile.contents.writes_stencil; i += kQuads * kLanes) {
    V32 v[kQuads];
    for (std::size_t q = 0; q < kQuads; ++q) v[q] = sorted_bytes(hn::Load(kD32, depth_stencil + i + q * kLanes));
    const V32 values = hn::ConcatEven(kD32, hn::ConcatEven(kD32, v[3], v[2]), hn::ConcatEven(kD32, v[1], v[0]));
    put<kForm>(hn::BitCast(kBytes, values), kBytes, to.stencil.data + i * kStep);
  }
  if (!tile.contents.has_color()) return;
  if (tile.colors_are_words) return copy_words<kForm>(tile.color.data() + place, to.color[0].data);
  for (std::size_t i = 0; i < kTileSize; i += kQuads * kLanes) {
    ColorLanes color;
    color.load(tile.color.data() + place + i);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!tile.contents.color[k]) continue;
      put<kForm>(hn::BitCast(kBytes, color.v[k]), kBytes, to.color[k].data + i * kStep);
    }
  }
}

// `count` rows, the first of which is `row` of the tile.
void load_rows(TilePlanes& tile, TileRow from, int row, int count, RowForm form) {
  for (int y = row; y < row + count; ++y, from.move_up()) {
    const auto place = static_cast<std::size_t>(y * kTileSize);
    form == RowForm::every_second ? load_row<RowForm::every_second>(tile, from, place)
                                  : load_row<RowForm::side_by_side>(tile, from, place);
  }
}

template <RowForm kForm>
void store_rows_of(const TilePlanes& tile, TileRow to, int row, int count) {
  for (int y = row; y < row + count; ++y, to.move_up()) {
    store_row<kForm>(tile, to, static_cast<std::size_t>(y * kTileSize));
  }
}

void store_rows(const TilePlanes& tile, TileRow to, int row, int count, RowForm form) {
  switch (form) {
    case RowForm::side_by_side:
      return store_rows_of<RowForm::side_by_side>(tile, to, row, count);
    case RowForm::every_second:
      return store_rows_of<RowForm::every_second>(tile, to, row, count);
    case RowForm::streamed:
      store_rows_of<RowForm::streamed>(tile, to, row, count);
      return hwy::FlushStream();
    case RowForm::scattered:
      return;  // vectors cannot
  }
}

void fill_words(TileWords& words, std::uint32_t value) {
  static_assert(kTileWords % kLanes == 0);
  for (std::size_t i = 0; i < kTileWords; i += kLanes) hn::Store(hn::Set(kD32, value), kD32, words.data() + i);
}

void find_farthest(const TilePlanes& tile, FarthestDepths& to) {
  constexpr std::size_t kRows = FarthestDepths::kBlock, kWidth = FarthestDepths::kBlock;
  alignas(64) std::array<std::uint32_t, kTileSize> column;
  for (std::size_t row = 0; row < FarthestDepths::kBlocks; ++row) {
    for (std::size_t x = 0; x < kTileSize; x += kLanes) {
      auto farthest = hn::Zero(kD32);
      for (std::size_t y = row * kRows; y < (row + 1) * kRows; ++y) {
        farthest = hn::Max(farthest, hn::Load(kD32, &tile.depth_stencil[y * kTileSize + x]));
      }
      hn::Store(hn::ShiftRight<8>(farthest), kD32, column.data() + x);
    }
    for (std::size_t b = 0; b < FarthestDepths::kBlocks; ++b) {
      const auto* const first = column.data() + b * kWidth;
      to.code[row * FarthestDepths::kBlocks + b] = *std::max_element(first, first + kWidth);
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
HWY_EXPORT(fill_words);

// A row of which only some pixels may be drawn: the draw's pixels are copied to and from it.
struct Staging {
  alignas(64) std::array<std::uint32_t, kTileSize> depth{};
  alignas(64) std::array<std::uint8_t, kTileSize> stencil{};
  alignas(64) std::array<std::uint8_t, std::size_t{4} * kTileSize> color{};

  // The row, with colours as the tile reads them.
  TileRow row(const TilePlanes& tile) {
    TileRow row{.depth = {depth.data()}, .stencil = {stencil.data()}, .color = {}};
    for (std::size_t k = 0; k < 4; ++k) {
      row.color[k] = {.data = color.data() + k * (tile.colors_are_words ? 1 : kTileSize),
                      .step = tile.colors_are_words ? 4 : 1};
    }
    return row;
  }
};

// The first row that may be drawn, in the target's planes: of colour, and of depth and stencil if asked for.
TileRow first_row(const TilePlanes& tile, bool depth, bool stencil) {
  const RenderTarget& target = tile.target;
  const auto start = [&](auto plane) {
    plane.data = &plane.at(tile.left, tile.pixels.bottom);
    return plane;
  };
  TileRow row;
  if (depth) row.depth = start(target.depth);
  if (stencil) row.stencil = start(target.stencil);
  for (std::size_t k = 0; k < 4; ++k) {
    if (tile.contents.color[k]) row.color[k] = start(target.color[k]);
  }
  return row;
}

// Copies the pixels that may be drawn, of the planes that both rows have.
void copy(const TilePlanes& tile, const TileRow& from, const TileRow& to) {
  const int first = tile.pixels.left - tile.left, end = tile.pixels.right - tile.left;
  const auto copy_samples = [&](const auto& samples, const auto& target) {
    if (!samples || !target) return;
    if (samples.step == 1 && target.step == 1) {
      std::copy(&samples.at(first, 0), &samples.at(end, 0), &target.at(first, 0));
    } else {
      for (int x = first; x < end; ++x) target.at(x, 0) = samples.at(x, 0);
    }
  };
  copy_samples(from.depth, to.depth);
  copy_samples(from.stencil, to.stencil);
  for (std::size_t k = 0; k < 4; ++k) copy_samples(from.color[k], to.color[k]);
}

bool has_color_words(const RenderTarget& target, const TileContents& contents) {
  const std::array<bool, 4>& color = contents.color;
  return color[0] && color[1] && color[2] && color[3] && are_words(target.color);
}

// True if samples of all planes that the tile holds have this step, except for colours that are words.
bool have_step(const RenderTarget& target, const TileContents& contents, bool colors_are_words, std::ptrdiff_t step) {
  bool have = (!contents.depth || target.depth.step == step) && (!contents.stencil || target.stencil.step == step);
  for (std::size_t k = 0; k < 4 && !colors_are_words; ++k) {
    have = have && (!contents.color[k] || target.color[k].step == step);
  }
  return have;
}

// True if stored rows should bypass the caches: the target is cleared, so that its old contents are not read, and is
// larger than a core's caches. An ordinary store would first fetch each line. Small maps stay cached for the next pass.
bool streams_rows(const RenderTarget& target, const TileContents& contents) {
  constexpr std::size_t kSmall = std::size_t{1} << 22;  // bytes
  constexpr std::size_t kLine = 64;
  if (!contents.clears) return false;
  std::size_t bytes_a_pixel = 0;
  bool are_aligned = true;
  const auto take = [&](const auto& plane) {
    if (!plane) return;
    const std::size_t size = sizeof(*plane.data);
    bytes_a_pixel += size;
    are_aligned = are_aligned && reinterpret_cast<std::uintptr_t>(plane.data) % kLine == 0 &&
                  static_cast<std::size_t>(plane.stride) * size % kLine == 0;
  };
  if (contents.writes_depth) take(target.depth);
  if (contents.writes_stencil) take(target.stencil);
  // In words, only red's plane begins where the line does.
  if (has_color_words(target, contents)) {
    take(target.color[0]);
    bytes_a_pixel += 3;
  } else {
    for (const Plane<std::uint8_t>& plane : target.color) take(plane);
  }
  return are_aligned &&
         bytes_a_pixel * static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height) > kSmall;
}

RowForm form_of(const RenderTarget& target, const TileContents& contents, bool colors_are_words) {
  if (have_step(target, contents, colors_are_words, 1)) {
    return streams_rows(target, contents) ? RowForm::streamed : RowForm::side_by_side;
  }
  const bool skips_samples = contents.is_sample && !colors_are_words && have_step(target, contents, false, 2);
  return skips_samples ? RowForm::every_second : RowForm::scattered;
}

// True if vectors can read and write the target's rows.
bool has_whole_rows(const TilePlanes& tile) {
  return tile.pixels.right - tile.pixels.left == kTileSize && tile.form != RowForm::scattered;
}

}  // namespace

TilePlanes::TilePlanes(const RenderTarget& render_target, const TileContents& planes)
    : target(render_target),
      contents(planes),
      colors_are_words(has_color_words(target, contents)),
      form(form_of(target, contents, colors_are_words)) {}

void TilePlanes::move_to(const PixelBox& drawn) {
  pixels = drawn;
  left = drawn.left & -kTileSize;
  bottom = drawn.bottom & -kTileSize;
}

void load_tile(TilePlanes& tile) {
  TileRow row = first_row(tile, tile.contents.depth, tile.contents.stencil);
  const int first = tile.pixels.bottom - tile.bottom, end = tile.pixels.top - tile.bottom;
  if (has_whole_rows(tile)) return HWY_DYNAMIC_DISPATCH(load_rows)(tile, row, first, end - first, tile.form);
  Staging staging;
  for (int y = first; y < end; ++y, row.move_up()) {
    copy(tile, row, staging.row(tile));
    HWY_DYNAMIC_DISPATCH(load_rows)(tile, staging.row(tile), y, 1, RowForm::side_by_side);
  }
}

void fill_tile(TilePlanes& tile, const ClearValues& values) {
  const auto fetch = [](const auto& plane) {
    constexpr std::size_t kLine = 64;
    const std::size_t size = sizeof(*plane.data) * static_cast<std::size_t>(plane.step) * kTileSize;
    for (std::size_t i = 0; i < size && plane; i += kLine) {
      __builtin_prefetch(reinterpret_cast<const char*>(plane.data) + i, 1, 2);
    }
  };
  TileRow row = first_row(tile, tile.contents.writes_depth, tile.contents.writes_stencil);
  const bool fetches = has_whole_rows(tile) && tile.form != RowForm::streamed;
  for (int y = tile.pixels.bottom; y < tile.pixels.top && fetches; ++y, row.move_up()) {
    fetch(row.depth);
    fetch(row.stencil);
    for (std::size_t k = 0; k < (tile.colors_are_words ? 1 : 4); ++k) fetch(row.color[k]);
  }
  const DepthStencilFormat format = tile.target.format;
  const std::array<std::uint8_t, 4> stored = stored_color(tile.target.color_format, values.color);
  std::uint32_t color = 0;
  std::memcpy(&color, stored.data(), sizeof(color));
  HWY_DYNAMIC_DISPATCH(fill_words)(tile.color, color);
  if (tile.keeps_depth_stencil) return;
  HWY_DYNAMIC_DISPATCH(fill_words)
  (tile.depth_stencil, depth_code(format, values.depth) << 8 | stencil_value(format, values.stencil));
  tile.keeps_depth_stencil = !tile.contents.draws_depth_stencil;
}

void store_tile(const TilePlanes& tile) {
  TileRow row = first_row(tile, tile.contents.writes_depth, tile.contents.writes_stencil);
  const int first = tile.pixels.bottom - tile.bottom, end = tile.pixels.top - tile.bottom;
  if (has_whole_rows(tile)) return HWY_DYNAMIC_DISPATCH(store_rows)(tile, row, first, end - first, tile.form);
  Staging staging;
  for (int y = first; y < end; ++y, row.move_up()) {
    HWY_DYNAMIC_DISPATCH(store_rows)(tile, staging.row(tile), y, 1, RowForm::side_by_side);
    copy(tile, staging.row(tile), row);
  }
}

void find_farthest(const TilePlanes& tile, FarthestDepths& to) {
  HWY_DYNAMIC_DISPATCH(find_farthest)(tile, to);
}

}  // namespace ninebit
#endif
