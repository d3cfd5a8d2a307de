// How a kernel reads and writes the planes of its operations.
#if defined(NINEBIT_COMBINER_BATCH_SOURCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_COMBINER_BATCH_SOURCES_INL_H
#undef NINEBIT_COMBINER_BATCH_SOURCES_INL_H
#else
#define NINEBIT_COMBINER_BATCH_SOURCES_INL_H
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/combiner/lanes-inl.h"
#include "src/combiner/vector_code.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The operations that a kernel runs, one after the other. All have the formula and the lines of the first.
struct Operations {
  const VectorOperation* first;
  std::size_t count;
};

// The planes of a batch, and the number of lanes to run for.
struct Batch {
  std::array<s9*, 4> base;
  std::array<unsigned, 4> shift;  // log2 of the distance between planes
  std::size_t lanes;

  HWY_INLINE s9* operator()(const PlanePlace& plane) const {
    const auto space = static_cast<std::size_t>(plane.space);
    return base[space] + (static_cast<std::size_t>(plane.index) << shift[space]);
  }
};

// A formula's limits. Without a clamp these are the limits of 16 bits, which is cheaper than a test in each vector.
class Clamp {
 public:
  explicit HWY_INLINE Clamp(const Formula& f)
      : low_(set(f.clamps() ? f.low : hwy::LimitsMin<std::int16_t>())),
        high_(set(f.clamps() ? f.high : hwy::LimitsMax<std::int16_t>())) {}
  HWY_INLINE V16 operator()(V16 v) const { return hn::Min(hn::Max(v, low_), high_); }

 private:
  V16 low_, high_;
};

// The sources that a kernel maps as it reads them, a bit a source: first max(x, 0) where the formula has it, then the
// operation's line. A kernel may map more sources than an operation needs.
struct Reads {
  std::uint32_t floors = 0, lines = 0;
  bool differences = false;  // all lines have the factor -1
  [[nodiscard]] constexpr bool has_floor(std::size_t k) const { return (floors >> k & 1U) != 0; }
  [[nodiscard]] constexpr bool has_line(std::size_t k) const { return (lines >> k & 1U) != 0; }
};
constexpr Reads kPlain{};
constexpr Reads kAllFloors{~0U, 0};

// The sources of an operation, mapped.
template <std::size_t kSources, Reads kReads>
class Sources {
 public:
  explicit HWY_INLINE Sources(const VectorOperation& operation) {
    for (std::size_t k = 0; k < kSources; ++k) {
      if (kReads.has_floor(k)) floor_[k] = set(operation.formula.is_floored(k) ? 0 : hwy::LimitsMin<std::int16_t>());
      if (kReads.has_line(k)) {
        if (!kReads.differences) factor_[k] = set(operation.line[k].factor);
        offset_[k] = set(operation.line[k].offset);
      }
    }
  }
  HWY_INLINE void find(const VectorOperation& operation, const Batch& batch) {
    for (std::size_t k = 0; k < kSources; ++k) plane_[k] = batch(operation.source[k]);
  }
  HWY_INLINE V16 get(std::size_t k, std::size_t lane) const {
    V16 v = hn::LoadU(kD16, plane_[k] + lane);
    if (kReads.has_floor(k)) v = hn::Max(v, floor_[k]);
    if (!kReads.has_line(k)) return v;
    return kReads.differences ? hn::Sub(offset_[k], v) : hn::Add(hn::Mul(v, factor_[k]), offset_[k]);
  }
  HWY_INLINE VU16 get_unsigned(std::size_t k, std::size_t lane) const { return hn::BitCast(kU16, get(k, lane)); }

 private:
  const s9* plane_[kSources];
  V16 floor_[kSources], factor_[kSources], offset_[kSources];
};

// Computes target = f(sources, lane) for each operation, vector by vector.
template <std::size_t kSources, Reads kReads, class F>
HWY_INLINE void for_lanes(const Operations& operations, const Batch& batch, const F& f) {
  Sources<kSources, kReads> sources(*operations.first);
  const std::size_t lanes = batch.lanes;
  for (std::size_t i = 0; i < operations.count; ++i) {
    sources.find(operations.first[i], batch);
    s9* const target = batch(operations.first[i].target);
    constexpr std::size_t kStep = hn::MaxLanes(kD16);
    // f stands here twice, and not a third time after the loop: there are 450 kernels for each target.
    for (std::size_t lane = 0; lane < lanes; lane += 2 * kStep) {
      hn::StoreU(f(sources, lane), kD16, target + lane);
      if (lane + kStep >= lanes) break;
      hn::StoreU(f(sources, lane + kStep), kD16, target + lane + kStep);
    }
  }
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
