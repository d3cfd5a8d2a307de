// Depths and edge functions of a triangle at a vector of pixels.
#if defined(NINEBIT_RASTER_LANES_LANE_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_DEPTH_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_DEPTH_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_DEPTH_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/primitive_draw.h"
#include "src/raster/lanes/tile_triangles.h"
#include "src/raster/setup/triangle_edges.h"
#include "src/raster/setup/window_primitives.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// The lanes of `doubtful`, from the exact plane. (x, y) is the first lane's pixel.
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

// The depth plane of triangle k along a row and up the rows, with 32 fraction bits.
struct DepthLanes {
  V64 row;  // the lower half of the lanes
  V64 half, step, up;
  HWY_INLINE DepthLanes(const TileTriangles& t, std::size_t k) {
    row = at_first_lanes(t, k, hn::Mul(real_lane_numbers(), hn::Set(kDD, t.depth_x[k])));
    half = hn::Set(kD64, t.depth_step_x[k] * (kLanes / 2));
    step = hn::Set(kD64, t.depth_step_x[k] * kLanes);
    up = hn::Set(kD64, t.depth_step_y[k]);
  }
  static HWY_INLINE V64 at_first_lanes(const TileTriangles& t, std::size_t k, hn::Vec<DD> from_origin) {
    return hn::ConvertTo(kD64, hn::Add(hn::Set(kDD, t.depth[k]), from_origin));
  }
};

// The lower or the upper half of a vector's columns and rows, from its first pixel on.
template <class Rows>
struct RealPlaces {
  alignas(64) static constexpr auto kColumn = [] {
    std::array<double, kLaneCount> at{};
    for (std::size_t i = 0; i < kLaneCount; ++i) at[i] = Rows::column(static_cast<int>(i));
    return at;
  }();
  alignas(64) static constexpr auto kRow = [] {
    std::array<double, kLaneCount> at{};
    for (std::size_t i = 0; i < kLaneCount; ++i) at[i] = Rows::row(static_cast<int>(i));
    return at;
  }();
};

// Codes of the lanes, the first of which is pixel (x, y): RealDepth::number().
template <class Rows>
HWY_INLINE V real_depths(const TriangleRealDepth& t, const WindowDepth& depth, int x, int y) {
  alignas(64) std::array<double, kLaneCount> number;
  for (std::size_t first = 0; first < kLaneCount; first += hn::Lanes(kDD)) {
    const auto column = hn::Add(hn::Load(kDD, RealPlaces<Rows>::kColumn.data() + first), hn::Set(kDD, x));
    const auto row = hn::Add(hn::Load(kDD, RealPlaces<Rows>::kRow.data() + first), hn::Set(kDD, y));
    const auto of = [&](std::size_t i) HWY_ATTR {
      // Whole numbers below 2^53, however they are added.
      const auto along = hn::Add(hn::Set(kDD, t.edge[i]), hn::Mul(hn::Set(kDD, t.edge_x[i]), column));
      const auto share = hn::Add(along, hn::Mul(hn::Set(kDD, t.edge_y[i]), row));
      return hn::Mul(share, hn::Set(kDD, t.depth.corner[i]));
    };
    const auto sum = hn::Add(hn::Add(of(0), of(1)), of(2)), parts = hn::Set(kDD, t.depth.parts);
    const auto own = depth.is_w() ? hn::Div(parts, sum) : hn::Mul(hn::Div(sum, parts), hn::Set(kDD, depth.one()));
    hn::Store(hn::Add(own, hn::Set(kDD, t.depth.offset)), kDD, number.data() + first);
  }
  alignas(64) std::array<std::int32_t, kLaneCount> code;
  for (std::size_t i = 0; i < kLaneCount; ++i) code[i] = static_cast<std::int32_t>(depth.code_of_number(number[i]));
  return hn::Load(kD, code.data());
}

// Window depths of the lanes of the mask, the first of which is pixel (x, y), from both halves of their DepthLanes.
template <class Rows>
HWY_INLINE V find_depths(const PrimitiveDraw& current, int x, int y, M mask, V64 z_low, V64 z_high) {
  if (HWY_UNLIKELY(current.real != nullptr)) return real_depths<Rows>(*current.real, current.pass.context.depth, x, y);
  const SetupPrimitive& p = current.primitive;
  const hn::RebindToUnsigned<D> du;
  const auto low = hn::BitCast(du, z_low), high = hn::BitCast(du, z_high);
  const V z24 = hn::BitCast(kD, hn::ConcatOdd(du, high, low));
  const auto fraction = hn::Add(hn::ConcatEven(du, high, low), hn::Set(du, kDepthDoubt));
  const M doubtful = hn::And(mask, hn::RebindMask(kD, hn::Lt(fraction, hn::Set(du, 2 * kDepthDoubt))));
  if (HWY_UNLIKELY(!hn::AllFalse(kD, doubtful))) return exact_depth<Rows>(p, x, y, doubtful, z24);
  return z24;
}

// Edge function i of triangle k in floats, where it is too large for 32 bits, from pixel (x, y) on.
HWY_INLINE VF wide_edge(const TileTriangles& t, std::size_t k, std::size_t i, int x, int y) {
  const hn::Rebind<float, DD> half;
  const double first = t.edge[i][k] + (x - t.left[k]) * t.edge_x[i][k] + (y - t.bottom[k]) * t.edge_y[i][k];
  const auto step = hn::Set(kDD, t.edge_x[i][k]);
  const auto low = hn::Add(hn::Set(kDD, first), hn::Mul(real_lane_numbers(), step));
  const auto high = hn::Add(low, hn::Mul(hn::Set(kDD, static_cast<double>(hn::Lanes(kDD))), step));
  return hn::Combine(kDF, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
}

// Edge function i of triangle k in floats at a vector of pixels, the first of which is (x, y); `inside` is that of
// TileTriangles there.
HWY_INLINE VF edge_at(const TileTriangles& t, std::size_t k, std::size_t i, int x, int y, V inside) {
  return t.is_narrow[k] ? hn::ConvertTo(kDF, hn::Add(inside, hn::Set(kD, t.threshold[i][k])))
                        : wide_edge(t, k, i, x, y);
}
// The same where `inside` is in floats.
HWY_INLINE VF edge_at(const TileTriangles& t, std::size_t k, std::size_t i, int, int, VF inside) {
  return hn::Add(inside, hn::ConvertTo(kDF, hn::Set(kD, t.threshold[i][k])));
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
