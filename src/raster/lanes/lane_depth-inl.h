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
#include <limits>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/lanes/primitive_draw.h"
#include "src/raster/lanes/tile_triangles.h"
#include "src/raster/setup/triangle_edges.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/surface/depth_numbers.h"

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
    row = hn::Add(hn::Set(kD64, t.depth[k]), lane_numbers_times(t.depth_x[k]));
    half = hn::Set(kD64, t.depth_x[k] * (kLanes / 2));
    step = hn::Set(kD64, t.depth_x[k] * kLanes);
    up = hn::Set(kD64, t.depth_y[k]);
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

// Half a vector of codes: DepthNumbers::code().
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, DD>> real_codes(const DepthNumbers& numbers, hn::Vec<DD> number) {
  const hn::Rebind<std::int32_t, DD> half;
#if HWY_TARGET == HWY_WASM  // whose doubles have few operations
  alignas(64) std::array<double, kLaneCount> each{};
  alignas(64) std::array<std::int32_t, kLaneCount> code{};
  hn::Store(number, kDD, each.data());
  for (std::size_t i = 0; i < hn::Lanes(kDD); ++i) code[i] = static_cast<std::int32_t>(numbers.code(each[i]));
  return hn::Load(half, code.data());
#else
  const auto zero = hn::Zero(kDD);
  if (numbers.is_whole()) {
    const auto sum = hn::Add(number, hn::Set(kDD, numbers.half()));
    const auto within = hn::Min(sum, hn::Set(kDD, numbers.largest()));
    return hn::DemoteTo(half, hn::IfThenElseZero(hn::Gt(sum, zero), within));
  }
  // All codes are below 2^24, and what is too large is above the largest code before it is limited.
  const hn::RebindToUnsigned<D64> du;
  const auto bits = hn::Add(hn::BitCast(du, number), hn::Set(du, numbers.half_bit()));
  const auto code = hn::Sub(hn::ShiftRightSame(bits, numbers.dropped_bits()), hn::Set(du, numbers.first_code()));
  const auto is_large = hn::Ge(number, hn::Set(kDD, 2.0 * numbers.largest()));
  const auto least = hn::Ge(number, hn::Set(kDD, numbers.least()));
  const auto limited = hn::IfThenElse(hn::RebindMask(du, is_large), hn::Set(du, numbers.largest_code()), code);
  const auto there = hn::IfThenElseZero(hn::RebindMask(du, least), limited);
  const hn::Rebind<std::uint32_t, DD> narrow;
  const auto low = hn::TruncateTo(narrow, there);
  return hn::BitCast(half, hn::Min(low, hn::Set(narrow, numbers.largest_code())));
#endif
}

// Codes of the lanes, the first of which is pixel (x, y): RealDepth::number().
template <class Rows>
HWY_NOINLINE V real_depths(const TriangleRealDepth& t, const WindowDepth& depth, int x, int y) {
  hn::Vec<DD> first[3];
  for (std::size_t i = 0; i < 3; ++i) first[i] = hn::Set(kDD, t.edge[i] + t.edge_x[i] * x + t.edge_y[i] * y);
  const auto parts = hn::Set(kDD, t.depth.parts), offset = hn::Set(kDD, t.depth.offset);
  const auto half_at = [&](std::size_t lane) HWY_ATTR {
    const auto column = hn::Load(kDD, RealPlaces<Rows>::kColumn.data() + lane);
    const auto of = [&](std::size_t i) HWY_ATTR {
      // Whole numbers below 2^53, however they are added.
      auto share = hn::Add(first[i], hn::Mul(hn::Set(kDD, t.edge_x[i]), column));
      if constexpr (Rows::kRows > 1) {
        share = hn::Add(share, hn::Mul(hn::Set(kDD, t.edge_y[i]), hn::Load(kDD, RealPlaces<Rows>::kRow.data() + lane)));
      }
      return hn::Mul(share, hn::Set(kDD, t.depth.corner[i]));
    };
    const auto sum = hn::Add(hn::Add(of(0), of(1)), of(2));
    const auto own = depth.is_w() ? hn::Div(parts, sum) : hn::Mul(hn::Div(sum, parts), hn::Set(kDD, depth.one()));
    return real_codes(depth.numbers(), hn::Add(own, offset));
  };
  return hn::Combine(kD, half_at(hn::Lanes(kDD)), half_at(0));
}

// Window depths of the lanes of the mask, the first of which is pixel (x, y), from both halves of their DepthLanes.
template <class Rows>
HWY_INLINE V find_depths(const PrimitiveDraw& current, int x, int y, M mask, V64 z_low, V64 z_high) {
  const SetupPrimitive& p = current.primitive;
  const hn::RebindToUnsigned<D> du;
  const auto low = hn::BitCast(du, z_low), high = hn::BitCast(du, z_high);
  const V z24 = hn::BitCast(kD, hn::ConcatOdd(du, high, low));
  // Within kDepthDoubt of 0, by a signed comparison.
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr auto kDoubt = static_cast<std::int32_t>(kDepthDoubt);
  const V fraction = hn::Add(hn::BitCast(kD, hn::ConcatEven(du, high, low)), hn::Set(kD, kLeast + kDoubt));
  const M doubtful = hn::And(mask, hn::Lt(fraction, hn::Set(kD, kLeast + 2 * kDoubt)));
  if (HWY_UNLIKELY(!hn::AllFalse(kD, doubtful))) return exact_depth<Rows>(p, x, y, doubtful, z24);
  return z24;
}

template <class Rows>
HWY_INLINE V find_depths(const RealPrimitiveDraw& current, int x, int y, M, V64, V64) {
  return real_depths<Rows>(current.real, current.pass.context.depth, x, y);
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
