#include "src/raster/lanes/tile_lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

#include "src/raster/fragment/blend.h"
#include "src/raster/lanes/tile_triangles.h"
#include "src/raster/setup/triangle_edges.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/tile_lanes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // has no wider words than 32 bits in its single lane

void draw_triangles(LaneTile&, LanePass&, const SetupBlock&, std::span<const std::uint32_t>) {}

#else

#include "src/raster/lanes/lane_operations.inl"

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
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kD));

// Fragments of one primitive at places of the tile, as far as they are the same for all.
struct Pen {
  LaneTile& tile;
  LanePass& pass;
  const SetupPrimitive& primitive;
  const SetupBlock& block;
  const SetupCorners* corners;  // unless the result is flat
  std::uint32_t color;          // of a flat result
  std::uint32_t number;         // see LaneTile::knows_owners
};

HWY_INLINE hn::Vec<DD> real_lane_numbers() {
  alignas(64) static constexpr std::array<double, 8> kNumbers{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  return hn::Load(kDD, kNumbers.data());
}

#include "src/raster/lanes/lane_rows.inl"

template <class Rows, class D>
HWY_INLINE void draw_flat(D d, const LaneDraw<D>& draw, const Pen& pen, std::size_t place, hn::Mask<D> mask,
                          hn::Vec<D> depth) {
  const LaneOperations& operations = draw.operations;
  std::int32_t* const at = lanes_of(pen.tile.tile.depth_stencil.data()) + place;
  const auto color = hn::Set(d, static_cast<std::int32_t>(pen.color));
  const auto alpha = hn::Set(d, static_cast<std::int32_t>(pen.color >> 24));
  const LaneResult<D> result = apply_lanes(d, draw, mask, depth, alpha, Rows::load(d, at));
  if (operations.depth_write || operations.stencil_write) Rows::store(result.depth_stencil, d, at);
  if (!operations.color) return;
  std::int32_t* const color_at = lanes_of(pen.tile.tile.color.data()) + place;
  Rows::store(hn::IfThenElse(result.drawn, color, Rows::load(d, color_at)), d, color_at);
}

#include "src/raster/lanes/lane_gather.inl"

// The lanes of `doubtful`, asked of the exact plane.
template <class Rows>
HWY_NOINLINE V exact_depth(const SetupPrimitive& p, int x, int y, M doubtful, V z24) {
  const TriangleEdges edges(p);
  alignas(64) std::array<std::int32_t, 16> z;
  hn::Store(z24, kD, z.data());
  std::uint64_t bits = bits_of(kD, doubtful);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctzll(bits);
    z[static_cast<std::size_t>(lane)] =
        static_cast<std::int32_t>(edges.z24(edges.at(x + Rows::column(lane), y + Rows::row(lane))));
  }
  return hn::Load(kD, z.data());
}

// Edge functions too large for 32 bits, as floats, from pixel (x, y) on.
HWY_INLINE hn::Vec<DF> wide_edge(const TileTriangles& t, std::size_t k, std::size_t i, int x, int y) {
  const hn::Rebind<float, DD> half;
  const double first = t.edge[i][k] + (x - t.left[k]) * t.edge_x[i][k] + (y - t.bottom[k]) * t.edge_y[i][k];
  const auto step = hn::Set(kDD, t.edge_x[i][k]);
  const auto low = hn::Add(hn::Set(kDD, first), hn::Mul(real_lane_numbers(), step));
  const auto high = hn::Add(low, hn::Mul(hn::Set(kDD, static_cast<double>(hn::Lanes(kDD))), step));
  return hn::Combine(kDF, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
}

#include "src/raster/lanes/lane_triangle.inl"
#include "src/raster/lanes/tile_triangles.inl"

template <Drawing kDrawing>
HWY_INLINE void draw_pixel(const Pen& pen) {
  LaneTile& tile = pen.tile;
  const SetupPrimitive& p = pen.primitive;
  const int x = p.box.left, y = p.box.bottom;
  const auto place = static_cast<std::size_t>((y - tile.bottom) * kTileSize + (x - tile.left));
  if constexpr (is_nearest(kDrawing)) {
    std::uint32_t& stored = tile.tile.depth_stencil[place];
    if (p.z24[0] >= stored >> 8) return;
    if (kDrawing == Drawing::noted) tile.tile.owner[place] = pen.number;
    stored = (p.z24[0] << 8) | (stored & 0xFF);
    if (pen.pass.operations.color) tile.tile.color[place] = pen.color;
    return;
  }
  const LaneDraw<D1> draw(kD1, pen.pass.operations, p.front_facing);
  const auto depth = depth_codes(kD1, pen.pass, p, hn::Set(kD1, static_cast<std::int32_t>(p.z24[0])));
  auto mask = hn::FirstN(kD1, 1);
  if constexpr (kDrawing == Drawing::gathers) {
    mask = gathered<OneRow>(kD1, draw, pen, place, mask, depth);
    if (hn::AllFalse(kD1, mask)) return;
    const std::array<std::int64_t, 3> edge = TriangleEdges(p).at(x, y);
    const hn::Rebind<float, D1> df;
    hn::Vec<decltype(df)> weight[3];
    for (std::size_t i = 0; i < 3; ++i) weight[i] = hn::Set(df, static_cast<float>(edge[i]) * pen.corners->inv_w[i]);
    push<OneRow>(kD1, pen, place, mask, depth, weight);
  } else {
    draw_flat<OneRow>(kD1, draw, pen, place, mask, depth);
  }
}

template <Drawing kDrawing>
void draw_all(LaneTile& tile, LanePass& pass, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  const bool needs_color = kDrawing != Drawing::gathers && pass.operations.needs_color();
  const std::span<const ColorBytes> colors = pass.context.arrays.primitive_colors;
  const std::uint32_t first_number = tile.next_number;
  tile.next_number += static_cast<std::uint32_t>(indices.size());
  const bool loses_farther = tile.knows_farthest && pass.depths_are_codes;
  const auto is_lost = [&](const SetupPrimitive& p, int left, int bottom, int right, int top) {
    return loses_farther && tile.farthest.are_nearer(left - tile.left, bottom - tile.bottom, right - tile.left,
                                                     top - tile.bottom, std::min({p.z24[0], p.z24[1], p.z24[2]}));
  };
  TileTriangles t;
  constexpr std::size_t kGroup = kLanes;
  for (std::size_t first = 0; first < indices.size();) {
    // A group of triangles, and the single pixels among them, which need not be placed.
    alignas(64) std::array<std::uint32_t, kGroup> index;
    std::size_t count = 0, end = first;
    for (; end < indices.size() && count < kGroup; ++end) {
      // Of large meshes neither this nor the colours are in the nearer caches.
      if (end + 2 * kGroup < indices.size()) __builtin_prefetch(&block.primitives[indices[end + 2 * kGroup]]);
      const SetupPrimitive& p = block.primitives[indices[end]];
      if (needs_color && !colors.empty()) __builtin_prefetch(&colors[p.primitive]);
      index[count] = indices[end];
      count += p.kind != SetupKind::pixel ? 1 : 0;
    }
    std::uint64_t small = 0, drawn = 0;
    if (count > 0) {
      std::fill(index.begin() + static_cast<std::ptrdiff_t>(count), index.end(), index[0]);
      M drawn_mask;
      small = bits_of(kD, place_small(t, block, index.data(), tile.pixels, drawn_mask));
      drawn = bits_of(kD, drawn_mask);
    }
    std::size_t i = 0;  // the next triangle
    for (; first < end; ++first) {
      const SetupPrimitive& p = block.primitives[indices[first]];
      Pen pen{tile,
              pass,
              p,
              block,
              kDrawing == Drawing::gathers ? &block.corners_of(p) : nullptr,
              0,
              first_number + static_cast<std::uint32_t>(first)};
      const auto find_color = [&] {
        if (!needs_color) return;
        const ColorBytes color = pass.context.flat_primary(p.primitive);
        std::memcpy(&pen.color, color.data(), sizeof(pen.color));
      };
      if (p.kind == SetupKind::pixel) {
        if (is_lost(p, p.box.left, p.box.bottom, p.box.right, p.box.top)) continue;
        find_color();
        draw_pixel<kDrawing>(pen);
        continue;
      }
      const std::size_t k = i++;
      if (!t.has_region(k) || is_lost(p, t.left[k], t.bottom[k], t.right[k], t.top[k])) continue;
      if (((small >> k) & 1U) != 0 ? ((drawn >> k) & 1U) == 0 : !t.place(k, p)) continue;
      find_color();
      draw_in_rows<kDrawing>(pen, t, k);
    }
  }
}

void draw_triangles(LaneTile& tile, LanePass& pass, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  if (pass.batch != nullptr) {
    draw_all<Drawing::gathers>(tile, pass, block, indices);
  } else if (pass.notes_owners) {
    draw_all<Drawing::noted>(tile, pass, block, indices);
  } else if (pass.draws_nearest_alone()) {
    draw_all<Drawing::nearest>(tile, pass, block, indices);
  } else {
    draw_all<Drawing::flat>(tile, pass, block, indices);
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

LanePass::LanePass(const DrawContext& draw, const RenderTarget& target)
    : context(draw),
      operations(draw.state, target),
      depths_are_codes(!draw.state.polygon_offset.fill && draw.depth.step_z24() == 1) {
  if (!draw.has_flat_result) batch = std::make_unique<LaneBatch>();
}

void draw_lanes(LaneTile& tile, LanePass& pass, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  if (pass.repeats && tile.has_kept_all) return;
  HWY_DYNAMIC_DISPATCH(draw_triangles)(tile, pass, block, indices);
}

}  // namespace ninebit
#endif
