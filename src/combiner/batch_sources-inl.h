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
  explicit HWY_INLINE Clamp(const Formula& f) : low_(set(f.low)), high_(set(f.high)) {}
  HWY_INLINE V16 operator()(V16 v) const { return hn::Min(hn::Max(v, low_), high_); }

 private:
  V16 low_, high_;
};

// The sources that a kernel maps as it reads them, a bit a source: first max(x, 0) where the formula has it, then the
// operation's line.
struct Reads {
  std::uint32_t floors = 0;
  std::uint32_t differences = 0, sums = 0, lines = 0;  // the factor is -1, 1, or any
  [[nodiscard]] constexpr bool has_floor(std::size_t k) const { return (floors >> k & 1U) != 0; }
  [[nodiscard]] constexpr bool has_difference(std::size_t k) const { return (differences >> k & 1U) != 0; }
  [[nodiscard]] constexpr bool has_sum(std::size_t k) const { return (sums >> k & 1U) != 0; }
  [[nodiscard]] constexpr bool has_line(std::size_t k) const { return (lines >> k & 1U) != 0; }
  // Whether a kernel that reads in this way serves an operation that needs `other`. A source without a line has the
  // factor 1 and the offset 0.
  [[nodiscard]] constexpr bool covers(const Reads& other) const {
    return (other.floors & ~floors) == 0 && (differences & ~other.differences) == 0 &&
           (other.differences & ~(differences | lines)) == 0 && (other.sums & ~(sums | lines)) == 0 &&
           (other.lines & ~lines) == 0;
  }
};
constexpr Reads kPlain{};
constexpr Reads kAllFloors{.floors = ~0U};

// The sources of an operation, mapped.
template <std::size_t kSources, Reads kReads>
class Sources {
 public:
  explicit HWY_INLINE Sources(const VectorOperation& operation) {
    for (std::size_t k = 0; k < kSources; ++k) {
      if (kReads.has_floor(k)) floor_[k] = set(operation.formula.is_floored(k) ? 0 : hwy::LimitsMin<std::int16_t>());
      if (kReads.has_line(k)) factor_[k] = set(operation.line[k].factor);
      if (kReads.has_difference(k) || kReads.has_sum(k) || kReads.has_line(k))
        offset_[k] = set(operation.line[k].offset);
    }
  }
  HWY_INLINE void find(const VectorOperation& operation, const Batch& batch) {
    for (std::size_t k = 0; k < kSources; ++k) plane_[k] = batch(operation.source[k]);
  }
  HWY_INLINE V16 get(std::size_t k, std::size_t lane) const {
    V16 v = hn::LoadU(kD16, plane_[k] + lane);
    if (kReads.has_floor(k)) v = hn::Max(v, floor_[k]);
    if (kReads.has_difference(k)) return hn::Sub(offset_[k], v);
    if (kReads.has_line(k)) v = hn::Mul(v, factor_[k]);
    return kReads.has_sum(k) || kReads.has_line(k) ? hn::Add(v, offset_[k]) : v;
  }
  HWY_INLINE VU16 get_unsigned(std::size_t k, std::size_t lane) const { return hn::BitCast(kU16, get(k, lane)); }

 private:
  const s9* plane_[kSources];
  V16 floor_[kSources], factor_[kSources], offset_[kSources];
};

// The lanes of a batch that one step computes.
constexpr std::size_t kLanesAStep = 2 * hn::MaxLanes(kD16);

// Computes target = f(sources, lane) for each operation, step by step.
template <std::size_t kSources, Reads kReads, class F>
HWY_INLINE void for_lanes(const Operations& operations, const Batch& batch, const F& f) {
  Sources<kSources, kReads> sources(*operations.first);
  const std::size_t lanes = batch.lanes;
  for (std::size_t i = 0; i < operations.count; ++i) {
    sources.find(operations.first[i], batch);
    s9* const target = batch(operations.first[i].target);
    std::size_t lane = 0;
    do {
      hn::StoreU(f(sources, lane), kD16, target + lane);
      hn::StoreU(f(sources, lane + kLanesAStep / 2), kD16, target + lane + kLanesAStep / 2);
      lane += kLanesAStep;
    } while (lane < lanes);
  }
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
