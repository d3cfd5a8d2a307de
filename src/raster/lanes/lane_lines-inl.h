// One line or point in a tile: its fragments are found one after the other, and go on in vectors.
#if defined(NINEBIT_RASTER_LANES_LANE_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_LINES_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_LINES_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_LINES_INL_H_
#endif

#include <cstddef>

#include "hwy/highway.h"
#include "src/raster/lanes/fragment_row.h"
#include "src/raster/lanes/lane_gather-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/primitive_draw.h"
#include "src/raster/setup/line_pixels.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// Gathers fragments of a row that may be drawn.
struct RowGatherer {
  const PrimitiveDraw& current;
  const LaneDraw<D>& draw;

  HWY_NOINLINE void operator()(const FragmentRow& row) const {
    const TilePlanes& planes = current.tile.planes;
    const auto place = static_cast<std::size_t>((row.y - planes.bottom) * kTileSize + (row.x - planes.left));
    const V depth = hn::Load(kD, lanes_of(row.depth.data()));
    const M mask = gathered<OneRow>(kD, draw, current, place, hn::FirstN(kD, row.count), depth);
    if (hn::AllFalse(kD, mask)) return;
    VF weight[3];
    for (std::size_t i = 0; i < 3; ++i) {
      weight[i] = hn::Mul(hn::Load(kDF, row.edge[i].data()), hn::Set(kDF, current.corners->inv_w[i]));
    }
    LaneFragments& batch = current.tile.fragments.gathering();
    const V coverage = hn::Load(kD, lanes_of(row.coverage.data()));
    // The next fragments overwrite what follows the last lane.
    hn::StoreU(hn::Compress(coverage, mask), kD, lanes_of(batch.coverage.data()) + batch.count);
    push<OneRow>(kD, current, place, mask, depth, weight);
  }
};

HWY_NOINLINE void gather_line_or_point(const PrimitiveDraw& current) {
  const DrawContext& context = current.pass.context;
  const LaneDraw<D> draw(kD, current.pass.operations, current.primitive.front_facing);
  FragmentRows<kLaneCount, RowGatherer> rows(RowGatherer{current, draw});
  draw_line_or_point(context.state, current.tile.planes.pixels, current.primitive, context.depth, rows);
  rows.end();
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
