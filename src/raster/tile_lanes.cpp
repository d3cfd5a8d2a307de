#include "src/raster/tile_lanes.h"

#include <algorithm>
#include <cstring>

#include "src/raster/blend.h"
#include "src/raster/tile_triangle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/tile_lanes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // has no wider words than 32 bits in its single lane

void draw_triangles(LaneTile&, const SetupBlock&, std::span<const std::uint32_t>) {}

#else

#include "src/raster/lane_operations.inl"

using D = hn::CappedTag<std::int32_t, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using D1 = hn::CappedTag<std::int32_t, 1>;
using D64 = hn::Repartition<std::int64_t, D>;
using V64 = hn::Vec<D64>;
using DF = hn::Rebind<float, D>;
using DD = hn::Repartition<double, D>;
constexpr D kD;
constexpr D1 kD1;
constexpr D64 kD64;
constexpr DF kDF;
constexpr DD kDD;

// Fragments of one primitive at places of the tile, as far as they are the same for all.
struct Pen {
  LaneTile& tile;
  const SetupPrimitive& primitive;
  const SetupBlock& block;
  std::uint32_t color;  // of a flat result
};

template <class T>
HWY_INLINE std::int32_t* lanes_of(T* words) {
  return reinterpret_cast<std::int32_t*>(words);  // signed and unsigned words may alias
}

// --- without a batch --------------------------------------------------------------------------------------------------

template <class D>
HWY_INLINE void draw_flat(D d, const LaneDraw<D>& draw, const Pen& pen, std::size_t place, hn::Mask<D> mask,
                          hn::Vec<D> depth) {
  const LaneOperations& operations = draw.operations;
  std::int32_t* const at = lanes_of(pen.tile.tile.depth_stencil.data()) + place;
  const auto color = hn::Set(d, static_cast<std::int32_t>(pen.color));
  const auto alpha = hn::Set(d, static_cast<std::int32_t>(pen.color >> 24));
  const LaneResult<D> result = apply_lanes(d, draw, mask, depth, alpha, hn::LoadU(d, at));
  if (operations.depth_write || operations.stencil_write) hn::StoreU(result.depth_stencil, d, at);
  if (!operations.color) return;
  std::int32_t* const color_at = lanes_of(pen.tile.tile.color.data()) + place;
  hn::StoreU(hn::IfThenElse(result.drawn, color, hn::LoadU(d, color_at)), d, color_at);
}

// --- into the batch ---------------------------------------------------------------------------------------------------

template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes.data(), sizeof(bits));
  return bits;
}

// Those of the fragments that have to go into the batch, which then has room for them and no other at their pixels.
template <class D>
HWY_INLINE hn::Mask<D> gathered(D d, const LaneDraw<D>& draw, const Pen& pen, std::size_t place, hn::Mask<D> mask,
                                hn::Vec<D> depth) {
  LaneTile& tile = pen.tile;
  LaneBatch& batch = *tile.batch;
  const std::int32_t* const at = lanes_of(tile.tile.depth_stencil.data()) + place;
  const std::size_t row = place / kTileSize, column = place % kTileSize;
  const bool waits = batch.occupied[row] != 0;
  // What waits may still change the outcome of tests.
  if (waits && tile.operations.tests_change && (batch.occupied[row] & (bits_of(d, mask) << column)) != 0) {
    flush_lanes(tile);
  }
  mask = not_lost(d, draw, mask, depth, hn::LoadU(d, at));
  if (waits && (batch.occupied[row] & (bits_of(d, mask) << column)) != 0) flush_lanes(tile);
  if (batch.count + hn::CountTrue(d, mask) > kBatchSize) flush_lanes(tile);
  return mask;
}

template <class D>
HWY_INLINE void push(D d, const Pen& pen, std::size_t place, hn::Mask<D> mask, hn::Vec<D> depth,
                     const hn::Vec<hn::Rebind<float, D>> weight[3]) {
  LaneBatch& batch = *pen.tile.batch;
  const hn::Rebind<float, D> df;
  if (batch.runs == 0 || batch.run[batch.runs - 1].primitive != &pen.primitive) {
    batch.run[batch.runs++] = {&pen.primitive, &pen.block, batch.count};
  }
  const std::size_t row = place / kTileSize, column = place % kTileSize;
  batch.occupied[row] |= bits_of(d, mask) << column;
  const std::size_t at = batch.count;
  const auto places = hn::Iota(d, static_cast<std::int32_t>(place));
  float* const weights[3] = {batch.weight[pen.primitive.corner[0]].data() + at,
                             batch.weight[pen.primitive.corner[1]].data() + at,
                             batch.weight[pen.primitive.corner[2]].data() + at};
  if (hn::AllTrue(d, mask)) {
    hn::StoreU(places, d, lanes_of(batch.place.data()) + at);
    hn::StoreU(depth, d, lanes_of(batch.depth.data()) + at);
    for (std::size_t i = 0; i < 3; ++i) hn::StoreU(weight[i], df, weights[i]);
  } else {
    hn::CompressStore(places, mask, d, lanes_of(batch.place.data()) + at);
    hn::CompressStore(depth, mask, d, lanes_of(batch.depth.data()) + at);
    const auto float_mask = hn::RebindMask(df, mask);
    for (std::size_t i = 0; i < 3; ++i) hn::CompressStore(weight[i], float_mask, df, weights[i]);
  }
  batch.count += hn::CountTrue(d, mask);
}

// --- triangles --------------------------------------------------------------------------------------------------------

// Window depths as codes of the target, see WindowDepth::code.
template <class D>
HWY_INLINE hn::Vec<D> depth_codes(D d, const LaneTile& tile, const SetupPrimitive& p, hn::Vec<D> z24) {
  const WindowDepth& depth = tile.context.depth;
  if (p.offset_z24 == 0 && depth.step_z24() == 1) return z24;
  constexpr std::int32_t kBeyond = 1 << 25;
  const auto offset = hn::Set(d, std::clamp(p.offset_z24, -kBeyond, kBeyond));
  const auto largest = hn::Set(d, static_cast<std::int32_t>(depth.max_z24()));
  const auto z = hn::Min(hn::Max(hn::Add(z24, offset), hn::Zero(d)), largest);
  const auto step = static_cast<std::int32_t>(depth.step_z24());
  return hn::ShiftRightSame(hn::Add(z, hn::Set(d, step >> 1)), depth.fraction_bits());
}

// The lanes of `doubtful`, asked of the exact plane.
HWY_NOINLINE V exact_depth(const SetupPrimitive& p, int x, int y, M doubtful, V z24) {
  const TriangleEdges edges(p);
  alignas(64) std::array<std::int32_t, 16> z;
  hn::Store(z24, kD, z.data());
  std::uint64_t bits = bits_of(kD, doubtful);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctzll(bits);
    z[static_cast<std::size_t>(lane)] = static_cast<std::int32_t>(edges.z24(edges.at(x + lane, y)));
  }
  return hn::Load(kD, z.data());
}

// Edge functions too large for 32 bits, as floats, from pixel (x, y) on.
HWY_INLINE hn::Vec<DF> wide_edge(const TileTriangle& t, std::size_t i, int x, int y) {
  const hn::Rebind<float, DD> half;
  const double first = t.edge[i] + (x - t.origin_x) * t.edge_x[i] + (y - t.bottom) * t.edge_y[i];
  const auto step = hn::Set(kDD, t.edge_x[i]);
  const auto low = hn::Add(hn::Set(kDD, first), hn::Mul(hn::Iota(kDD, 0.0), step));
  const auto high = hn::Add(low, hn::Mul(hn::Set(kDD, static_cast<double>(hn::Lanes(kDD))), step));
  return hn::Combine(kDF, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
}

// A triangle whose coordinates from the origin on stay below 2^14 sixteenths of a pixel, all in 32 bits; false: it does
// not. Otherwise the same as `place`.
HWY_INLINE bool place_small(TileTriangle& t, const SetupPrimitive& p, bool& is_drawn) {
  using D4 = hn::CappedTag<std::int32_t, 4>;
  const D4 d;
  using V4 = hn::Vec<D4>;
  // The fourth lanes hold whatever follows, and nothing is made of it.
  const V4 x = hn::Sub(hn::LoadU(d, p.x_q4.data()), hn::Set(d, 16 * t.origin_x + 8));
  const V4 y = hn::Sub(hn::LoadU(d, p.y_q4.data()), hn::Set(d, 16 * t.bottom + 8));
  const V4 reach = hn::Max(hn::Abs(x), hn::Abs(y));
  const auto corners = hn::FirstN(d, 3);
  if (!hn::AllFalse(d, hn::And(corners, hn::Gt(reach, hn::Set(d, (1 << 14) - 1))))) return false;
  // Edge i goes from corner i + 1 to corner i + 2; at the origin its function is the cross product of the two.
  const auto next = hn::SetTableIndices(d, std::array<std::int32_t, 4>{1, 2, 0, 3}.data());
  const V4 xa = hn::TableLookupLanes(x, next), ya = hn::TableLookupLanes(y, next);
  const V4 xb = hn::TableLookupLanes(xa, next), yb = hn::TableLookupLanes(ya, next);
  const V4 edge = hn::Sub(hn::Mul(xa, yb), hn::Mul(ya, xb));
  const V4 dx = hn::Sub(xb, xa), dy = hn::Sub(yb, ya);
  const V4 zero = hn::Zero(d), one = hn::Set(d, 1);
  const auto is_in = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Lt(dx, zero)));
  const V4 threshold = hn::IfThenElseZero(hn::Not(is_in), one);
  const V4 step_x = hn::ShiftLeft<4>(hn::Neg(dy)), step_y = hn::ShiftLeft<4>(dx);
  const V4 inside = hn::Sub(edge, threshold);
  const V4 across = hn::Mul(step_x, hn::Set(d, t.right - t.origin_x)), up = hn::Mul(step_y, hn::Set(d, t.top - t.bottom));
  const V4 largest = hn::Add(inside, hn::Add(hn::Max(across, zero), hn::Max(up, zero)));
  is_drawn = hn::AllFalse(d, hn::And(corners, hn::Lt(largest, zero)));
  if (!is_drawn) return true;
  hn::Store(inside, d, t.inside.data());
  hn::Store(step_x, d, t.inside_x.data());
  hn::Store(step_y, d, t.inside_y.data());
  hn::Store(threshold, d, t.threshold.data());
  t.is_narrow = true;
  alignas(16) std::array<std::int32_t, 4> e;
  hn::Store(edge, d, e.data());
  const double area = e[0] + e[1] + e[2];
  t.place_depth(p, 1.0 / area, e[1], e[2], t.inside_x[1], t.inside_x[2], t.inside_y[1], t.inside_y[2]);
  return true;
}

template <bool kGathers>
HWY_NOINLINE void draw_triangle(const Pen& pen) {
  LaneTile& tile = pen.tile;
  const SetupPrimitive& p = pen.primitive;
  TileTriangle t;
  t.left = std::max<int>(p.box.left, tile.pixels.left);
  t.right = std::min<int>(p.box.right, tile.pixels.right - 1);
  t.bottom = std::max<int>(p.box.bottom, tile.pixels.bottom);
  t.top = std::min<int>(p.box.top, tile.pixels.top - 1);
  if (t.left > t.right || t.bottom > t.top) return;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(kD));
  t.origin_x = tile.left + ((t.left - tile.left) & -kLanes);
  bool is_drawn = false;
  if (!place_small(t, p, is_drawn)) is_drawn = t.place(p);
  if (!is_drawn) return;

  const LaneDraw<D> draw(kD, tile.operations, p.front_facing);
  const V lane = hn::Iota(kD, 0);
  V row[3], step[3];
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = hn::Add(hn::Set(kD, t.inside[i]), hn::Mul(lane, hn::Set(kD, t.inside_x[i])));
    step[i] = hn::Set(kD, t.inside_x[i] * kLanes);
  }
  const auto z_lane = hn::Mul(hn::Iota(kDD, 0.0), hn::Set(kDD, t.depth_x));
  V64 z_row = hn::ConvertTo(kD64, hn::Add(hn::Set(kDD, t.depth), z_lane));
  const auto z_half = hn::Set(kD64, static_cast<std::int64_t>(t.depth_x * (kLanes / 2)));
  const auto z_step = hn::Set(kD64, static_cast<std::int64_t>(t.depth_x * kLanes));
  const auto z_up = hn::Set(kD64, static_cast<std::int64_t>(t.depth_y));
  // Fragments outside the scissor lie within the tile's vectors.
  const bool has_sides = tile.pixels.left != tile.left || tile.pixels.right != tile.left + kTileSize;
  const hn::RebindToUnsigned<D> du;
  const auto doubt = hn::Set(du, kDepthDoubt), twice_doubt = hn::Set(du, 2 * kDepthDoubt);

  for (int y = t.bottom; y <= t.top; ++y) {
    V e[3] = {row[0], row[1], row[2]};
    V64 z_low = z_row;
    for (int x = t.origin_x; x <= t.right; x += kLanes) {
      M mask = hn::Gt(hn::Or(hn::Or(e[0], e[1]), e[2]), hn::Set(kD, -1));
      if (has_sides) {
        const V column = hn::Add(lane, hn::Set(kD, x));
        mask = hn::And(mask, hn::And(hn::Gt(column, hn::Set(kD, t.left - 1)), hn::Lt(column, hn::Set(kD, t.right + 1))));
      }
      if (!hn::AllFalse(kD, mask)) {
        const V64 z_high = hn::Add(z_low, z_half);
        const auto low = hn::BitCast(du, z_low), high = hn::BitCast(du, z_high);
        V z24 = hn::BitCast(kD, hn::ConcatOdd(du, high, low));
        M doubtful = mask;
        if (!t.is_depth_exact_only) {
          const auto fraction = hn::ConcatEven(du, high, low);
          doubtful = hn::And(mask, hn::RebindMask(kD, hn::Lt(hn::Add(fraction, doubt), twice_doubt)));
        }
        if (HWY_UNLIKELY(!hn::AllFalse(kD, doubtful))) z24 = exact_depth(p, x, y, doubtful, z24);
        const V depth = depth_codes(kD, tile, p, z24);
        const auto place = static_cast<std::size_t>((y - tile.bottom) * kTileSize + (x - tile.left));
        if constexpr (kGathers) {
          mask = gathered(kD, draw, pen, place, mask, depth);
          if (!hn::AllFalse(kD, mask)) {
            hn::Vec<DF> weight[3];
            for (std::size_t i = 0; i < 3; ++i) {
              const auto edge = t.is_narrow ? hn::ConvertTo(kDF, hn::Add(e[i], hn::Set(kD, t.threshold[i])))
                                            : wide_edge(t, i, x, y);
              weight[i] = hn::Mul(edge, hn::Set(kDF, p.inv_w[i]));
            }
            push(kD, pen, place, mask, depth, weight);
          }
        } else {
          draw_flat(kD, draw, pen, place, mask, depth);
        }
      }
      for (std::size_t i = 0; i < 3; ++i) e[i] = hn::Add(e[i], step[i]);
      z_low = hn::Add(z_low, z_step);
    }
    for (std::size_t i = 0; i < 3; ++i) row[i] = hn::Add(row[i], hn::Set(kD, t.inside_y[i]));
    z_row = hn::Add(z_row, z_up);
  }
}

template <bool kGathers>
HWY_INLINE void draw_pixel(const Pen& pen) {
  const LaneTile& tile = pen.tile;
  const SetupPrimitive& p = pen.primitive;
  const int x = p.box.left, y = p.box.bottom;
  const auto place = static_cast<std::size_t>((y - tile.bottom) * kTileSize + (x - tile.left));
  const auto depth = depth_codes(kD1, tile, p, hn::Set(kD1, static_cast<std::int32_t>(p.pixel_z24)));
  const LaneDraw<D1> draw(kD1, tile.operations, p.front_facing);
  auto mask = hn::FirstN(kD1, 1);
  if constexpr (kGathers) {
    mask = gathered(kD1, draw, pen, place, mask, depth);
    if (hn::AllFalse(kD1, mask)) return;
    const std::array<std::int64_t, 3> edge = TriangleEdges(p).at(x, y);
    const hn::Rebind<float, D1> df;
    hn::Vec<decltype(df)> weight[3];
    for (std::size_t i = 0; i < 3; ++i) weight[i] = hn::Set(df, static_cast<float>(edge[i]) * p.inv_w[i]);
    push(kD1, pen, place, mask, depth, weight);
  } else {
    draw_flat(kD1, draw, pen, place, mask, depth);
  }
}

void draw_triangles(LaneTile& tile, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  for (const std::uint32_t index : indices) {
    const SetupPrimitive& p = block.primitives[index];
    Pen pen{tile, p, block, 0};
    const bool is_pixel = p.kind == SetupKind::pixel;
    if (tile.batch != nullptr) {
      is_pixel ? draw_pixel<true>(pen) : draw_triangle<true>(pen);
      continue;
    }
    if (tile.operations.needs_color()) {
      const ColorBytes color = tile.context.flat_primary(p.primitive);
      std::memcpy(&pen.color, color.data(), 4);
    }
    is_pixel ? draw_pixel<false>(pen) : draw_triangle<false>(pen);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

bool are_lanes_there() {
  return HWY_TARGET != HWY_SCALAR;
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(are_lanes_there);
HWY_EXPORT(draw_triangles);

bool lanes_can_draw(const DrawContext& context, const RenderTarget& target) {
  const PipelineState& state = context.state;
  const VertexArrays& arrays = context.arrays;
  const PrimitiveType type = context.assembly.type();
  if (type == PrimitiveType::points || type == PrimitiveType::lines || type == PrimitiveType::line_strip ||
      type == PrimitiveType::line_loop) {
    return false;
  }
  if (state.front_mode != PolygonMode::fill || state.back_mode != PolygonMode::fill) return false;
  if (!context.outputs.empty() || (state.blend.enabled && !replaces(state.blend))) return false;
  if (!context.has_flat_result) {
    if (context.needs_texture_changes || !arrays.secondary_colors.empty()) return false;
    if (state.fog.enabled && !arrays.fog_factors.empty()) return false;
    if (!context.shades_flat() && state.profile.color_interpolation.value == ColorInterpolation::affine) return false;
  }
  return target.probe == nullptr && HWY_DYNAMIC_DISPATCH(are_lanes_there)();
}

LaneTile::LaneTile(const DrawContext& draw, const RenderTarget& planes)
    : context(draw), target(planes), operations(draw.state, planes) {
  for (std::size_t k = 0; k < 4; ++k) writes_color[k] = draw.state.color_mask[k] && planes.color[k];
  if (!draw.has_flat_result) batch = std::make_unique<LaneBatch>();
}

void draw_lanes(LaneTile& tile, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  if (indices.empty()) return;
  if (!tile.is_loaded) load_tile(tile);
  HWY_DYNAMIC_DISPATCH(draw_triangles)(tile, block, indices);
}

}  // namespace ninebit
#endif
