// One triangle in a tile, vector by vector.
#if defined(NINEBIT_RASTER_LANES_LANE_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_TRIANGLE_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_TRIANGLE_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_TRIANGLE_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_depth-inl.h"
#include "src/raster/lanes/lane_gather-inl.h"
#include "src/raster/lanes/lane_operations-inl.h"
#include "src/raster/lanes/lane_rows-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/primitive_draw.h"
#include "src/raster/lanes/tile_triangles.h"
#include "src/raster/surface/tile_size.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// A vector of pixels of one triangle. `Inside` is V or VF: the form of the coverage values.
template <class Inside>
struct PixelVector {
  int x, y;           // the first lane's pixel
  std::size_t place;  // and its place in the tile
  M mask;             // the lanes that the triangle covers
  V64 z_low, z_high;  // both halves of the depths, see DepthLanes
  Inside inside[3];   // see TileTriangles
};

// Draws the fragments of the mask with one colour, through the fragment operations.
template <class Rows, class D>
HWY_INLINE void draw_flat(D d, const LaneDraw<D>& draw, const PrimitiveDraw& current, std::size_t place,
                          hn::Mask<D> mask, hn::Vec<D> depth) {
  const LaneOperations& operations = draw.operations;
  if (HWY_UNLIKELY(operations.stipples)) mask = stippled<Rows>(d, current, place, mask);
  std::int32_t* const at = lanes_of(current.tile.planes.depth_stencil.data()) + place;
  const auto color = hn::Set(d, static_cast<std::int32_t>(current.color));
  const auto alpha = hn::Set(d, static_cast<std::int32_t>(current.alpha));
  const LaneResult<D> result = apply_lanes(d, draw, mask, depth, alpha, Rows::load(d, at));
  if (operations.depth_write || operations.stencil_write) Rows::store(result.depth_stencil, d, at);
  if (!operations.color) return;
  std::int32_t* const color_at = lanes_of(current.tile.planes.color.data()) + place;
  const auto there = Rows::load(d, color_at);
  // Colours that are not blended are those that are stored.
  const auto after = HWY_UNLIKELY(operations.blends) ? stored_colors(d, operations, color, there) : color;
  Rows::store(hn::IfThenElse(result.drawn, after, there), d, color_at);
}

// Draws the fragments of the mask that are nearer than what is stored. kNoted: Drawing::noted.
template <bool kNoted, class Rows>
HWY_INLINE void draw_nearest(const LaneDraw<D>& draw, const PrimitiveDraw& current, std::size_t place, M mask, V z24) {
  std::int32_t* const at = lanes_of(current.tile.planes.depth_stencil.data()) + place;
  const V stored = Rows::load(kD, at);
  const V stored_depth = hn::BitCast(kD, hn::ShiftRight<8>(hn::BitCast(hn::RebindToUnsigned<D>(), stored)));
  const M drawn = hn::And(mask, hn::Lt(z24, stored_depth));
  Rows::blend(hn::Or(hn::ShiftLeft<8>(z24), hn::And(stored, hn::Set(kD, 0xFF))), drawn, kD, at);
  if constexpr (kNoted) {
    const M equal = hn::And(mask, hn::Eq(z24, stored_depth));
    if (HWY_UNLIKELY(!hn::AllFalse(kD, equal))) current.tile.owners.are_known = false;
    Rows::put(hn::Set(kD, static_cast<std::int32_t>(current.number)), drawn, kD,
              lanes_of(current.tile.owners.number.data()) + place);
  }
  if (draw.operations.color) {
    Rows::put(hn::Set(kD, static_cast<std::int32_t>(current.color)), drawn, kD,
              lanes_of(current.tile.planes.color.data()) + place);
  }
}

// Gathers the fragments of a vector that may be drawn.
template <class Rows, class Inside>
HWY_INLINE void gather_fragments(const LaneDraw<D>& draw, const PrimitiveDraw& current, const TileTriangles& t,
                                 std::size_t k, const PixelVector<Inside>& at, V z24) {
  const V depth = depth_codes(kD, current.pass, current.primitive, z24);
  const M mask = gathered<Rows>(kD, draw, current, at.place, at.mask, depth);
  if (hn::AllFalse(kD, mask)) return;
  VF weight[3];
  for (std::size_t i = 0; i < 3; ++i) {
    weight[i] = hn::Mul(edge_at(t, k, i, at.x, at.y, at.inside[i]), hn::Set(kDF, current.corners->inv_w[i]));
  }
  push<Rows>(kD, current, at.place, mask, depth, weight);
}

// Draws or gathers the fragments of a vector of triangle k. `Draw` is PrimitiveDraw or RealPrimitiveDraw, here and
// below.
template <Drawing kDrawing, class Rows, class Draw, class Inside>
HWY_INLINE void draw_fragments(const LaneDraw<D>& draw, const Draw& current, const TileTriangles& t, std::size_t k,
                               const PixelVector<Inside>& at) {
  const LaneOperations& operations = draw.operations;
  const bool needs_depth = kDrawing != Drawing::gathers || operations.depth || !operations.are_tests_final;
  const V z24 = needs_depth ? find_depths<Rows>(current, at.x, at.y, at.mask, at.z_low, at.z_high) : hn::Zero(kD);
  if constexpr (is_nearest(kDrawing)) {
    draw_nearest<kDrawing == Drawing::noted, Rows>(draw, current, at.place, at.mask, z24);
  } else if constexpr (kDrawing == Drawing::flat) {
    draw_flat<Rows>(kD, draw, current, at.place, at.mask, depth_codes(kD, current.pass, current.primitive, z24));
  } else {
    gather_fragments<Rows>(draw, current, t, k, at, z24);
  }
}

// The place in the tile of the lowest left pixel of triangle k's region.
HWY_INLINE std::size_t first_place(const PrimitiveDraw& current, const TileTriangles& t, std::size_t k) {
  const TilePlanes& planes = current.tile.planes;
  return static_cast<std::size_t>((t.bottom[k] - planes.bottom) * kTileSize + (t.left[k] - planes.left));
}

// True if triangle k covers all of its region: its edge functions are not negative at the corners.
HWY_INLINE bool is_full(const TileTriangles& t, std::size_t k) {
  const std::int64_t columns = t.right[k] - t.left[k], rows = t.top[k] - t.bottom[k];
  std::int64_t signs = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    signs |= t.inside[i][k] + std::min<std::int64_t>(t.inside_x[i][k] * columns, 0) +
             std::min<std::int64_t>(t.inside_y[i][k] * rows, 0);
  }
  return signs >= 0;
}

// How a triangle fills the vectors of its region's rows: it is_full(); those without a fragment are skipped, or not.
enum class Filling { full, skipping, drawing_all };

// True where a vector without a fragment costs less than a branch that cannot be predicted: measured with AVX2. Depths
// that are real numbers cost more.
template <Drawing kDrawing, class Draw>
inline constexpr bool kDrawsEmpty = is_nearest(kDrawing) && kLanes == 8 && std::is_same_v<Draw, PrimitiveDraw>;

// Draws triangle k row by row.
template <Drawing kDrawing, Filling kFilling, class Draw>
HWY_NOINLINE void draw_triangle(const Draw& current, const TileTriangles& t, std::size_t k) {
  const LaneDraw<D> draw(kD, current.pass.operations, current.primitive.front_facing);
  const V lane = lane_numbers(kD);
  V row[3], step[3], up[3];
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = hn::Add(hn::Set(kD, t.inside[i][k]), hn::Mul(lane, hn::Set(kD, t.inside_x[i][k])));
    step[i] = hn::Set(kD, t.inside_x[i][k] * kLanes);
    up[i] = hn::Set(kD, t.inside_y[i][k]);
  }
  DepthLanes z(t, k);
  const int left = t.left[k], right = t.right[k], top = t.top[k];
  // The triangle may reach beyond the end of the region.
  const M last = hn::FirstN(kD, static_cast<std::size_t>((right - left) % kLanes + 1));
  constexpr bool kFull = kFilling == Filling::full;
  constexpr bool kReadsEdges = !kFull || kDrawing == Drawing::gathers;
  auto row_place = first_place(current, t, k);
  for (int y = t.bottom[k];; ++y, row_place += kTileSize) {
    V e[3] = {row[0], row[1], row[2]};
    V64 z_low = z.row;
    std::size_t place = row_place;
    for (int x = left;; x += kLanes, place += kLanes) {
      const bool is_last = x + kLanes > right;
      M mask = is_last ? last : hn::FirstN(kD, kLaneCount);
      if (!kFull) mask = hn::AndNot(hn::Lt(hn::Or(hn::Or(e[0], e[1]), e[2]), hn::Zero(kD)), mask);
      if (kFilling != Filling::skipping || !hn::AllFalse(kD, mask)) {
        const PixelVector<V> at{x, y, place, mask, z_low, hn::Add(z_low, z.half), {e[0], e[1], e[2]}};
        draw_fragments<kDrawing, OneRow>(draw, current, t, k, at);
      }
      if (is_last) break;
      for (std::size_t i = 0; i < 3 && kReadsEdges; ++i) e[i] = hn::Add(e[i], step[i]);
      z_low = hn::Add(z_low, z.step);
    }
    if (y == top) break;
    for (std::size_t i = 0; i < 3 && kReadsEdges; ++i) row[i] = hn::Add(row[i], up[i]);
    z.row = hn::Add(z.row, z.up);
  }
}

// Draws triangle k, one row or several at a time. It has_floats, and its region is no wider than a row of Rows.
template <Drawing kDrawing, class Rows, class Draw>
HWY_INLINE void draw_slim_triangle(const Draw& current, const TileTriangles& t, std::size_t k) {
  constexpr int kRows = static_cast<int>(Rows::kRows);
  const LaneDraw<D> draw(kD, current.pass.operations, current.primitive.front_facing);
  const V column = Rows::columns(), row = Rows::rows(kD);
  const auto float_column = hn::ConvertTo(kDF, column), float_row = hn::ConvertTo(kDF, row);
  VF e[3], up[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto step_y = hn::Set(kDF, t.float_inside_y[i][k]);
    const auto in_column = hn::MulAdd(float_row, step_y, hn::Set(kDF, t.float_inside[i][k]));
    e[i] = hn::MulAdd(float_column, hn::Set(kDF, t.float_inside_x[i][k]), in_column);
    up[i] = hn::Mul(step_y, hn::Set(kDF, kRows));
  }
  const V64 z_step = hn::Set(kD64, t.depth_y[k]);
  V64 z_low = hn::Add(hn::Set(kD64, t.depth[k]), Rows::in_lower_half(t.depth_x[k], z_step));
  V64 z_high = hn::Add(z_low, Rows::to_upper_half(t.depth_x[k], z_step));
  const V64 z_up = hn::ShiftLeft<kRows / 2>(z_step);
  const int left = t.left[k], top = t.top[k];
  const M within = hn::Lt(column, hn::Set(kD, t.right[k] - left + 1));
  auto place = first_place(current, t, k);
  for (int y = t.bottom[k];; y += kRows, place += Rows::kRows * kTileSize) {
    // The opposite of `less than 0` would be two operations with AVX2.
    const V outside = hn::BitCast(kD, hn::Or(hn::Or(e[0], e[1]), e[2]));
    M mask = hn::AndNot(hn::Lt(outside, hn::Zero(kD)), within);
    if constexpr (kRows > 1) mask = hn::And(mask, hn::Lt(row, hn::Set(kD, top - y + 1)));
    if (kDrawsEmpty<kDrawing, Draw> || !hn::AllFalse(kD, mask)) {
      const PixelVector<VF> at{left, y, place, mask, z_low, z_high, {e[0], e[1], e[2]}};
      draw_fragments<kDrawing, Rows>(draw, current, t, k, at);
    }
    if (y + kRows > top) break;
    for (std::size_t i = 0; i < 3; ++i) e[i] = hn::Add(e[i], up[i]);
    z_low = hn::Add(z_low, z_up);
    z_high = hn::Add(z_high, z_up);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
