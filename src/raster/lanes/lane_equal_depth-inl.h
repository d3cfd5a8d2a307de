// Gathers one triangle row by row, in passes whose tests are decided while gathering.
#if defined(NINEBIT_RASTER_LANES_LANE_EQUAL_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_EQUAL_DEPTH_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_EQUAL_DEPTH_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_EQUAL_DEPTH_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_triangle-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/primitive_draw.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// How a row's fragments are found: by the tile's owners; by depth (asks_equal_depth); all that are covered
// (tests_nothing).
enum class Finding { by_owners, by_depths, all };

// Gathers the fragments of triangle k, a whole row at a time.
template <Finding kFinding, class Draw>
HWY_NOINLINE void gather_rows(const Draw& current, const TileTriangles& t, std::size_t k) {
  const LaneDraw<D> draw(kD, current.pass.operations, current.primitive.front_facing);
  const bool by_stencil = current.pass.gathers_by_stencil();
  const V lane = lane_numbers(kD);
  V row[3], step[3], up[3];
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = hn::Add(hn::Set(kD, t.inside[i][k]), hn::Mul(lane, hn::Set(kD, t.inside_x[i][k])));
    step[i] = hn::Set(kD, t.inside_x[i][k] * kLanes);
    up[i] = hn::Set(kD, t.inside_y[i][k]);
  }
  DepthLanes z(t, k);
  const bool all_inside = kFinding == Finding::all && is_full(t, k);
  const int left = t.left[k], columns = t.right[k] - left + 1, top = t.top[k];
  // The triangle may reach beyond the end of the region.
  const std::uint64_t region = ~std::uint64_t{0} >> (kTileSize - columns);
  auto row_place = first_place(current, t, k);
  const std::int32_t* const stored = lanes_of(current.tile.planes.depth_stencil.data());
  const std::int32_t* const owner = lanes_of(current.tile.owners.number.data());
  const V number = hn::Set(kD, static_cast<std::int32_t>(current.number));
  for (int y = t.bottom[k];; ++y, row_place += kTileSize) {
    V e[3] = {row[0], row[1], row[2]};
    V64 z_low = z.row;
    std::uint64_t bits = all_inside ? ~std::uint64_t{0} : 0;
    for (int column = 0; column < columns && !all_inside; column += kLanes) {
      if constexpr (kFinding == Finding::by_owners) {
        const std::size_t at = row_place + static_cast<std::size_t>(column);
        M mask = hn::Eq(hn::LoadU(kD, owner + at), number);
        if (by_stencil) mask = hn::And(mask, stencil_passes(kD, draw, hn::LoadU(kD, stored + at)));
        bits |= bits_of(kD, mask) << column;
        continue;
      }
      M mask = hn::Gt(hn::Or(hn::Or(e[0], e[1]), e[2]), hn::Set(kD, -1));
      if constexpr (kFinding == Finding::all) {
        bits |= bits_of(kD, mask) << column;
      } else if (!hn::AllFalse(kD, mask)) {
        const V z24 = find_depths<OneRow>(current, left + column, y, mask, z_low, hn::Add(z_low, z.half));
        const V depth = depth_codes(kD, current.pass, current.primitive, z24);
        const V here = hn::LoadU(kD, stored + row_place + static_cast<std::size_t>(column));
        mask = hn::And(mask, has_depth(kD, here, depth));
        if (by_stencil) mask = hn::And(mask, stencil_passes(kD, draw, here));
        bits |= bits_of(kD, mask) << column;
      }
      for (std::size_t i = 0; i < 3; ++i) e[i] = hn::Add(e[i], step[i]);
      z_low = hn::Add(z_low, z.step);
    }
    bits &= region;
    if (bits != 0) push_row(current, t, k, {y, row_place, row, bits});
    if (y == top) break;
    for (std::size_t i = 0; i < 3; ++i) row[i] = hn::Add(row[i], up[i]);
    z.row = hn::Add(z.row, z.up);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
