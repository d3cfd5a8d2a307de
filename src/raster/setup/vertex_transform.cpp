// The rules of WindowTransform over vectors, compiled once for every SIMD target and chosen at run time. Floats and
// doubles take the same operations in the same order as there.
#include "src/raster/setup/vertex_transform.h"

#include <algorithm>
#include <cstring>

#include "src/numerics/simd_targets.h"
#include "src/raster/setup/clip.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/setup/vertex_transform.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/system/emscripten/wasm_doubles-inl.h"
#include "src/system/parallel/parallel_loop.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kVertices = 64;  // of one step; a multiple of all vectors' lanes

using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using DD = hn::CappedTag<double, 8>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
constexpr DF kDF;
constexpr DI kDI;
constexpr DD kDD;
constexpr hn::Rebind<float, DD> kHalfF;
constexpr hn::Rebind<std::int32_t, DD> kHalfI;

HWY_INLINE VF set(float v) {
  return hn::Set(kDF, v);
}

struct Step {
  alignas(64) float z[kVertices], w[kVertices];
  alignas(64) std::int32_t x_and_code[kVertices], y[kVertices], z24[kVertices], inv_w[kVertices];
};

template <class Mask>
HWY_INLINE VI bit(Mask where, std::int32_t code) {
  return hn::IfThenElseZero(hn::RebindMask(kDI, where), hn::Set(kDI, code));
}

HWY_INLINE VI code_of(const WindowScale& s, VF x, VF y, VF z, VF w) {
  const VF minus_w = hn::Neg(w);
  // Narrower than the guard band by far more than a product's rounding. Up to 2^100 no product overflows, and what is
  // within such a w is finite.
  const VF guard_x = hn::Mul(set(s.guard_x * (1.0F - 0x1p-20F)), w);
  const VF guard_y = hn::Mul(set(s.guard_y * (1.0F - 0x1p-20F)), w);
  auto good = hn::And(hn::Ge(w, set(kSmallestW)), hn::Le(w, set(0x1p100F)));
  good = hn::And(good, hn::Le(hn::Abs(z), w));
  good = hn::And(good, hn::And(hn::Le(hn::Abs(x), guard_x), hn::Le(hn::Abs(y), guard_y)));
  VI code = hn::IfThenElse(hn::RebindMask(kDI, good), hn::Zero(kDI), hn::Set(kDI, kNeedsCare));
  code = hn::Or(code, hn::Or(bit(hn::Lt(z, minus_w), kBeyondNear), bit(hn::Gt(z, w), kBeyondFar)));
  code = hn::Or(code, hn::Or(bit(hn::Lt(x, minus_w), kBeyondLeft), bit(hn::Gt(x, w), kBeyondRight)));
  return hn::Or(code, hn::Or(bit(hn::Lt(y, minus_w), kBeyondBottom), bit(hn::Gt(y, w), kBeyondTop)));
}

// Where a coordinate of the view volume lies in the window, in 1/16 pixel.
HWY_INLINE VI snapped(const WindowScale& s, VF v, float guard, float half, float centre, int shift) {
  const VF within = hn::Min(hn::Max(v, set(-guard)), set(guard));
  const VF steps = hn::Mul(hn::Add(hn::Mul(within, set(half)), set(centre)), set(s.steps));
  return hn::Add(hn::ShiftLeftSame(hn::ConvertTo(kDI, steps), s.to_q4_bits), hn::Set(kDI, shift));
}

// Each takes a row of the matrix to a vector of positions that it has loaded.
class Points {
 public:
  HWY_INLINE explicit Points(const glm::vec3* in) { hn::LoadInterleaved3(kDF, &in->x, x_, y_, z_); }
  HWY_INLINE VF row(const glm::mat4& m, int i) const {
    const VF xy = hn::Add(hn::Mul(set(m[0][i]), x_), hn::Mul(set(m[1][i]), y_));
    return hn::Add(hn::Add(xy, hn::Mul(set(m[2][i]), z_)), set(m[3][i]));
  }

 private:
  VF x_, y_, z_;
};
class HomogeneousPoints {
 public:
  HWY_INLINE explicit HomogeneousPoints(const glm::vec4* in) { hn::LoadInterleaved4(kDF, &in->x, x_, y_, z_, w_); }
  HWY_INLINE VF row(const glm::mat4& m, int i) const {
    const VF xy = hn::Add(hn::Mul(set(m[0][i]), x_), hn::Mul(set(m[1][i]), y_));
    return hn::Add(hn::Add(xy, hn::Mul(set(m[2][i]), z_)), hn::Mul(set(m[3][i]), w_));
  }

 private:
  VF x_, y_, z_, w_;
};
HWY_INLINE Points load(const glm::vec3* in) {
  return Points(in);
}
HWY_INLINE HomogeneousPoints load(const glm::vec4* in) {
  return HomogeneousPoints(in);
}

template <class Position>
HWY_INLINE void transform_positions(const glm::mat4& m, const WindowScale& s, const Position* in, Step& step) {
  for (std::size_t v = 0; v < kVertices; v += hn::Lanes(kDF)) {
    const auto p = load(in + v);
    const VF x = p.row(m, 0), y = p.row(m, 1), z = p.row(m, 2), w = p.row(m, 3);
    const VF inv_w = hn::Div(set(1.0F), w);
    const VI x_q4 = snapped(s, hn::Mul(x, inv_w), s.guard_x, s.half_width, s.centre_x, s.shift.x_q4);
    const VI y_q4 = snapped(s, hn::Mul(y, inv_w), s.guard_y, s.half_height, s.centre_y, s.shift.y_q4);
    hn::Store(hn::Or(hn::ShiftLeft<kCodeBits>(x_q4), code_of(s, x, y, z, w)), kDI, step.x_and_code + v);
    hn::Store(y_q4, kDI, step.y + v);
    hn::Store(hn::BitCast(kDI, inv_w), kDI, step.inv_w + v);
    hn::Store(z, kDF, step.z + v);
    hn::Store(w, kDF, step.w + v);
  }
}

// The depths of formats of real numbers: WindowDepth::corner_of().
HWY_INLINE void transform_real_depths(const WindowScale& s, bool is_w, Step& step) {
  if (is_w) {
    std::copy(std::begin(step.inv_w), std::end(step.inv_w), step.z24);
    return;
  }
  constexpr hn::Rebind<float, decltype(kDD)> kHalf;
  for (std::size_t v = 0; v < kVertices; v += hn::Lanes(kDD)) {
    const auto z = hn::PromoteTo(kDD, hn::Load(kHalfF, step.z + v));
    const auto w = hn::PromoteTo(kDD, hn::Load(kHalfF, step.w + v));
    const auto depth = hn::Add(hn::Mul(hn::Div(z, w), hn::Set(kDD, s.depth_half)), hn::Set(kDD, s.depth_middle));
    const auto within = hn::Min(hn::Max(depth, hn::Zero(kDD)), hn::Set(kDD, 1.0));
    hn::Store(hn::BitCast(kHalfI, hn::DemoteTo(kHalf, within)), kHalfI, step.z24 + v);
  }
}

HWY_INLINE void transform_depths(const WindowScale& s, double largest, Step& step) {
  for (std::size_t v = 0; v < kVertices; v += hn::Lanes(kDD)) {
    const auto z = hn::PromoteTo(kDD, hn::Load(kHalfF, step.z + v));
    const auto w = hn::PromoteTo(kDD, hn::Load(kHalfF, step.w + v));
    const auto depth = hn::Add(hn::Mul(hn::Div(z, w), hn::Set(kDD, s.depth_half)), hn::Set(kDD, s.depth_middle));
    const auto z24 = hn::Add(hn::Mul(depth, hn::Set(kDD, largest)), hn::Set(kDD, 0.5));
    const auto within = hn::Min(hn::Max(z24, hn::Zero(kDD)), hn::Set(kDD, largest));
    hn::Store(hn::DemoteTo(kHalfI, within), kHalfI, step.z24 + v);
  }
}

template <class Position>
HWY_INLINE void transform_each(const Position* object, const glm::mat4& matrix, const WindowTransform& window,
                               std::size_t begin, std::size_t end, PackedVertex* out) {
  const WindowScale scale = window.scale();
  const auto largest = static_cast<double>(window.depth().max_z24());
  Step step;
  for (std::size_t first = begin; first < end; first += kVertices) {
    const Position* in = object + first;
    PackedVertex* to = out + first;
    const std::size_t count = std::min(kVertices, end - first);
    Position last_in[kVertices];
    PackedVertex last_out[kVertices];
    if (count < kVertices) {
      std::fill(std::copy(in, in + count, last_in), last_in + kVertices, Position(0.0F));
      in = last_in;
      to = last_out;
    }
    transform_positions(matrix, scale, in, step);
    if (window.depth().is_real()) {
      transform_real_depths(scale, window.depth().is_w(), step);
    } else {
      transform_depths(scale, largest, step);
    }
    for (std::size_t v = 0; v < kVertices; v += hn::Lanes(kDI)) {
      hn::StoreInterleaved4(hn::Load(kDI, step.x_and_code + v), hn::Load(kDI, step.y + v), hn::Load(kDI, step.z24 + v),
                            hn::Load(kDI, step.inv_w + v), kDI, &to[v].x_q4_and_code);
    }
    if (count < kVertices) std::memcpy(out + first, last_out, count * sizeof(PackedVertex));
  }
}

void transform_range(const ClipPositions& positions, const WindowTransform& window, std::size_t begin, std::size_t end,
                     PackedVertex* out) {
  const glm::mat4 matrix = positions.matrix();
  if (positions.points().empty()) {
    transform_each(positions.homogeneous().data(), matrix, window, begin, end, out);
  } else {
    transform_each(positions.points().data(), matrix, window, begin, end, out);
  }
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(transform_range);

void transform_vertices(const ClipPositions& positions, const WindowTransform& window, PackedVertex* out) {
  constexpr std::size_t kGrain = 4096;
  const std::size_t count = positions.size();
  const auto transform = HWY_DYNAMIC_DISPATCH(transform_range);
  if (count <= kGrain) return transform(positions, window, 0, count, out);
  parallel_ranges(count, kGrain,
                  [&](std::size_t begin, std::size_t end) { transform(positions, window, begin, end, out); });
}

}  // namespace ninebit
#endif
