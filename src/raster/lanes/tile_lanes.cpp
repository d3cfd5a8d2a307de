#include "src/raster/lanes/tile_lanes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "src/numerics/simd_targets.h"
#include "src/raster/fragment/blend.h"
#include "src/raster/lanes/primitive_draw.h"
#include "src/raster/lanes/tile_triangles.h"
#include "src/raster/setup/triangle_edges.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/tile_lanes.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/raster/lanes/lane_equal_depth-inl.h"
#include "src/raster/lanes/lane_lines-inl.h"
#include "src/raster/lanes/lane_smooth-inl.h"
#include "src/raster/lanes/lane_triangle-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/tile_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // its single lane has no numbers wider than 32 bits

void draw_primitives(LaneTile&, const LanePass&, const SetupBlock&, std::span<const std::uint32_t>) {}

#else

// Draws a primitive of kind SetupKind::pixel.
template <Drawing kDrawing>
HWY_INLINE void draw_pixel(const PrimitiveDraw& current) {
  constexpr hn::CappedTag<std::int32_t, 1> kD1;
  TilePlanes& planes = current.tile.planes;
  const SetupPrimitive& p = current.primitive;
  const int x = p.box.left, y = p.box.bottom;
  const auto place = static_cast<std::size_t>((y - planes.bottom) * kTileSize + (x - planes.left));
  if constexpr (is_nearest(kDrawing)) {
    std::uint32_t& stored = planes.depth_stencil[place];
    if (p.z24[0] >= stored >> 8) return;
    if (kDrawing == Drawing::noted) current.tile.owners.number[place] = current.number;
    stored = (p.z24[0] << 8) | (stored & 0xFF);
    if (current.pass.operations.color) planes.color[place] = current.color;
    return;
  }
  const LaneDraw<hn::CappedTag<std::int32_t, 1> > draw(kD1, current.pass.operations, p.front_facing);
  const auto depth = depth_codes(kD1, current.pass, p, hn::Set(kD1, static_cast<std::int32_t>(p.z24[0])));
  auto mask = hn::FirstN(kD1, 1);
  if constexpr (kDrawing == Drawing::gathers) {
    mask = gathered<OneRow>(kD1, draw, current, place, mask, depth);
    if (hn::AllFalse(kD1, mask)) return;
    const std::array<std::int64_t, 3> edge = TriangleEdges(p).at(x, y);
    const hn::Rebind<float, hn::CappedTag<std::int32_t, 1> > df;
    hn::Vec<decltype(df)> weight[3];
    for (std::size_t i = 0; i < 3; ++i)
      weight[i] = hn::Set(df, static_cast<float>(edge[i]) * current.corners->inv_w[i]);
    push<OneRow>(kD1, current, place, mask, depth, weight);
  } else {
    draw_flat<OneRow>(kD1, draw, current, place, mask, depth);
  }
}

// Draws triangle k in the way that is fastest for its width and the pass.
template <Drawing kDrawing, class Draw>
HWY_INLINE void draw_placed(const Draw& current, const TileTriangles& t, std::size_t k) {
  const int columns = t.right[k] - t.left[k] + 1;
  if constexpr (kLanes == 16) {
    using Rows = SeveralRows<4>;
    if (columns <= Rows::kColumns && t.has_floats[k] != 0) return draw_slim_triangle<kDrawing, Rows>(current, t, k);
  }
  if constexpr (kLanes >= 8) {
    using Rows = SeveralRows<2>;
    if (columns <= Rows::kColumns && t.has_floats[k] != 0) return draw_slim_triangle<kDrawing, Rows>(current, t, k);
  }
  // Fragments that are gathered have loops of their own, below.
  if constexpr (kLanes == 8 && kDrawing != Drawing::gathers) {
    if (columns <= OneRow::kColumns && t.has_floats[k] != 0) return draw_slim_triangle<kDrawing, OneRow>(current, t, k);
  }
  if constexpr (kDrawing == Drawing::gathers) {
    const LaneOperations& operations = current.pass.operations;
    if (operations.tests_nothing) return gather_rows<Finding::all>(current, t, k);
    if (operations.asks_equal_depth) {
      return current.tile.owners.are_known ? gather_rows<Finding::by_owners>(current, t, k)
                                           : gather_rows<Finding::by_depths>(current, t, k);
    }
  }
  // Only large triangles cover regions so wide.
  if (columns >= 2 * kLanes && is_full(t, k)) return draw_triangle<kDrawing, Filling::full>(current, t, k);
  if constexpr (kDrawsEmpty<kDrawing, Draw>) {
    // The whole of a small triangle has a fragment in most vectors of its box; a large one's part of a tile has not.
    constexpr int kSmall = 5 * kLanes;
    const PixelBounds& box = current.primitive.box;
    if (box.right - box.left < kSmall) return draw_triangle<kDrawing, Filling::drawing_all>(current, t, k);
  }
  draw_triangle<kDrawing, Filling::skipping>(current, t, k);
}

// Primitives of a block that are drawn in a tile.
struct PrimitiveList {
  const SetupBlock& block;
  std::span<const std::uint32_t> indices;
  std::span<const ColorBytes> colors;  // of primitives, to be prefetched; empty where no colour is needed
};

// A group of primitives: as many triangles as are placed at a time, and the others among them.
struct PrimitiveGroup {
  std::size_t end;  // in PrimitiveList::indices
  PlacedTriangles triangles;
};

// Forms the group that begins at `first` and places its triangles.
HWY_INLINE PrimitiveGroup place_group(TileTriangles& t, const PrimitiveList& list, std::size_t first,
                                      const PixelBox& pixels) {
  constexpr std::size_t kGroup = kLaneCount;
  alignas(64) std::array<std::uint32_t, kGroup> index;
  std::size_t count = 0, end = first;
  for (; end < list.indices.size() && count < kGroup; ++end) {
    // In large meshes neither primitives nor colours are in the nearer caches.
    if (end + 2 * kGroup < list.indices.size()) {
      __builtin_prefetch(&list.block.primitives[list.indices[end + 2 * kGroup]]);
    }
    const SetupPrimitive& p = list.block.primitives[list.indices[end]];
    if (!list.colors.empty()) __builtin_prefetch(&list.colors[p.primitive]);
    index[count] = list.indices[end];
    count += p.kind == SetupKind::triangle ? 1 : 0;
  }
  if (count == 0) return {end, {}};
  std::fill(index.begin() + static_cast<std::ptrdiff_t>(count), index.end(), index[0]);
  return {end, place_small(t, list.block, index.data(), pixels)};
}

// `Draw` is PrimitiveDraw, or RealPrimitiveDraw for formats of real numbers, in which no primitive is a single pixel.
template <Drawing kDrawing, class Draw>
void draw_all(LaneTile& tile, const LanePass& pass, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  const bool needs_color = kDrawing != Drawing::gathers && pass.operations.needs_color();
  const PrimitiveList list{block, indices,
                           needs_color ? pass.context.arrays.primitive_colors : std::span<const ColorBytes>()};
  const std::uint32_t first_number = tile.owners.next_number;
  tile.owners.next_number += static_cast<std::uint32_t>(indices.size());
  const bool loses_farther = tile.farthest.are_known && pass.corners_are_codes;
  const auto is_lost = [&](const SetupPrimitive& p, int left, int bottom, int right, int top) {
    const int x = tile.planes.left, y = tile.planes.bottom;
    return loses_farther &&
           tile.farthest.are_nearer(left - x, bottom - y, right - x, top - y, std::min({p.z24[0], p.z24[1], p.z24[2]}));
  };
  const bool is_final = pass.operations.store.is_exact || pass.operations.blends;
  TileTriangles t;
  for (std::size_t i = 0; i < indices.size();) {
    const PrimitiveGroup group = place_group(t, list, i, tile.planes.pixels);
    std::size_t next_triangle = 0;
    for (; i < group.end; ++i) {
      const SetupPrimitive& p = block.primitives[indices[i]];
      const SetupCorners* const corners = kDrawing == Drawing::gathers ? &block.corners_of(p) : nullptr;
      PrimitiveDraw current{tile, pass, p, block, corners, first_number + static_cast<std::uint32_t>(i)};
      const auto find_color = [&] {
        if (!needs_color) return;
        const ColorBytes color = pass.context.flat_primary(p.primitive);
        std::memcpy(&current.color, color.data(), sizeof(current.color));
        if constexpr (kDrawing == Drawing::flat) current.alpha = color[3];
        if (HWY_UNLIKELY(!is_final)) current.color = pass.operations.store(current.color);
      };
      if (p.kind == SetupKind::pixel) {
        if (is_lost(p, p.box.left, p.box.bottom, p.box.right, p.box.top)) continue;
        find_color();
        draw_pixel<kDrawing>(current);
        continue;
      }
      if constexpr (kDrawing == Drawing::gathers) {
        if (HWY_UNLIKELY(p.kind != SetupKind::triangle)) {
          gather_line_or_point(current);
          continue;
        }
      }
      const std::size_t k = next_triangle++;
      if (!t.has_region(k) || is_lost(p, t.left[k], t.bottom[k], t.right[k], t.top[k])) continue;
      if constexpr (kDrawing == Drawing::gathers) {
        if (HWY_UNLIKELY(pass.operations.smooths) && pass.context.state.polygon_smooth) {
          if (t.place(k, p, true)) draw_smooth_triangle(Draw(current), t, k);
          continue;
        }
      }
      const bool is_placed = ((group.triangles.placed >> k) & 1U) != 0;
      if (is_placed ? ((group.triangles.drawn >> k) & 1U) == 0 : !t.place(k, p)) continue;
      find_color();
      if constexpr (std::is_same_v<Draw, PrimitiveDraw>) {
        draw_placed<kDrawing>(current, t, k);
      } else {
        draw_placed<kDrawing>(Draw(current), t, k);
      }
    }
  }
}

template <Drawing kDrawing>
HWY_INLINE void draw_any(LaneTile& tile, const LanePass& pass, const SetupBlock& block,
                         std::span<const std::uint32_t> indices) {
  pass.context.depth.is_real() ? draw_all<kDrawing, RealPrimitiveDraw>(tile, pass, block, indices)
                               : draw_all<kDrawing, PrimitiveDraw>(tile, pass, block, indices);
}

void draw_primitives(LaneTile& tile, const LanePass& pass, const SetupBlock& block,
                     std::span<const std::uint32_t> indices) {
  if (pass.batch != nullptr) {
    draw_any<Drawing::gathers>(tile, pass, block, indices);
  } else if (pass.notes_owners) {
    draw_any<Drawing::noted>(tile, pass, block, indices);
  } else if (pass.draws_nearest_alone()) {
    draw_any<Drawing::nearest>(tile, pass, block, indices);
  } else {
    draw_any<Drawing::flat>(tile, pass, block, indices);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

bool are_lanes_there() {
  return HWY_TARGET != HWY_SCALAR;
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(are_lanes_there);
HWY_EXPORT(draw_primitives);

bool lanes_can_draw(const DrawContext& context, const RenderTarget& target) {
  const PipelineState& state = context.state;
  // A tile costs more than the few pixels of a line that need no batch.
  if (context.has_flat_result && (context.draws_lines || context.draws_points)) return false;
  if (!context.outputs.empty()) return false;
  // The tile does not hold a component that is masked.
  const bool holds_alpha = state.color_mask[kAlpha] || !target.color[kAlpha];
  if (state.blend.enabled && reads_stored_alpha(state.blend) && !holds_alpha) return false;
  if (!context.has_flat_result) {
    if (!context.shades_flat() && state.profile.color_interpolation.value == ColorInterpolation::affine) return false;
  }
  return HWY_DYNAMIC_DISPATCH(are_lanes_there)();
}

void begin_pass(LaneTile& tile, const LanePass& pass) {
  tile.fragments.begin_pass(pass.role);
  if (tile.fragments.repeats(pass.role)) {
    for (const auto& batch : tile.fragments.kept()) draw_batch(tile.planes, pass, *batch);
    return;
  }
  tile.owners.begin_pass(pass.operations.depth_write, pass.notes_owners);
  // Not in a pass that writes depth: the codes would remain valid, as depths only come nearer, but the search finds
  // little there.
  tile.farthest.are_known = pass.operations.loses_farther && !pass.operations.depth_write;
  if (tile.farthest.are_known) find_farthest(tile.planes, tile.farthest);
}

void draw_lanes(LaneTile& tile, const LanePass& pass, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  if (tile.fragments.repeats(pass.role)) return;
  HWY_DYNAMIC_DISPATCH(draw_primitives)(tile, pass, block, indices);
}

// Not inlined into the loops that gather: it runs once for hundreds of fragments.
HWY_NOINLINE void flush_lanes(LaneTile& tile, const LanePass& pass) {
  LaneFragments& fragments = tile.fragments.gathering();
  if (fragments.count == 0) return;
  fragments.run[fragments.runs].first = fragments.count;
  draw_batch(tile.planes, pass, fragments);
  tile.fragments.begin_batch(pass.role == FragmentRole::keeps);
}

}  // namespace ninebit
#endif
