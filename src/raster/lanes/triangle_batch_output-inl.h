// Candidates written as set-up primitives.
#if defined(NINEBIT_RASTER_LANES_TRIANGLE_BATCH_OUTPUT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_TRIANGLE_BATCH_OUTPUT_INL_H_
#undef NINEBIT_RASTER_LANES_TRIANGLE_BATCH_OUTPUT_INL_H_
#else
#define NINEBIT_RASTER_LANES_TRIANGLE_BATCH_OUTPUT_INL_H_
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwy/highway.h"
#include "src/raster/lanes/triangle_batch.h"
#include "src/raster/lanes/triangle_batch_input-inl.h"
#include "src/raster/lanes/triangle_candidates.h"
#include "src/raster/lanes/triangle_vectors-inl.h"
#include "src/raster/setup/polygon_offset.h"
#include "src/raster/setup/tile_bins.h"
#include "src/raster/setup/window_primitives.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE VD as_double(const std::int32_t* lanes) {
  return hn::PromoteTo(kDD, hn::Load(kHalfI, lanes));
}

// Stores integers, and 0 for NaN, which cannot be converted: lanes beyond the last candidate may hold it.
HWY_INLINE void store_numbers(VD v, std::int32_t* to) {
  hn::Store(hn::DemoteTo(kHalfI, hn::IfThenElseZero(hn::Eq(v, v), v)), kHalfI, to);
}

// The depths of candidates.
struct Depths {
  alignas(64) TriangleCandidates::Lanes corner[3];
  alignas(64) TriangleCandidates::Lanes inv_w[3];
  alignas(64) TriangleCandidates::Lanes pixel;
  alignas(64) TriangleCandidates::Lanes offset, fraction;  // of SetupOffset, with an offset
};

HWY_INLINE void gather_depths(const TriangleBatch& batch, const TriangleCandidates& c, Depths& to) {
  for (std::size_t i = 0; i < c.count; i += hn::Lanes(kDI)) {
    const MI swapped = hn::TestBit(hn::Load(kDI, c.kind + i), set(TriangleCandidates::kSwapped));
    const VI second = hn::Load(kDI, c.vertex[1] + i), third = hn::Load(kDI, c.vertex[2] + i);
    const VI vertex[3] = {hn::Load(kDI, c.vertex[0] + i), hn::IfThenElse(swapped, third, second),
                          hn::IfThenElse(swapped, second, third)};
    for (int k = 0; k < 3; ++k) {
      VI depth, inv_w;
      words_of<2>(batch, vertex[k], depth, batch.context.needs_corners ? &inv_w : nullptr);
      hn::Store(depth, kDI, to.corner[k] + i);
      if (batch.context.needs_corners) hn::Store(inv_w, kDI, to.inv_w[k] + i);
    }
  }
}

// The depth plane at each single pixel with the triangle's fraction, cut: floor((Σ e z + fraction × area) / area)
// (rules 20 and 28). Numerator, the fraction of the area being cut, and denominator are exact; a quotient that is not
// whole is at least 2^-26 from the next whole number, which rounding to 53 bits cannot reach: it is below 2^25.
template <bool kMoved>
HWY_INLINE void find_pixel_depths(const TriangleCandidates& c, const SetupOffset& none, Depths& to) {
  for (std::size_t i = 0; i < c.count; i += hn::Lanes(kDD)) {
    const VD e0 = as_double(c.edge[0] + i), e1 = as_double(c.edge[1] + i), e2 = as_double(c.edge[2] + i);
    const VD area = hn::Add(hn::Add(e0, e1), e2);
    const VD wide = hn::Add(hn::Add(hn::Mul(e0, as_double(to.corner[0] + i)), hn::Mul(e1, as_double(to.corner[1] + i))),
                            hn::Mul(e2, as_double(to.corner[2] + i)));
    const auto with = [&](VD fraction) HWY_ATTR {
      return hn::Add(wide, hn::Floor(hn::Mul(area, hn::Mul(fraction, hn::Set(kDD, 1.0 / (1 << kOffsetBits))))));
    };
    const VD sum = kMoved               ? with(as_double(to.fraction + i))
                   : none.fraction != 0 ? with(hn::Set(kDD, none.fraction))
                                        : wide;
    store_numbers(hn::Div(sum, area), to.pixel + i);
  }
}

// The offset of candidate k, by the function for any triangle.
HWY_INLINE SetupOffset exact_offset(const SetupContext& context, const TriangleCandidates& c, const Depths& d,
                                    std::size_t k) {
  std::array<WindowVertex, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = {.x_q4 = c.x[i][k], .y_q4 = c.y[i][k], .z24 = static_cast<std::uint32_t>(d.corner[i][k])};
  }
  return setup_offset(context.offset, context.offset_rule, v, context.window.depth());
}

HWY_INLINE void store_exact_offset(const SetupContext& context, const TriangleCandidates& c, std::size_t k,
                                   Depths& to) {
  const SetupOffset exact = exact_offset(context, c, to, k);
  to.offset[k] = exact.whole;
  to.fraction[k] = exact.fraction;
}

// The formulas of depth_plane() and polygon_offset_q16(). Calls the latter where the bounds of the sum round to
// different numbers.
HWY_INLINE void find_offsets(const SetupContext& context, const TriangleCandidates& c, Depths& to) {
  const VD factor = hn::Set(kDD, static_cast<double>(context.offset.factor));
  const VD units =
      hn::Set(kDD, static_cast<double>(context.offset.units) * static_cast<double>(context.window.depth().step_z24()));
  const VD limit = hn::Set(kDD, static_cast<double>(kLargestOffset)), sixteen = hn::Set(kDD, 16.0);
  const VD smallest_error = hn::Add(hn::Abs(units), hn::Set(kDD, 1.0));
  const VD scale = hn::Set(kDD, 1 << context.offset_rule.bits()), unit = hn::Div(hn::Set(kDD, 1.0), scale);
  const VD rounding = hn::Set(kDD, context.window.depth().cuts() ? 0.0 : 0.5);
  for (std::size_t i = 0; i < c.count; i += hn::Lanes(kDD)) {
    const auto difference = [i](const TriangleCandidates::Lanes(&v)[3], int k)
                                HWY_ATTR { return hn::Sub(as_double(v[k] + i), as_double(v[0] + i)); };
    const VD bx = difference(c.x, 1), by = difference(c.y, 1), cx = difference(c.x, 2), cy = difference(c.y, 2);
    const VD bz = difference(to.corner, 1), cz = difference(to.corner, 2);
    const VD area = hn::Abs(hn::Sub(hn::Mul(bx, cy), hn::Mul(by, cx)));
    const VD dx = hn::Mul(sixteen, hn::Abs(hn::Sub(hn::Mul(bz, cy), hn::Mul(cz, by))));
    const VD dy = hn::Mul(sixteen, hn::Abs(hn::Sub(hn::Mul(bx, cz), hn::Mul(cx, bz))));
    VD m = hn::Div(hn::Max(dx, dy), area);
    if (context.offset_rule.slope == OffsetSlope::root) {
      const VD sx = hn::Div(dx, area), sy = hn::Div(dy, area);
      m = hn::Sqrt(hn::Add(hn::Mul(sx, sx), hn::Mul(sy, sy)));
    }
    const VD moved = hn::Mul(factor, m), sum = hn::Add(moved, units);
    const VD error = hn::Mul(hn::Set(kDD, kOffsetError), hn::Add(hn::Abs(moved), smallest_error));
    const auto rounded = [limit, scale](VD v) HWY_ATTR {
      return hn::Floor(hn::Add(hn::Mul(hn::Min(hn::Max(v, hn::Neg(limit)), limit), scale), hn::Set(kDD, 0.5)));
    };
    const VD low = rounded(hn::Sub(sum, error)), high = rounded(hn::Add(sum, error));
    // The numbers of SetupOffset.
    const VD offset = hn::Add(hn::Mul(low, unit), rounding), whole = hn::Floor(offset);
    store_numbers(whole, to.offset + i);
    store_numbers(hn::Mul(hn::Sub(offset, whole), hn::Set(kDD, 1 << kOffsetBits)), to.fraction + i);
    if (HWY_LIKELY(hn::AllTrue(kDD, hn::Eq(low, high)))) continue;
    const std::size_t end = i + hn::Lanes(kDD) < c.count ? i + hn::Lanes(kDD) : c.count;
    for (std::size_t k = i; k < end; ++k) store_exact_offset(context, c, k, to);
  }
}

// Copies `count` records. Each consists of kRows groups of four words; the groups of one row of all records lie side by
// side.
template <std::size_t kRows, class Record>
HWY_INLINE void copy_rows(const std::int32_t (&rows)[kRows][4 * 16], std::size_t count, Record* to) {
  constexpr std::size_t kRow = 16;
  static_assert(sizeof(Record) == kRow * kRows);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t r = 0; r < kRows; ++r) {
      std::memcpy(reinterpret_cast<unsigned char*>(to + k) + kRow * r, rows[r] + 4 * k, kRow);
    }
  }
}

// SetupCorners::corner as a word: a clockwise triangle has its second and third corner swapped.
constexpr int kCorners = 0x020100, kSwappedCorners = 0x010200;

HWY_INLINE void write_corners(const TriangleCandidates& c, const Depths& d, std::size_t i, std::size_t count,
                              SetupCorners* to) {
  static_assert(offsetof(SetupCorners, weights) == 12 && offsetof(SetupCorners, corner) == 28);
  const auto load = [i](const TriangleCandidates::Lanes& lanes) HWY_ATTR { return hn::Load(kDI, lanes + i); };
  alignas(64) std::int32_t rows[2][4 * 16];
  const VI corner =
      hn::IfThenElse(hn::TestBit(load(c.kind), set(TriangleCandidates::kSwapped)), set(kSwappedCorners), set(kCorners));
  hn::StoreInterleaved4(load(d.inv_w[0]), load(d.inv_w[1]), load(d.inv_w[2]),
                        set(static_cast<std::int32_t>(kNoWeights)), kDI, rows[0]);
  hn::StoreInterleaved4(load(c.vertex[0]), load(c.vertex[1]), load(c.vertex[2]), corner, kDI, rows[1]);
  copy_rows(rows, count, to);
}

// The first three records of a SetupPrimitive, of four words each: box and kind, depths and offset, positions.
using PrimitiveRows = std::int32_t[3][4 * 16];

// The candidates from i on as PrimitiveRows. Those without an offset, not kMoved, have `none`.
template <bool kMoved>
HWY_INLINE void interleave(const TriangleCandidates& c, const Depths& d, const SetupOffset& none, std::size_t i,
                           PrimitiveRows& rows) {
  static_assert(offsetof(SetupPrimitive, kind) == 12 && offsetof(SetupPrimitive, fraction) == 14 &&
                offsetof(SetupPrimitive, z24) == 16 && offsetof(SetupPrimitive, position) == 32);
  static_assert(std::endian::native == std::endian::little);
  const auto load = [i](const TriangleCandidates::Lanes& lanes) HWY_ATTR { return hn::Load(kDI, lanes + i); };
  const VI offset = kMoved ? load(d.offset) : set(none.whole),
           fraction = kMoved ? load(d.fraction) : set(none.fraction);
  const VI kind = hn::Or(hn::And(load(c.kind), set(0xFFFF)), hn::ShiftLeft<16>(fraction));
  hn::StoreInterleaved4(load(c.low), load(c.high), load(c.primitive), kind, kDI, rows[0]);
  const MI is_pixel = hn::Ne(hn::And(kind, set(0xFF)), set(0));
  const VI pixel = load(d.pixel);
  const auto depth = [&](int k) HWY_ATTR { return hn::IfThenElse(is_pixel, pixel, load(d.corner[k])); };
  hn::StoreInterleaved4(depth(0), depth(1), depth(2), offset, kDI, rows[1]);
  constexpr int kLow = PackedPositions::kLow, kHigh = PackedPositions::kHigh;
  VI word[3], high_y = set(0);
  for (int k = 0; k < 3; ++k) {
    const VI y = load(c.y[k]), high_part = hn::And(hn::ShiftRight<kLow>(y), set((1 << kHigh) - 1));
    word[k] = hn::Or(hn::ShiftLeft<kLow>(load(c.x[k])), hn::And(y, set((1 << kLow) - 1)));
    high_y = hn::Or(high_y, hn::ShiftLeftSame(high_part, kHigh * k));
  }
  hn::StoreInterleaved4(word[0], word[1], word[2], high_y, kDI, rows[2]);
}

// The tiles of boxes, or kSeveralTiles.
HWY_INLINE VI tiles_of(VI low, VI high, int tile_columns) {
  static_assert(kTileSize == 64);
  const auto tile_at = [tile_columns](VI corner) HWY_ATTR {
    const VI row = hn::Mul(hn::ShiftRight<22>(corner), set(tile_columns));
    return hn::Add(row, hn::ShiftRight<6>(hn::And(corner, set(0xFFFF))));
  };
  const VI tile = tile_at(low);
  return hn::IfThenElse(hn::Eq(tile, tile_at(high)), tile, set(static_cast<std::int32_t>(kSeveralTiles)));
}

// Finds the depths of single pixels, writes the candidates where `out` points, and moves `out` behind them.
template <bool kMoved>
HWY_INLINE void write(const TriangleBatch& batch, const TriangleCandidates& c, Depths& d, TriangleBatchOutput& out) {
  const SetupOffset none = batch.context.no_offset();
  if (c.has_pixels) find_pixel_depths<kMoved>(c, none, d);
  for (std::size_t i = 0; i < c.count; i += hn::Lanes(kDI)) {
    alignas(64) PrimitiveRows rows;
    interleave<kMoved>(c, d, none, i, rows);
    const std::size_t count = c.count - i < hn::Lanes(kDI) ? c.count - i : hn::Lanes(kDI);
    alignas(64) std::int32_t tiles[16];
    hn::Store(tiles_of(hn::Load(kDI, c.low + i), hn::Load(kDI, c.high + i), batch.tile_columns), kDI, tiles);
    std::memcpy(out.tile, tiles, count * sizeof(std::int32_t));
    copy_rows(rows, count, out.primitives);
    if (out.corners != nullptr) {
      write_corners(c, d, i, count, out.corners);
      out.corners += count;
    }
    out.primitives += count;
    out.tile += count;
  }
}

// Finds the candidates' depths and offsets, writes them, and removes them.
HWY_NOINLINE void write_candidates(const TriangleBatch& batch, TriangleCandidates& c, TriangleBatchOutput& out) {
  if (c.count == 0) return;
  Depths depths;
  gather_depths(batch, c, depths);
  if (!batch.context.is_offset(PolygonMode::fill)) {
    write<false>(batch, c, depths, out);
  } else {
    if (batch.context.window.depth().is_real()) {
      for (std::size_t k = 0; k < c.count; ++k) store_exact_offset(batch.context, c, k, depths);
    } else {
      find_offsets(batch.context, c, depths);
    }
    write<true>(batch, c, depths, out);
  }
  c.count = 0;
  c.has_pixels = false;
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
