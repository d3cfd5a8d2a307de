// One smoothed triangle in a tile, vector by vector (rule 47).
#if defined(NINEBIT_RASTER_LANES_LANE_SMOOTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_SMOOTH_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_SMOOTH_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_SMOOTH_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_triangle-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/primitive_draw.h"
#include "src/raster/setup/coverage_samples.h"
#include "src/raster/setup/primitive_depth.h"
#include "src/raster/setup/triangle_edges.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// Pixels of one smoothed triangle.
struct SmoothPixels {
  int x, y;           // the first lane's pixel
  std::size_t place;  // and its place in the tile
  M mask;             // with a sample inside
  M centre;           // whose centre is inside
  V covered;          // samples inside
  V edge[3];          // TileTriangles::inside
};

// The depth codes where the centre is outside: of the place whose edge functions are at least 0. Others keep `codes`.
HWY_NOINLINE V depths_beside(const PrimitiveDraw& current, const SmoothPixels& at, V codes) {
  const TriangleEdges edges(current.primitive);
  alignas(64) std::array<std::int32_t, kLaneCount> code;
  hn::Store(codes, kD, code.data());
  for (std::uint64_t bits = bits_of(kD, hn::AndNot(at.centre, at.mask)); bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctzll(bits);
    std::array<std::int64_t, 3> place = edges.at(at.x + lane, at.y);
    for (std::int64_t& share : place) share = std::max(share, std::int64_t{0});
    const PrimitiveDepth depth(current.pass.context.depth, current.primitive, place[0] + place[1] + place[2]);
    code[static_cast<std::size_t>(lane)] = static_cast<std::int32_t>(depth(place));
  }
  return hn::Load(kD, code.data());
}

// Gathers the fragments of a vector that may be drawn. `z24` is right where the centre is inside.
HWY_INLINE void gather_smooth(const LaneDraw<D>& draw, const PrimitiveDraw& current, const TileTriangles& t,
                              std::size_t k, const SmoothPixels& at, V z24) {
  V depth = depth_codes(kD, current.pass, current.primitive, z24);
  const bool needs_depth = draw.operations.depth || !draw.operations.are_tests_final;
  if (needs_depth && !hn::AllFalse(kD, hn::AndNot(at.centre, at.mask))) depth = depths_beside(current, at, depth);
  const M mask = gathered<OneRow>(kD, draw, current, at.place, at.mask, depth);
  if (hn::AllFalse(kD, mask)) return;
  VF weight[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const VF share = hn::Max(edge_at(t, k, i, at.x, at.y, at.edge[i]), hn::Zero(kDF));
    weight[i] = hn::Mul(share, hn::Set(kDF, current.corners->inv_w[i]));
  }
  LaneFragments& batch = current.tile.fragments.gathering();
  const V alpha = hn::ShiftRight<3>(hn::Mul(at.covered, hn::Set(kD, 255)));  // coverage_byte
  // The next fragments overwrite what follows the last lane.
  hn::StoreU(hn::Compress(alpha, mask), kD, lanes_of(batch.coverage.data()) + batch.count);
  push<OneRow>(kD, current, at.place, mask, depth, weight);
}

// Gathers triangle k, placed as a smoothed one. An edge that leaves no sample of the region out has steps of 0.
template <class Draw>
HWY_NOINLINE void draw_smooth_triangle(const Draw& current, const TileTriangles& t, std::size_t k) {
  constexpr std::size_t kSamples = kCoverageSamples.size();
  const LaneDraw<D> draw(kD, current.pass.operations, current.primitive.front_facing);
  V row[3], sample[kSamples][3];  // edge functions at the centres, and what a sample adds
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = hn::Add(hn::Set(kD, t.inside[i][k]), hn::Mul(lane_numbers(kD), hn::Set(kD, t.inside_x[i][k])));
    for (std::size_t s = 0; s < kSamples; ++s) {
      const CoverageSample& at = kCoverageSamples[s];
      sample[s][i] = hn::Set(kD, t.inside_x[i][k] / 16 * at.x_q4 + t.inside_y[i][k] / 16 * at.y_q4);
    }
  }
  DepthLanes z(t, k);
  const int left = t.left[k], right = t.right[k], top = t.top[k];
  auto row_place = first_place(current, t, k);
  for (int y = t.bottom[k]; y <= top; ++y, row_place += kTileSize) {
    V e[3] = {row[0], row[1], row[2]};
    V64 z_low = z.row;
    std::size_t place = row_place;
    for (int x = left; x <= right; x += kLanes, place += kLaneCount) {
      V covered = hn::Set(kD, static_cast<std::int32_t>(kSamples));
      for (const auto& add : sample) {
        const V outside = hn::Or(hn::Or(hn::Add(e[0], add[0]), hn::Add(e[1], add[1])), hn::Add(e[2], add[2]));
        covered = hn::Add(covered, hn::ShiftRight<31>(outside));
      }
      const M region = hn::FirstN(kD, static_cast<std::size_t>(right - x + 1));
      const M mask = hn::And(region, hn::Gt(covered, hn::Zero(kD)));
      if (!hn::AllFalse(kD, mask)) {
        const M centre = hn::And(mask, hn::Gt(hn::Or(hn::Or(e[0], e[1]), e[2]), hn::Set(kD, -1)));
        const V z24 = find_depths<OneRow>(current, x, y, centre, z_low, hn::Add(z_low, z.half));
        gather_smooth(draw, current, t, k, {x, y, place, mask, centre, covered, {e[0], e[1], e[2]}}, z24);
      }
      for (std::size_t i = 0; i < 3; ++i) e[i] = hn::Add(e[i], hn::Set(kD, t.inside_x[i][k] * kLanes));
      z_low = hn::Add(z_low, z.step);
    }
    for (std::size_t i = 0; i < 3; ++i) row[i] = hn::Add(row[i], hn::Set(kD, t.inside_y[i][k]));
    z.row = hn::Add(z.row, z.up);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
