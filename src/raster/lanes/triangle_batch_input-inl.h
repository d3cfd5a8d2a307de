// The vertices of several triangles.
#if defined(NINEBIT_RASTER_LANES_TRIANGLE_BATCH_INPUT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_TRIANGLE_BATCH_INPUT_INL_H_
#undef NINEBIT_RASTER_LANES_TRIANGLE_BATCH_INPUT_INL_H_
#else
#define NINEBIT_RASTER_LANES_TRIANGLE_BATCH_INPUT_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_records-inl.h"
#include "src/raster/lanes/triangle_batch.h"
#include "src/raster/lanes/triangle_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The vertex numbers of several triangles.
struct Corners {
  VI v[3];
};

// Fewer triangles than a vector has lanes: the others repeat the first. A function of its own, because Clang 14 for
// WebAssembly gave the first lane the second triangle where these stores and the loads behind them became one.
HWY_NOINLINE void store_corners(const PrimitiveAssembly& assembly, std::size_t first, std::size_t lanes,
                                std::int32_t (&v)[3][16]) {
  for (std::size_t i = 0; i < hn::Lanes(kDI); ++i) {
    const std::array<std::uint32_t, 3> t = assembly.triangle(first + (i < lanes ? i : 0));
    for (std::size_t k = 0; k < 3; ++k) v[k][i] = static_cast<std::int32_t>(t[k]);
  }
}

// The vertex numbers of the triangles [first, first + lanes).
HWY_INLINE Corners corners_of(const TriangleBatch& batch, std::size_t first, std::size_t lanes) {
  const PrimitiveType type = batch.assembly.type();
  if (lanes < hn::Lanes(kDI)) {
    alignas(64) std::int32_t v[3][16];
    store_corners(batch.assembly, first, lanes, v);
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

// A word of the vertices: 0 and 1 are x with the outcode and y, 2 the depth, 3 is 1/w.
HWY_INLINE VI word_of(const TriangleBatch& batch, int word, VI vertex) {
  return hn::GatherIndex(kDI, &batch.vertices.data()->x_q4_and_code + word, hn::ShiftLeft<2>(vertex));
}

// Two neighbouring words of the vertices: 0 and 1, or 2 and 3. The second one only if it is there, `second` not null.
template <int kFirst>
HWY_INLINE void words_of(const TriangleBatch& batch, VI vertex, VI& first, VI* second) {
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
  first = word_of(batch, kFirst, vertex);
  if (second != nullptr) *second = word_of(batch, kFirst + 1, vertex);
#else
  alignas(64) std::int32_t number[16];
  hn::Store(vertex, kDI, number);
  VI word[4];
  const auto at = [&](std::size_t lane)
                      HWY_ATTR { return &batch.vertices[static_cast<std::size_t>(number[lane])].x_q4_and_code; };
  load_four_words(kDI, at, word);
  first = word[kFirst];
  if (second != nullptr) *second = word[kFirst + 1];
#endif
}

// How many triangles are dropped at once where they lie beyond one side of the view, and how many vertices that may
// take to see: neighbours in a list mostly share their vertices.
constexpr std::size_t kDroppedTogether = 256;
constexpr std::size_t kMostInspected = 2048;

// The smallest and the largest vertex number of the triangles [first, first + kDroppedTogether).
struct VertexRange {
  std::int64_t first, last;
};

HWY_INLINE VertexRange vertex_range(const TriangleBatch& batch, std::size_t first) {
  const PrimitiveType type = batch.assembly.type();
  const bool is_list = type == PrimitiveType::triangles;
  const std::size_t begin = is_list ? 3 * first : first;
  const std::size_t count = is_list ? 3 * kDroppedTogether : kDroppedTogether + 2;
  const auto indices = batch.assembly.indices();
  if (indices.data() == nullptr) {
    const auto from = static_cast<std::int64_t>(type == PrimitiveType::triangle_fan ? 0 : begin);
    return {from, static_cast<std::int64_t>(begin + count) - 1};
  }
  const auto* const list = reinterpret_cast<const std::int32_t*>(indices.data());
  VI least = hn::LoadU(kDI, list + begin), most = least;
  for (std::size_t i = 0; i < count; i += hn::Lanes(kDI)) {
    // The last vector repeats some of the one before.
    const VI v = hn::LoadU(kDI, list + begin + std::min(i, count - hn::Lanes(kDI)));
    least = hn::Min(least, v);
    most = hn::Max(most, v);
  }
  if (type == PrimitiveType::triangle_fan) {
    least = hn::Min(least, set(list[0]));
    most = hn::Max(most, set(list[0]));
  }
  return {hn::GetLane(hn::MinOfLanes(kDI, least)), hn::GetLane(hn::MaxOfLanes(kDI, most))};
}

// True if the triangles [first, first + kDroppedTogether) are seen to lie beyond one side of the view.
HWY_INLINE bool are_beyond_a_side(const TriangleBatch& batch, std::size_t first) {
  const auto [least, most] = vertex_range(batch, first);
  if (least < 0 || most >= static_cast<std::int64_t>(batch.vertices.size())) return false;
  if (most - least >= static_cast<std::int64_t>(kMostInspected)) return false;
  std::int32_t beyond = kBeyondAny;
  for (std::int64_t v = least; v <= most && beyond != 0; ++v) {
    beyond &= batch.vertices[static_cast<std::size_t>(v)].x_q4_and_code;
  }
  return beyond != 0;
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
