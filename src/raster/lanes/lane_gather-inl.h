// Vectors of fragments into a batch.
#if defined(NINEBIT_RASTER_LANES_LANE_GATHER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_GATHER_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_GATHER_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_GATHER_INL_H_
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_depth-inl.h"
#include "src/raster/lanes/lane_operations-inl.h"
#include "src/raster/lanes/lane_rows-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/primitive_draw.h"
#include "src/raster/lanes/tile_triangles.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// Calls visit(row, bits) for the rows of the tile in which lanes of the mask lie, with a bit for each column.
template <class Rows, class D, class Visit>
HWY_INLINE void for_rows(D d, std::size_t place, hn::Mask<D> mask, Visit visit) {
  constexpr std::size_t kColumns = hn::MaxLanes(D()) / Rows::kRows;
  std::uint64_t bits = bits_of(d, mask);
  const std::size_t column = place % kTileSize;
  for (std::size_t r = 0; r < Rows::kRows; ++r, bits >>= kColumns) {
    visit(place / kTileSize + r, (bits & ((std::uint64_t{1} << kColumns) - 1)) << column);
  }
}

// The fragments of the mask that the pass's stipple pattern draws: it leaves lines and points alone.
template <class Rows, class D>
HWY_INLINE hn::Mask<D> stippled(D d, const PrimitiveDraw& current, std::size_t place, hn::Mask<D> mask) {
  if (current.primitive.kind == SetupKind::line || current.primitive.kind == SetupKind::point) return mask;
  const auto drawn = Rows::load(d, lanes_of(current.pass.stipple->data()) + place);
  return hn::And(mask, hn::Ne(drawn, hn::Zero(d)));
}

// The fragments that have to go into the batch. Flushes the batch if it has no room for them, or has other fragments at
// their pixels.
template <class Rows, class D>
HWY_INLINE hn::Mask<D> gathered(D d, const LaneDraw<D>& draw, const PrimitiveDraw& current, std::size_t place,
                                hn::Mask<D> mask, hn::Vec<D> depth) {
  const LaneOperations& operations = draw.operations;
  LaneTile& tile = current.tile;
  const std::int32_t* const at = lanes_of(tile.planes.depth_stencil.data()) + place;
  const auto any_overlaps = [&](hn::Mask<D> lanes) HWY_ATTR {
    bool any = false;
    for_rows<Rows>(d, place, lanes, [&](std::size_t row, std::uint64_t bits) HWY_ATTR {
      any = any || tile.fragments.overlaps(row, bits);
    });
    return any;
  };
  if (operations.asks_equal_depth) {
    const auto stored = Rows::load(d, at);
    mask = hn::And(mask, has_depth(d, stored, depth));
    if (current.pass.gathers_by_stencil()) mask = hn::And(mask, stencil_passes(d, draw, stored));
  } else {
    if (HWY_UNLIKELY(operations.stipples)) mask = stippled<Rows>(d, current, place, mask);
    // Fragments in the batch may still change the outcome of tests.
    if (operations.tests_change && any_overlaps(mask)) flush_lanes(tile, current.pass);
    mask = not_lost(d, draw, mask, depth, Rows::load(d, at));
  }
  if (any_overlaps(mask) || tile.fragments.gathering().count + hn::Lanes(d) > kBatchSize)
    flush_lanes(tile, current.pass);
  for_rows<Rows>(d, place, mask,
                 [&](std::size_t row, std::uint64_t bits) HWY_ATTR { tile.fragments.occupy(row, bits); });
  return mask;
}

// Begins a run of the primitive's fragments, unless the last fragments are its own.
HWY_INLINE void begin_run(LaneFragments& batch, const PrimitiveDraw& current) {
  if (batch.runs == 0 || batch.run[batch.runs - 1].primitive != &current.primitive) {
    batch.run[batch.runs++] = {&current.primitive, current.corners, current.block.weights_of(*current.corners),
                               batch.count};
  }
}

// Adds the fragments of the mask to the batch.
template <class Rows, class D>
HWY_INLINE void push(D d, const PrimitiveDraw& current, std::size_t place, hn::Mask<D> mask, hn::Vec<D> depth,
                     const hn::Vec<hn::Rebind<float, D>> weight[3]) {
  LaneFragments& batch = current.tile.fragments.gathering();
  const hn::Rebind<float, D> df;
  const std::size_t at = batch.count;
  begin_run(batch, current);
  std::size_t span_first = at;
  for_rows<Rows>(d, place, mask, [&](std::size_t row, std::uint64_t bits) HWY_ATTR {
    while (bits != 0) {  // one span, in most rows
      const auto begin = static_cast<std::size_t>(__builtin_ctzll(bits));
      const auto length = static_cast<std::size_t>(__builtin_ctzll(~(bits >> begin)));
      batch.span[batch.spans++] = {static_cast<std::uint16_t>(row * kTileSize + begin),
                                   static_cast<std::uint8_t>(length), static_cast<std::uint16_t>(span_first)};
      span_first += length;
      bits = begin + length < 64 ? bits >> (begin + length) << (begin + length) : 0;
    }
  });
  batch.count = span_first;
  const auto places = hn::Add(hn::Set(d, static_cast<std::int32_t>(place)), Rows::places(d));
  const bool has_depth = !current.pass.operations.are_tests_final;
  float* const weights = batch.weight[0].data() + at;
  const std::size_t stride = LaneFragments::kRoom;
  const auto& corner = current.corners->corner;
  if (hn::AllTrue(d, mask)) {
    hn::StoreU(places, d, lanes_of(batch.place.data()) + at);
    if (has_depth) hn::StoreU(depth, d, lanes_of(batch.depth.data()) + at);
    for (std::size_t i = 0; i < 3; ++i) hn::StoreU(weight[i], df, weights + corner[i] * stride);
  } else {
    // Compressed in registers, as compressing to memory is slow on some processors. The next fragments overwrite what
    // follows the last lane.
    hn::StoreU(hn::Compress(places, mask), d, lanes_of(batch.place.data()) + at);
    if (has_depth) hn::StoreU(hn::Compress(depth, mask), d, lanes_of(batch.depth.data()) + at);
    const auto float_mask = hn::RebindMask(df, mask);
    for (std::size_t i = 0; i < 3; ++i) {
      hn::StoreU(hn::Compress(weight[i], float_mask), df, weights + corner[i] * stride);
    }
  }
}

// Fragments of triangle k in one row.
struct RowFragments {
  int y;
  std::size_t place;   // in the tile, of the region's first pixel in the row
  const V* inside;     // of all three edges, from that pixel on
  std::uint64_t bits;  // for each fragment, from that pixel on
};

// Puts the fragments of a row into the batch, span by span, without tests.
HWY_INLINE void push_row(const PrimitiveDraw& current, const TileTriangles& t, std::size_t k, const RowFragments& row) {
  FragmentReuse& fragments = current.tile.fragments;
  const std::size_t tile_row = row.place / kTileSize;
  const std::uint64_t columns = row.bits << row.place % kTileSize;
  const auto count = static_cast<std::size_t>(std::popcount(row.bits));
  if (fragments.overlaps(tile_row, columns) || fragments.gathering().count + count > kBatchSize) {
    flush_lanes(current.tile, current.pass);
  }
  fragments.occupy(tile_row, columns);
  LaneFragments& batch = fragments.gathering();
  begin_run(batch, current);
  // Copies: the compiler would read them again for each vector, because what is stored might alias them.
  const bool is_narrow = t.is_narrow[k];
  float* weight[3];
  V step[3];
  VF inv_w[3];
  for (std::size_t i = 0; i < 3; ++i) {
    weight[i] = batch.weight[current.corners->corner[i]].data() + batch.count;
    step[i] = hn::Set(kD, t.inside_x[i][k] * kLanes);
    inv_w[i] = hn::Set(kDF, current.corners->inv_w[i]);
  }
  for (std::uint64_t bits = row.bits; bits != 0; bits &= bits + (bits & -bits)) {
    const int first = std::countr_zero(bits), end = first + std::countr_one(bits >> first);
    const auto count_of_span = static_cast<std::size_t>(end - first);
    const std::size_t place = row.place + static_cast<std::size_t>(first);
    batch.span[batch.spans++] = {static_cast<std::uint16_t>(place), static_cast<std::uint8_t>(count_of_span),
                                 static_cast<std::uint16_t>(batch.count)};
    V places = hn::Add(hn::Set(kD, static_cast<std::int32_t>(place)), lane_numbers(kD));
    V edge[3];
    for (std::size_t i = 0; i < 3; ++i) {
      edge[i] = hn::Add(row.inside[i], hn::Set(kD, t.inside_x[i][k] * first + t.threshold[i][k]));
    }
    // The next fragments overwrite what follows the last lane.
    std::int32_t* const place_at = lanes_of(batch.place.data()) + batch.count;
    for (std::size_t at = 0; at < count_of_span; at += kLaneCount) {
      hn::StoreU(places, kD, place_at + at);
      places = hn::Add(places, hn::Set(kD, kLanes));
      for (std::size_t i = 0; i < 3; ++i) {
        const VF e = HWY_LIKELY(is_narrow) ? hn::ConvertTo(kDF, edge[i])
                                           : wide_edge(t, k, i, t.left[k] + first + static_cast<int>(at), row.y);
        hn::StoreU(hn::Mul(e, inv_w[i]), kDF, weight[i] + at);
        edge[i] = hn::Add(edge[i], step[i]);
      }
    }
    for (float*& to : weight) to += count_of_span;
    batch.count += count_of_span;
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
