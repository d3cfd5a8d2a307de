// Set-up of several triangles at a time, compiled once for every SIMD target and chosen at run time.
#include "src/raster/triangle_batch.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "src/raster/tile_bins.h"

#ifndef NINEBIT_LANES_OF_BITS
#define NINEBIT_LANES_OF_BITS
namespace ninebit {

// For each set of eight bits the numbers of those that are set, ascending, then the others.
inline constexpr auto kLanesOfBits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> lanes{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    std::size_t count = 0;
    for (const unsigned wanted : {1U, 0U}) {
      for (unsigned i = 0; i < 8; ++i) {
        if (((bits >> i) & 1U) == wanted) lanes[bits][count++] = static_cast<std::uint8_t>(i);
      }
    }
  }
  return lanes;
}();

}  // namespace ninebit
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/raster/triangle_batch.cpp"
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
  alignas(64) Lanes kind;       // kind, front_facing and the first two corners, as they lie in SetupPrimitive
  alignas(64) Lanes primitive;
  std::size_t count = 0;
  bool has_pixels = false;
};

// The first corner stays where it is, the others change places in a clockwise triangle.
constexpr int kInOrder = 1 << 24, kSwapped = 2 << 24;  // `corner`'s second entry in Candidates::kind

struct Corners {
  VI v[3];
};

// The vertex numbers of the triangles [first, first + lanes).
HWY_INLINE Corners corners_of(const TriangleBatch& batch, std::size_t first, std::size_t lanes) {
  const PrimitiveType type = batch.assembly.type();
  if (lanes < hn::Lanes(kDI)) {
    alignas(64) std::int32_t v[3][16];
    for (std::size_t i = 0; i < hn::Lanes(kDI); ++i) {
      const std::array<std::uint32_t, 3> t = batch.assembly.triangle(first + (i < lanes ? i : 0));
      for (std::size_t k = 0; k < 3; ++k) v[k][i] = static_cast<std::int32_t>(t[k]);
    }
    return {{hn::Load(kDI, v[0]), hn::Load(kDI, v[1]), hn::Load(kDI, v[2])}};
  }
  const auto* const list = reinterpret_cast<const std::int32_t*>(batch.assembly.indices().data());
  const VI number = hn::Iota(kDI, static_cast<std::int32_t>(first));
  if (type == PrimitiveType::triangles) {
    Corners c;
    if (list != nullptr) {
      hn::LoadInterleaved3(kDI, list + 3 * first, c.v[0], c.v[1], c.v[2]);
    } else {
      c.v[0] = hn::Mul(number, set(3));
      c.v[1] = hn::Add(c.v[0], set(1));
      c.v[2] = hn::Add(c.v[0], set(2));
    }
    return c;
  }
  const VI a = list != nullptr ? hn::LoadU(kDI, list + first) : number;
  const VI b = list != nullptr ? hn::LoadU(kDI, list + first + 1) : hn::Add(number, set(1));
  const VI c = list != nullptr ? hn::LoadU(kDI, list + first + 2) : hn::Add(number, set(2));
  if (type == PrimitiveType::triangle_fan) return {{set(list != nullptr ? list[0] : 0), b, c}};
  const MI odd = hn::TestBit(number, set(1));
  return {{hn::IfThenElse(odd, b, a), hn::IfThenElse(odd, a, b), c}};
}

HWY_INLINE VI word_of(const TriangleBatch& batch, int word, VI vertex) {
  return hn::GatherIndex(kDI, &batch.vertices.data()->x_q4_and_code + word, hn::ShiftLeft<2>(vertex));
}

HWY_INLINE VI min_of(const VI (&v)[3]) {
  return hn::Min(hn::Min(v[0], v[1]), v[2]);
}
HWY_INLINE VI max_of(const VI (&v)[3]) {
  return hn::Max(hn::Max(v[0], v[1]), v[2]);
}

HWY_INLINE std::uint64_t bits_of(MI mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kDI, mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

// Stores the lanes of a mask one after the other, and something after them, up to a vector. (Highway's CompressStore
// copies a table at every call where there is no instruction for it.)
class Compressor {
 public:
  HWY_INLINE explicit Compressor(MI mask) : mask_(mask), order_(order_of(mask)) {}
  HWY_INLINE void operator()(VI v, std::int32_t* to) const {
    if constexpr (kHasInstruction) {
      hn::CompressStore(v, mask_, kDI, to);
    } else {
      hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(kDI, order_)), kDI, to);
    }
  }

 private:
  static constexpr bool kHasInstruction = hn::MaxLanes(kDI) > 8;
  static HWY_INLINE VI order_of(MI mask) {
    if constexpr (kHasInstruction) return hn::Zero(kDI);
    const hn::Rebind<std::uint8_t, DI> bytes;
    return hn::PromoteTo(kDI, hn::LoadU(bytes, kLanesOfBits[bits_of(mask) & 0xFF].data()));
  }
  MI mask_;
  VI order_;
};

enum class Verdict { done, left_over, beyond_vertices };

// Adds what is to be drawn of the triangles [first, first + lanes), or leaves them over: those of `alive` may be drawn.
HWY_INLINE Verdict look_at(const TriangleBatch& batch, std::size_t first, std::size_t lanes, Candidates& to,
                           MI& alive) {
  const SetupContext& context = batch.context;
  const Corners place = corners_of(batch, first, lanes);
  const MI beyond = hn::Or(hn::Lt(min_of(place.v), set(0)),
                           hn::Gt(max_of(place.v), set(static_cast<std::int32_t>(batch.vertices.size() - 1))));
  if (!hn::AllFalse(kDI, beyond)) return Verdict::beyond_vertices;
  VI x[3], y[3];
  for (int k = 0; k < 3; ++k) x[k] = word_of(batch, 0, place.v[k]);
  const VI all = hn::And(hn::And(x[0], x[1]), x[2]), any = hn::Or(hn::Or(x[0], x[1]), x[2]);
  alive = hn::Eq(hn::And(all, set(kBeyondAny)), set(0));
  if (lanes < hn::Lanes(kDI)) alive = hn::And(alive, hn::FirstN(kDI, lanes));
  if (hn::AllFalse(kDI, alive)) return Verdict::done;
  if (!hn::AllFalse(kDI, hn::And(alive, hn::TestBit(any, set(kNeedsCare))))) return Verdict::left_over;

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
  if (hn::AllFalse(kDI, alive)) return Verdict::done;
  const MI large = hn::Gt(hn::Max(hn::Sub(right, left), hn::Sub(high, low)), set(kMaxExtent - 1));
  if (!hn::AllFalse(kDI, hn::And(alive, large))) return Verdict::left_over;

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
  if (hn::AllFalse(kDI, alive)) return Verdict::done;
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
  const VI kind = hn::IfThenElse(clockwise, set(kSwapped | front), set(kInOrder | other_front));
  keep(hn::Or(kind, hn::IfThenElseZero(pixel, set(static_cast<int>(SetupKind::pixel)))), to.kind);
  keep(hn::Iota(kDI, static_cast<std::int32_t>(first)), to.primitive);
  to.count += hn::CountTrue(kDI, alive);
  to.has_pixels = to.has_pixels || !hn::AllFalse(kDI, hn::And(pixel, alive));
  return Verdict::done;
}

#include "src/raster/triangle_batch_output.inl"

TriangleBatchResult set_up_range(const TriangleBatch& batch, std::size_t begin, std::size_t end,
                                 TriangleBatchOutput out) {
  const SetupPrimitive* const first_written = out.primitives;
  Candidates candidates;
  for (auto& lanes : candidates.vertex)
    std::memset(lanes, 0, sizeof lanes);  // what is beyond the last one is read, too
  TriangleBatchResult result{.next = end};
  for (std::size_t i = begin; i < end; i += hn::Lanes(kDI)) {
    const std::size_t lanes = end - i < hn::Lanes(kDI) ? end - i : hn::Lanes(kDI);
    MI alive;
    const Verdict verdict = look_at(batch, i, lanes, candidates, alive);
    if (verdict != Verdict::done) {
      result.is_beyond_vertices = verdict == Verdict::beyond_vertices;
      result.left_over = result.is_beyond_vertices ? 0 : bits_of(alive);
      result.first_left_over = i;
      result.next = i + lanes;
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
