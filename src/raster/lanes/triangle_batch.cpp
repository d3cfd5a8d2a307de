// Set-up of several triangles at a time, compiled once for every SIMD target and chosen at run time.
#include "src/raster/lanes/triangle_batch.h"

#include <bit>
#include <cstddef>
#include <cstring>

#include "src/raster/lanes/lanes_of_bits.h"
#include "src/raster/setup/polygon_offset.h"
#include "src/raster/setup/tile_bins.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/triangle_batch.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DI = hn::CappedTag<std::int32_t, 16>;
using DD = hn::CappedTag<double, 8>;
using VI = hn::Vec<DI>;
using VD = hn::Vec<DD>;
using MI = hn::Mask<DI>;
constexpr DI kDI;
constexpr DD kDD;
constexpr hn::Rebind<std::int32_t, DD> kHalfI;

// Triangles no larger than this, in 1/16 pixel, are set up here: their areas fit into 26 bits, their edge functions
// into 27, and a depth's numerator, below 2^52, and quotient are exact in a double (see z24_at_pixel).
constexpr int kMaxExtent = 1 << 13;

HWY_INLINE VI set(int v) {
  return hn::Set(kDI, v);
}
// -1 where negative, else 0.
HWY_INLINE VI sign(VI v) {
  return hn::ShiftRight<31>(v);
}

// What is left of a range of triangles: corners in counter-clockwise order.
struct Candidates {
  static constexpr std::size_t kRoom = 128;
  using Lanes = std::int32_t[kRoom + 16];
  alignas(64) Lanes x[3], y[3];
  alignas(64) Lanes edge[3];    // of a pixel: the edge functions there
  alignas(64) Lanes vertex[3];  // as the primitive has them
  alignas(64) Lanes low, high;  // the box
  alignas(64) Lanes kind;       // kind and front_facing, as they lie in SetupPrimitive, and kSwapped
  alignas(64) Lanes primitive;
  std::size_t count = 0;
  bool has_pixels = false;
};

// The first corner stays where it is, the others change places in a clockwise triangle.
constexpr int kSwapped = 1 << 16;
constexpr int kCorners = 0x020100, kSwappedCorners = 0x010200;  // as SetupCorners::corner lies in a word

#include "src/raster/lanes/triangle_batch_input.inl"

enum class Verdict { done, left_over, beyond_vertices };

// Where looking at triangles stopped: `left_over` names those that have to be set up one by one before it goes on.
struct Stop {
  std::uint64_t left_over = 0;
  std::size_t next_lane = 0;
};

// The first of the triangles that have to be set up one by one, and those that follow it before one of the others.
HWY_INLINE Stop first_run(MI one_by_one, MI others, std::size_t lanes) {
  const std::uint64_t bits = bits_of(one_by_one), other_bits = bits_of(others);
  const int first = std::countr_zero(bits);
  const std::uint64_t after = other_bits >> first;
  Stop stop{.left_over = bits, .next_lane = lanes};
  if (after != 0) {
    stop.next_lane = static_cast<std::size_t>(first + std::countr_zero(after));
    stop.left_over &= (std::uint64_t{1} << stop.next_lane) - 1;
  }
  return stop;
}

// Adds what is to be drawn of the triangles [first, first + lanes), or of the first of them, and says where to stop.
HWY_INLINE Verdict look_at(const TriangleBatch& batch, std::size_t first, std::size_t lanes, Candidates& to,
                           Stop& stop) {
  const SetupContext& context = batch.context;
  const Corners place = corners_of(batch, first, lanes);
  const MI beyond = hn::Or(hn::Lt(min_of(place.v), set(0)),
                           hn::Gt(max_of(place.v), set(static_cast<std::int32_t>(batch.vertices.size() - 1))));
  if (!hn::AllFalse(kDI, beyond)) return Verdict::beyond_vertices;
  VI x[3], y[3];
  for (int k = 0; k < 3; ++k) x[k] = word_of(batch, 0, place.v[k]);
  const VI all = hn::And(hn::And(x[0], x[1]), x[2]), any = hn::Or(hn::Or(x[0], x[1]), x[2]);
  MI alive = hn::Eq(hn::And(all, set(kBeyondAny)), set(0));
  if (lanes < hn::Lanes(kDI)) alive = hn::And(alive, hn::FirstN(kDI, lanes));
  if (hn::AllFalse(kDI, alive)) return Verdict::done;
  const MI needs_care = hn::And(alive, hn::TestBit(any, set(kNeedsCare)));

  for (int k = 0; k < 3; ++k) {
    x[k] = hn::ShiftRight<kCodeBits>(x[k]);
    y[k] = word_of(batch, 1, place.v[k]);
  }
  const VI left = min_of(x), right = max_of(x), low = min_of(y), high = max_of(y);
  // As SetupContext::pixels_in.
  const VI first_x = hn::Max(hn::ShiftRight<4>(hn::Add(left, set(7))), set(context.drawn.left));
  const VI last_x = hn::Min(hn::ShiftRight<4>(hn::Sub(right, set(8))), set(context.drawn.right - 1));
  const VI first_y = hn::Max(hn::ShiftRight<4>(hn::Add(low, set(7))), set(context.drawn.bottom));
  const VI last_y = hn::Min(hn::ShiftRight<4>(hn::Sub(high, set(8))), set(context.drawn.top - 1));
  const VI columns = hn::Sub(last_x, first_x), rows = hn::Sub(last_y, first_y);  // less one
  alive = hn::And(alive, hn::Gt(hn::Min(columns, rows), set(-1)));
  const MI large = hn::Gt(hn::Max(hn::Sub(right, left), hn::Sub(high, low)), set(kMaxExtent - 1));
  const MI one_by_one = hn::Or(needs_care, hn::And(alive, large));
  Verdict verdict = Verdict::done;
  if (!hn::AllFalse(kDI, one_by_one)) {
    verdict = Verdict::left_over;
    stop = first_run(one_by_one, hn::AndNot(one_by_one, alive), lanes);
    alive = hn::And(alive, hn::FirstN(kDI, static_cast<std::size_t>(std::countr_zero(stop.left_over))));
  }
  if (hn::AllFalse(kDI, alive)) return verdict;

  const VI area =
      hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])), hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
  const MI clockwise = hn::Lt(area, set(0));
  const bool cull_clockwise = context.is_culled(context.is_front(false));
  const bool cull_counter_clockwise = context.is_culled(context.is_front(true));
  alive = hn::AndNot(hn::Eq(area, set(0)), alive);
  if (cull_clockwise) alive = hn::AndNot(clockwise, alive);
  if (cull_counter_clockwise) alive = hn::And(alive, clockwise);
  const auto swap = [clockwise](VI(&v)[3]) HWY_ATTR {
    const VI second = hn::IfThenElse(clockwise, v[2], v[1]);
    v[2] = hn::IfThenElse(clockwise, v[1], v[2]);
    v[1] = second;
  };
  swap(x);
  swap(y);

  // The edge functions at the lowest left centre of the box, and their signs, by the top-left rule, at this one, the
  // next to the right, the next higher, and both.
  const VI centre_x = hn::Add(hn::ShiftLeft<4>(first_x), set(8)), centre_y = hn::Add(hn::ShiftLeft<4>(first_y), set(8));
  VI edge[3], step_x[3], step_y[3];
  VI out00 = set(0), out10 = set(0), out01 = set(0), out11 = set(0);
  for (int i = 0; i < 3; ++i) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const VI dx = hn::Sub(x[b], x[a]), dy = hn::Sub(y[b], y[a]);
    edge[i] = hn::Sub(hn::Mul(dx, hn::Sub(centre_y, y[a])), hn::Mul(dy, hn::Sub(centre_x, x[a])));
    step_x[i] = hn::ShiftLeft<4>(hn::Neg(dy));
    step_y[i] = hn::ShiftLeft<4>(dx);
    // Negative for a left edge, which goes down, and a top edge, level and to the left.
    const VI top_left = sign(hn::Add(hn::ShiftLeft<14>(dy), dx));
    const VI e00 = hn::Sub(hn::Sub(edge[i], set(1)), top_left);
    const VI e01 = hn::Add(e00, step_y[i]);
    out00 = hn::Or(out00, e00);
    out10 = hn::Or(out10, hn::Add(e00, step_x[i]));
    out01 = hn::Or(out01, e01);
    out11 = hn::Or(out11, hn::Add(e01, step_x[i]));
  }
  const VI wide = sign(hn::Neg(columns)), tall = sign(hn::Neg(rows));
  const VI in00 = hn::Not(sign(out00)), in10 = hn::AndNot(sign(out10), wide), in01 = hn::AndNot(sign(out01), tall);
  const VI in11 = hn::AndNot(sign(out11), hn::And(wide, tall));

  // A box of up to 2 × 2 centres is made as small as what is drawn.
  const MI small = hn::Lt(hn::Max(columns, rows), set(2));
  const VI drawn = hn::Neg(hn::Add(hn::Add(in00, in10), hn::Add(in01, in11)));
  alive = hn::AndNot(hn::And(small, hn::Eq(drawn, set(0))), alive);
  if (hn::AllFalse(kDI, alive)) return verdict;
  const MI pixel = hn::And(small, hn::Eq(drawn, set(1)));
  const VI right_by = hn::Not(hn::Or(in00, in01)), up_by = hn::Not(hn::Or(in00, in10));  // -1 or 0
  const VI small_low = hn::Or(hn::Sub(first_x, right_by), hn::ShiftLeft<16>(hn::Sub(first_y, up_by)));
  const VI small_high =
      hn::Or(hn::Sub(first_x, hn::Or(in10, in11)), hn::ShiftLeft<16>(hn::Sub(first_y, hn::Or(in01, in11))));
  const VI box_low = hn::Or(first_x, hn::ShiftLeft<16>(first_y)), box_high = hn::Or(last_x, hn::ShiftLeft<16>(last_y));

  const std::size_t at = to.count;
  const Compressor compress(alive);
  const auto keep = [&compress, at](VI v, std::int32_t* lane) HWY_ATTR { compress(v, lane + at); };
  for (int k = 0; k < 3; ++k) {
    keep(x[k], to.x[k]);
    keep(y[k], to.y[k]);
    keep(place.v[k], to.vertex[k]);
    keep(hn::Add(edge[k], hn::Add(hn::And(step_x[k], right_by), hn::And(step_y[k], up_by))), to.edge[k]);
  }
  keep(hn::IfThenElse(small, small_low, box_low), to.low);
  keep(hn::IfThenElse(small, small_high, box_high), to.high);
  const int front = context.is_front(false) ? 1 << 8 : 0, other_front = context.is_front(true) ? 1 << 8 : 0;
  const VI kind = hn::IfThenElse(clockwise, set(kSwapped | front), set(other_front));
  keep(hn::Or(kind, hn::IfThenElseZero(pixel, set(static_cast<int>(SetupKind::pixel)))), to.kind);
  keep(hn::Iota(kDI, static_cast<std::int32_t>(first)), to.primitive);
  to.count += hn::CountTrue(kDI, alive);
  to.has_pixels = to.has_pixels || !hn::AllFalse(kDI, hn::And(pixel, alive));
  return verdict;
}

#include "src/raster/lanes/triangle_batch_output.inl"

TriangleBatchResult set_up_range(const TriangleBatch& batch, std::size_t begin, std::size_t end,
                                 TriangleBatchOutput out) {
  const SetupPrimitive* const first_written = out.primitives;
  Candidates candidates;
  for (auto& lanes : candidates.vertex)
    // cppcheck-suppress pointerSize  // lanes is an array
    std::memset(lanes, 0, sizeof lanes);  // what is beyond the last one is read, too
  TriangleBatchResult result{.next = end};
  for (std::size_t i = begin; i < end; i += hn::Lanes(kDI)) {
    const std::size_t lanes = end - i < hn::Lanes(kDI) ? end - i : hn::Lanes(kDI);
    Stop stop;
    const Verdict verdict = look_at(batch, i, lanes, candidates, stop);
    if (verdict != Verdict::done) {
      result.is_beyond_vertices = verdict == Verdict::beyond_vertices;
      result.left_over = stop.left_over;
      result.first_left_over = i;
      result.next = i + stop.next_lane;
      break;
    }
    if (candidates.count + hn::Lanes(kDI) > Candidates::kRoom) write_candidates(batch, candidates, out);
  }
  write_candidates(batch, candidates, out);
  result.count = static_cast<std::size_t>(out.primitives - first_written);
  return result;
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(set_up_range);

TriangleBatchResult set_up_triangles(const TriangleBatch& batch, std::size_t begin, std::size_t end,
                                     const TriangleBatchOutput& out) {
  return HWY_DYNAMIC_DISPATCH(set_up_range)(batch, begin, end, out);
}

}  // namespace ninebit
#endif
