// Several triangles at a time placed in a tile.
#if defined(NINEBIT_RASTER_LANES_TILE_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_TILE_TRIANGLES_INL_H_
#undef NINEBIT_RASTER_LANES_TILE_TRIANGLES_INL_H_
#else
#define NINEBIT_RASTER_LANES_TILE_TRIANGLES_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_records-inl.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/tile_triangles.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// A word of each of several primitives, given by its place in SetupPrimitive.
class PrimitiveWords {
 public:
#if HWY_TARGET <= HWY_AVX3
  HWY_INLINE PrimitiveWords(const SetupBlock& block, const std::uint32_t* indices)
      : first_(reinterpret_cast<const std::int32_t*>(block.primitives.data())),
        offset_(hn::Mul(hn::LoadU(kD, reinterpret_cast<const std::int32_t*>(indices)),
                        hn::Set(kD, static_cast<std::int32_t>(sizeof(SetupPrimitive))))) {}
  HWY_INLINE V operator()(std::size_t place) const {
    return hn::GatherOffset(kD, first_ + place / 4, offset_);
  }

 private:
  const std::int32_t* first_;
  V offset_;
#else
  HWY_INLINE PrimitiveWords(const SetupBlock& block, const std::uint32_t* indices) {
    for (std::size_t row = 0; row < kRows; ++row) {
      const auto at = [&](std::size_t lane) HWY_ATTR {
        return reinterpret_cast<const std::int32_t*>(&block.primitives[indices[lane]]) + 4 * row;
      };
      load_four_words(kD, at, word_[row]);
    }
  }
  HWY_INLINE V operator()(std::size_t place) const {
    return word_[place / 16][place / 4 % 4];
  }

 private:
  static constexpr std::size_t kRows = sizeof(SetupPrimitive) / 16;
  V word_[kRows][4];
#endif
};

// The origins of the triangles' regions, and their sizes less one.
struct RegionLanes {
  V left, bottom;
  V columns, rows;
};

HWY_INLINE RegionLanes store_regions(TileTriangles& t, const PrimitiveWords& word, const PixelBox& tile) {
  // Two bounds in a word, the first one in its lower half.
  static_assert(offsetof(PixelBounds, bottom) == 2 && offsetof(PixelBounds, right) == 4 &&
                offsetof(PixelBounds, top) == 6);
  constexpr std::size_t kBox = offsetof(SetupPrimitive, box);
  const V low = word(kBox), high = word(kBox + offsetof(PixelBounds, right));
  const auto lower = [](V both) HWY_ATTR { return hn::ShiftRight<16>(hn::ShiftLeft<16>(both)); };
  const V left = hn::Max(lower(low), hn::Set(kD, tile.left)), right = hn::Min(lower(high), hn::Set(kD, tile.right - 1));
  const V bottom = hn::Max(hn::ShiftRight<16>(low), hn::Set(kD, tile.bottom));
  const V top = hn::Min(hn::ShiftRight<16>(high), hn::Set(kD, tile.top - 1));
  hn::Store(left, kD, t.left.data());
  hn::Store(right, kD, t.right.data());
  hn::Store(bottom, kD, t.bottom.data());
  hn::Store(top, kD, t.top.data());
  return {left, bottom, hn::Sub(right, left), hn::Sub(top, bottom)};
}

// The corners in 1/16 pixel from the centre of their region's origin, and the largest distance along an axis.
struct CornerLanes {
  V x[3], y[3];
  V reach;
};

HWY_INLINE CornerLanes load_corners(const PrimitiveWords& word, const RegionLanes& region) {
  constexpr int kLow = PackedPositions::kLow, kHigh = PackedPositions::kHigh;
  const V centre_x = hn::Add(hn::ShiftLeft<4>(region.left), hn::Set(kD, 8));
  const V centre_y = hn::Add(hn::ShiftLeft<4>(region.bottom), hn::Set(kD, 8));
  CornerLanes c;
  c.reach = hn::Zero(kD);
  constexpr std::size_t kPosition = offsetof(SetupPrimitive, position);
  const V high_y = word(kPosition + 12);
  for (std::size_t i = 0; i < 3; ++i) {
    const V packed = word(kPosition + 4 * i);
    const V high_part = hn::ShiftRight<32 - kHigh>(hn::ShiftLeftSame(high_y, 32 - kHigh - kHigh * static_cast<int>(i)));
    const V low_part = hn::And(packed, hn::Set(kD, (1 << kLow) - 1));
    c.x[i] = hn::Sub(hn::ShiftRight<kLow>(packed), centre_x);
    c.y[i] = hn::Sub(hn::Or(hn::ShiftLeft<kLow>(high_part), low_part), centre_y);
    c.reach = hn::Max(c.reach, hn::Max(hn::Abs(c.x[i]), hn::Abs(c.y[i])));
  }
  return c;
}

// The edge functions at the regions' origins, and their steps.
struct EdgeLanes {
  V at_origin[3], step_x[3], step_y[3];
};

// Returns the lanes of `mask` whose region no edge excludes completely.
HWY_INLINE M store_edges(TileTriangles& t, const CornerLanes& c, const RegionLanes& region, M mask, EdgeLanes& edges) {
  const auto store_float = [](V v, TileTriangles::Each<float>& to)
                               HWY_ATTR { hn::Store(hn::ConvertTo(kDF, v), kDF, to.data()); };
  const V zero = hn::Zero(kD), one = hn::Set(kD, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    // The edge from corner a to corner b: at the origin its function is the cross product of the two.
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    edges.at_origin[i] = hn::Sub(hn::Mul(c.x[a], c.y[b]), hn::Mul(c.y[a], c.x[b]));
    const V dx = hn::Sub(c.x[b], c.x[a]), dy = hn::Sub(c.y[b], c.y[a]);
    const auto keeps_zero = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Lt(dx, zero)));
    const V threshold = hn::IfThenElse(keeps_zero, zero, one);
    const V step_x = hn::ShiftLeft<4>(hn::Neg(dy)), step_y = hn::ShiftLeft<4>(dx);
    edges.step_x[i] = step_x;
    edges.step_y[i] = step_y;
    const V inside = hn::Sub(edges.at_origin[i], threshold);
    const V across = hn::Max(hn::Mul(step_x, region.columns), zero), up = hn::Max(hn::Mul(step_y, region.rows), zero);
    mask = hn::And(mask, hn::Gt(hn::Add(inside, hn::Add(across, up)), hn::Set(kD, -1)));
    hn::Store(inside, kD, t.inside[i].data());
    hn::Store(step_x, kD, t.inside_x[i].data());
    hn::Store(step_y, kD, t.inside_y[i].data());
    hn::Store(threshold, kD, t.threshold[i].data());
    store_float(inside, t.float_inside[i]);
    store_float(step_x, t.float_inside_x[i]);
    store_float(step_y, t.float_inside_y[i]);
  }
  return mask;
}

// Numbers below 2^30 with 32 fraction bits.
HWY_INLINE V64 fixed_point(hn::Vec<DD> v) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4
  // These have no instruction for it. A sum of 2^52 and a smaller number has that number as its low bits; another half
  // of it keeps what is negative within the same power of two.
  const auto whole = hn::Floor(v), one = hn::Set(kDD, 0x1p52);
  const auto high = hn::BitCast(kD64, hn::Add(whole, hn::Set(kDD, 0x1.8p52)));
  const auto low = hn::BitCast(kD64, hn::Add(hn::Mul(hn::Sub(v, whole), hn::Set(kDD, kDepthOne)), one));
  return hn::Add(hn::ShiftLeft<32>(high), hn::Sub(low, hn::BitCast(kD64, one)));
#else
  return hn::ConvertTo(kD64, hn::Mul(v, hn::Set(kDD, kDepthOne)));
#endif
}

// The depth planes: the operations of TileTriangles::place in the same order, but that fixed_point may round where that
// cuts.
HWY_INLINE void store_depths(TileTriangles& t, const PrimitiveWords& word, const EdgeLanes& edges) {
  constexpr std::size_t kZ24 = offsetof(SetupPrimitive, z24);
  const V z0 = word(kZ24), dz1 = hn::Sub(word(kZ24 + 4), z0), dz2 = hn::Sub(word(kZ24 + 8), z0);
  static_assert(offsetof(SetupPrimitive, kind) == 12 && offsetof(SetupPrimitive, fraction) == 14 && kOffsetBits == 16);
  const M is_flat = hn::Eq(hn::Or(dz1, dz2), hn::Zero(kD));
  const V own_fraction = hn::And(hn::ShiftRight<16>(word(offsetof(SetupPrimitive, kind))), hn::Set(kD, 0xFFFF));
  const V fraction = hn::IfThenElse(is_flat, hn::Set(kD, 1 << 15), own_fraction);
  const V area = hn::Add(hn::Add(edges.at_origin[0], edges.at_origin[1]), edges.at_origin[2]);
  const hn::Half<D> half;
  const auto real = [&](V v, bool upper) HWY_ATTR {
    return hn::PromoteTo(kDD, upper ? hn::UpperHalf(half, v) : hn::LowerHalf(half, v));
  };
  for (const bool upper : {false, true}) {
    const auto r = [&](V v) HWY_ATTR { return real(v, upper); };
    const auto scale = hn::Div(hn::Set(kDD, 1.0), r(area));
    const auto z1 = r(dz1), z2 = r(dz2), e1 = r(edges.at_origin[1]), e2 = r(edges.at_origin[2]);
    const auto plane = [&](auto first_edge, auto second_edge) HWY_ATTR {
      return hn::Mul(hn::Add(hn::Mul(first_edge, z1), hn::Mul(second_edge, z2)), scale);
    };
    const auto slope_x = plane(r(edges.step_x[1]), r(edges.step_x[2]));
    const auto slope_y = plane(r(edges.step_y[1]), r(edges.step_y[2]));
    const auto origin = hn::Add(hn::Add(r(z0), plane(e1, e2)), hn::Mul(r(fraction), hn::Set(kDD, kFractionUnit)));
    const auto steep = hn::Max(hn::Abs(slope_x), hn::Abs(slope_y));
    const auto far = hn::Mul(hn::Add(hn::Abs(e1), hn::Abs(e2)), scale);
    const auto is_sure =
        hn::And(hn::And(hn::Le(steep, hn::Set(kDD, kSteepestDepth)), hn::Le(far, hn::Set(kDD, kFarthestDepth))),
                hn::Le(hn::Abs(origin), hn::Set(kDD, kHighestDepth)));
    const std::size_t at = upper ? hn::Lanes(kDD) : 0;
    const auto store = [&](hn::Vec<DD> v, TileTriangles::Each<std::int64_t>& to)
                           HWY_ATTR { hn::Store(fixed_point(hn::IfThenElseZero(is_sure, v)), kD64, to.data() + at); };
    store(origin, t.depth);
    store(slope_x, t.depth_x);
    store(slope_y, t.depth_y);
  }
}

// The triangles of a vector, a bit for each.
struct PlacedTriangles {
  std::uint64_t placed = 0;  // the others need TileTriangles::place
  std::uint64_t drawn = 0;   // of those that are placed, the ones that may cover a pixel
};

// Places as many triangles as there are lanes. Sets the regions of all of them, and all of `t` for those whose corners
// lie within 2^14 sixteenths of a pixel of their region's origin.
HWY_INLINE PlacedTriangles place_small(TileTriangles& t, const SetupBlock& block, const std::uint32_t* indices,
                                       const PixelBox& tile) {
  const PrimitiveWords word(block, indices);
  const RegionLanes region = store_regions(t, word, tile);
  const M has_region = hn::Gt(hn::Min(region.columns, region.rows), hn::Set(kD, -1));
  const CornerLanes corners = load_corners(word, region);
  EdgeLanes edges;
  const M drawn = store_edges(t, corners, region, has_region, edges);
  store_depths(t, word, edges);
  t.is_narrow.fill(true);
  // A region's vectors reach 8 columns and 68 rows from its origin: differences of corners and their pixels stay below
  // 2,700, twice the products below 2^24.
  const V has_floats = hn::VecFromMask(kD, hn::Lt(corners.reach, hn::Set(kD, 1536)));
  hn::Store(hn::And(has_floats, hn::Set(kD, 1)), kD, t.has_floats.data());
  return {bits_of(kD, hn::Lt(corners.reach, hn::Set(kD, 1 << 14))), bits_of(kD, drawn)};
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
