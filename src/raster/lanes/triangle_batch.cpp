#include "src/raster/lanes/triangle_batch.h"

#include <bit>
#include <cstddef>
#include <cstring>

#include "src/numerics/simd_targets.h"
#include "src/raster/lanes/triangle_candidates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/lanes/triangle_batch.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/raster/lanes/triangle_batch_input-inl.h"
#include "src/raster/lanes/triangle_batch_output-inl.h"
#include "src/raster/lanes/triangle_vectors-inl.h"
#include "src/raster/rules/fragment_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Triangles no larger than this, in 1/16 pixel, are set up here: their areas fit into 26 bits, their edge functions
// into 27, and a depth's numerator, below 2^52, and quotient are exact in a double (see z24_at_pixel).
constexpr int kMaxExtent = 1 << 13;

// The outcome for a vector of triangles. left_over: some triangles have to be set up one by one before it goes on.
enum class Progress { done, left_over, beyond_vertices };

// The triangles that are left over, and the lane at which to go on after them.
struct Stop {
  std::uint64_t left_over = 0;
  std::size_t next_lane = 0;
};

// The first triangle that has to be set up one by one, and those of them that follow it before any of the others.
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

// Several triangles, with what the steps of set-up find.
struct BatchTriangles {
  Corners vertex;
  VI x[3], y[3];  // in 1/16 pixel; counter-clockwise once they are oriented
  MI alive;       // those that may be drawn, as far as is known
  MI needs_care;  // those with kNeedsCare
  MI clockwise;   // before they were oriented
};

HWY_INLINE bool are_in_range(const Corners& vertex, std::size_t vertex_count) {
  const MI beyond = hn::Or(hn::Lt(min_of(vertex.v), set(0)),
                           hn::Gt(max_of(vertex.v), set(static_cast<std::int32_t>(vertex_count - 1))));
  return hn::AllFalse(kDI, beyond);
}

// Loads the first words, and y where that comes with them, and drops triangles that lie beyond one side of the view.
// False if none is left.
HWY_INLINE bool load_outcodes(const TriangleBatch& batch, std::size_t lanes, BatchTriangles& t) {
  for (int k = 0; k < 3; ++k) words_of<0>(batch, t.vertex.v[k], t.x[k], kGathersRecords ? nullptr : &t.y[k]);
  const VI all = hn::And(hn::And(t.x[0], t.x[1]), t.x[2]), any = hn::Or(hn::Or(t.x[0], t.x[1]), t.x[2]);
  t.alive = hn::Eq(hn::And(all, set(kBeyondAny)), set(0));
  if (lanes < hn::Lanes(kDI)) t.alive = hn::And(t.alive, hn::FirstN(kDI, lanes));
  if (hn::AllFalse(kDI, t.alive)) return false;
  t.needs_care = hn::And(t.alive, hn::TestBit(any, set(kNeedsCare)));
  return true;
}

// Turns the first words into x, and has y loaded.
HWY_INLINE void load_positions(const TriangleBatch& batch, BatchTriangles& t) {
  for (int k = 0; k < 3; ++k) {
    t.x[k] = hn::ShiftRight<kCodeBits>(t.x[k]);
    if constexpr (kGathersRecords) t.y[k] = word_of(batch, 1, t.vertex.v[k]);
  }
}

// The pixels whose centres a triangle may cover, both ends included, as SetupContext::pixels_in.
struct CentreBoxes {
  VI first_x, last_x, first_y, last_y;
  VI columns, rows;  // less one
  MI large;          // triangles above kMaxExtent
};

// Drops triangles whose boxes are empty.
HWY_INLINE CentreBoxes find_boxes(const PixelBox& drawn, BatchTriangles& t) {
  const VI left = min_of(t.x), right = max_of(t.x), low = min_of(t.y), high = max_of(t.y);
  CentreBoxes box;
  box.first_x = hn::Max(hn::ShiftRight<4>(hn::Add(left, set(7))), set(drawn.left));
  box.last_x = hn::Min(hn::ShiftRight<4>(hn::Sub(right, set(8))), set(drawn.right - 1));
  box.first_y = hn::Max(hn::ShiftRight<4>(hn::Add(low, set(7))), set(drawn.bottom));
  box.last_y = hn::Min(hn::ShiftRight<4>(hn::Sub(high, set(8))), set(drawn.top - 1));
  box.columns = hn::Sub(box.last_x, box.first_x);
  box.rows = hn::Sub(box.last_y, box.first_y);
  t.alive = hn::And(t.alive, hn::Gt(hn::Min(box.columns, box.rows), set(-1)));
  box.large = hn::Gt(hn::Max(hn::Sub(right, left), hn::Sub(high, low)), set(kMaxExtent - 1));
  return box;
}

// Drops triangles without area and those that are culled; makes the others counter-clockwise.
HWY_INLINE void orient(const SetupContext& context, BatchTriangles& t) {
  const VI(&x)[3] = t.x;
  const VI(&y)[3] = t.y;
  const VI area =
      hn::Sub(hn::Mul(hn::Sub(x[1], x[0]), hn::Sub(y[2], y[0])), hn::Mul(hn::Sub(y[1], y[0]), hn::Sub(x[2], x[0])));
  const MI clockwise = hn::Lt(area, set(0));
  const bool cull_clockwise = context.is_culled(context.is_front(false));
  const bool cull_counter_clockwise = context.is_culled(context.is_front(true));
  t.alive = hn::AndNot(hn::Eq(area, set(0)), t.alive);
  if (cull_clockwise) t.alive = hn::AndNot(clockwise, t.alive);
  if (cull_counter_clockwise) t.alive = hn::And(t.alive, clockwise);
  const auto swap = [clockwise](VI(&v)[3]) HWY_ATTR {
    const VI second = hn::IfThenElse(clockwise, v[2], v[1]);
    v[2] = hn::IfThenElse(clockwise, v[1], v[2]);
    v[1] = second;
  };
  swap(t.x);
  swap(t.y);
  t.clockwise = clockwise;
}

// The edge functions at the lowest left centre of the box and their steps, and which of the lowest left 2 × 2 centres
// in the box are inside, by the top-left rule: -1 or 0 at the lowest left one, the next to the right, the next higher,
// and both.
struct CentreEdges {
  VI edge[3], step_x[3], step_y[3];
  VI in00, in10, in01, in11;
};

HWY_INLINE CentreEdges find_edges(const BatchTriangles& t, const CentreBoxes& box) {
  const VI centre_x = hn::Add(hn::ShiftLeft<4>(box.first_x), set(8));
  const VI centre_y = hn::Add(hn::ShiftLeft<4>(box.first_y), set(8));
  CentreEdges e;
  VI out00 = set(0), out10 = set(0), out01 = set(0), out11 = set(0);
  for (int i = 0; i < 3; ++i) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const VI dx = hn::Sub(t.x[b], t.x[a]), dy = hn::Sub(t.y[b], t.y[a]);
    e.edge[i] = hn::Sub(hn::Mul(dx, hn::Sub(centre_y, t.y[a])), hn::Mul(dy, hn::Sub(centre_x, t.x[a])));
    e.step_x[i] = hn::ShiftLeft<4>(hn::Neg(dy));
    e.step_y[i] = hn::ShiftLeft<4>(dx);
    const VI top_left = sign(top_left_sign(VectorValues<DI>(), dx, dy));
    const VI e00 = hn::Sub(hn::Sub(e.edge[i], set(1)), top_left);
    const VI e01 = hn::Add(e00, e.step_y[i]);
    out00 = hn::Or(out00, e00);
    out10 = hn::Or(out10, hn::Add(e00, e.step_x[i]));
    out01 = hn::Or(out01, e01);
    out11 = hn::Or(out11, hn::Add(e01, e.step_x[i]));
  }
  const VI wide = sign(hn::Neg(box.columns)), tall = sign(hn::Neg(box.rows));
  e.in00 = hn::Not(sign(out00));
  e.in10 = hn::AndNot(sign(out10), wide);
  e.in01 = hn::AndNot(sign(out01), tall);
  e.in11 = hn::AndNot(sign(out11), hn::And(wide, tall));
  return e;
}

// Adds the triangles that are alive, the first of which would be primitive `first`. Boxes of up to 2 × 2 centres are
// made as small as what is drawn; triangles that cover none of these centres are dropped.
HWY_INLINE void append(const SetupContext& context, std::size_t first, BatchTriangles& t, const CentreBoxes& box,
                       const CentreEdges& e, TriangleCandidates& to) {
  const MI small = hn::Lt(hn::Max(box.columns, box.rows), set(2));
  const VI drawn = hn::Neg(hn::Add(hn::Add(e.in00, e.in10), hn::Add(e.in01, e.in11)));
  t.alive = hn::AndNot(hn::And(small, hn::Eq(drawn, set(0))), t.alive);
  if (hn::AllFalse(kDI, t.alive)) return;
  // Depths of single pixels are found in window depth alone.
  MI pixel = hn::And(small, hn::Eq(drawn, set(1)));
  if (context.window.depth().is_real()) pixel = hn::FirstN(kDI, 0);
  const VI right_by = hn::Not(hn::Or(e.in00, e.in01)), up_by = hn::Not(hn::Or(e.in00, e.in10));  // -1 or 0
  const VI small_low = hn::Or(hn::Sub(box.first_x, right_by), hn::ShiftLeft<16>(hn::Sub(box.first_y, up_by)));
  const VI small_high = hn::Or(hn::Sub(box.first_x, hn::Or(e.in10, e.in11)),
                               hn::ShiftLeft<16>(hn::Sub(box.first_y, hn::Or(e.in01, e.in11))));
  const VI box_low = hn::Or(box.first_x, hn::ShiftLeft<16>(box.first_y));
  const VI box_high = hn::Or(box.last_x, hn::ShiftLeft<16>(box.last_y));

  const std::size_t at = to.count;
  const Compressor compress(t.alive);
  const auto keep = [&compress, at](VI v, std::int32_t* lane) HWY_ATTR { compress(v, lane + at); };
  for (int k = 0; k < 3; ++k) {
    keep(t.x[k], to.x[k]);
    keep(t.y[k], to.y[k]);
    keep(t.vertex.v[k], to.vertex[k]);
    const VI moved = hn::Add(hn::And(e.step_x[k], right_by), hn::And(e.step_y[k], up_by));
    keep(hn::Add(e.edge[k], moved), to.edge[k]);
  }
  keep(hn::IfThenElse(small, small_low, box_low), to.low);
  keep(hn::IfThenElse(small, small_high, box_high), to.high);
  const int front = context.is_front(false) ? 1 << 8 : 0, other_front = context.is_front(true) ? 1 << 8 : 0;
  const VI kind = hn::IfThenElse(t.clockwise, set(TriangleCandidates::kSwapped | front), set(other_front));
  keep(hn::Or(kind, hn::IfThenElseZero(pixel, set(static_cast<int>(SetupKind::pixel)))), to.kind);
  keep(hn::Iota(kDI, static_cast<std::int32_t>(first)), to.primitive);
  to.count += hn::CountTrue(kDI, t.alive);
  to.has_pixels = to.has_pixels || !hn::AllFalse(kDI, hn::And(pixel, t.alive));
}

// Adds those of the triangles [first, first + lanes) that are drawn to the candidates, up to the first triangles that
// are left over, if any.
HWY_INLINE Progress add_candidates(const TriangleBatch& batch, std::size_t first, std::size_t lanes,
                                   TriangleCandidates& to, Stop& stop) {
  BatchTriangles t;
  t.vertex = corners_of(batch, first, lanes);
  if (!are_in_range(t.vertex, batch.vertices.size())) return Progress::beyond_vertices;
  if (!load_outcodes(batch, lanes, t)) return Progress::done;
  load_positions(batch, t);
  const CentreBoxes box = find_boxes(batch.context.drawn, t);
  const MI one_by_one = hn::Or(t.needs_care, hn::And(t.alive, box.large));
  Progress progress = Progress::done;
  if (!hn::AllFalse(kDI, one_by_one)) {
    progress = Progress::left_over;
    stop = first_run(one_by_one, hn::AndNot(one_by_one, t.alive), lanes);
    t.alive = hn::And(t.alive, hn::FirstN(kDI, static_cast<std::size_t>(std::countr_zero(stop.left_over))));
  }
  if (hn::AllFalse(kDI, t.alive)) return progress;
  orient(batch.context, t);
  append(batch.context, first, t, box, find_edges(t, box), to);
  return progress;
}

TriangleBatchResult set_up_range(const TriangleBatch& batch, std::size_t begin, std::size_t end,
                                 TriangleBatchOutput out) {
  const SetupPrimitive* const first_written = out.primitives;
  TriangleCandidates candidates;
  for (auto& lanes : candidates.vertex)
    // cppcheck-suppress pointerSize  // lanes is an array
    std::memset(lanes, 0, sizeof lanes);  // lanes beyond the last one are read, too
  TriangleBatchResult result{.next = end};
  std::size_t next_look = begin;
  for (std::size_t i = begin; i < end; i += hn::Lanes(kDI)) {
    for (; i == next_look && end - i > kDroppedTogether; next_look += kDroppedTogether) {
      if (are_beyond_a_side(batch, i)) i += kDroppedTogether;
    }
    const std::size_t lanes = end - i < hn::Lanes(kDI) ? end - i : hn::Lanes(kDI);
    Stop stop;
    const Progress progress = add_candidates(batch, i, lanes, candidates, stop);
    if (progress != Progress::done) {
      result.is_beyond_vertices = progress == Progress::beyond_vertices;
      result.left_over = stop.left_over;
      result.first_left_over = i;
      result.next = i + stop.next_lane;
      break;
    }
    if (candidates.count + hn::Lanes(kDI) > TriangleCandidates::kRoom) write_candidates(batch, candidates, out);
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
