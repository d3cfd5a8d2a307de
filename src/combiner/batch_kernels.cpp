// The vector operations of vector_code.h, in 16-bit lanes where those suffice. They give the bits of arithmetic.inl's
// rules by other formulas. The comments here prove that these are exact, and tests try every input.
#include "src/combiner/batch_kernels.h"

#include <algorithm>
#include <array>
#include <type_traits>

// Kernels keep vectors as members of objects. Vectors of a size unknown to the compiler do not allow that.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/combiner/batch_kernels.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/combiner/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The planes of an operation, and the number of lanes that it runs for.
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

// The planes that an operation reads, found once, and the minimum for each of the first kFloors.
template <std::size_t kSources, std::size_t kFloors>
class Sources {
 public:
  HWY_INLINE Sources(const VectorOperation& operation, const Batch& batch) {
    for (std::size_t k = 0; k < kSources; ++k) {
      plane_[k] = batch(operation.source[k]);
      if (k < kFloors) floor_[k] = set(operation.formula.is_floored(k) ? 0 : hwy::LimitsMin<std::int16_t>());
    }
  }
  HWY_INLINE V16 get(std::size_t k, std::size_t lane) const {
    const V16 v = hn::LoadU(kD16, plane_[k] + lane);
    return k < kFloors ? hn::Max(v, floor_[k]) : v;
  }
  HWY_INLINE VU16 get_unsigned(std::size_t k, std::size_t lane) const { return hn::BitCast(kU16, get(k, lane)); }

 private:
  const s9* plane_[kSources];
  V16 floor_[kFloors > 0 ? kFloors : 1];
};

// Computes target = f(sources, lane), vector by vector.
template <std::size_t kSources, std::size_t kFloors, class F>
HWY_INLINE void for_floored_lanes(const VectorOperation& operation, const Batch& batch, const F& f) {
  const Sources<kSources, kFloors> sources(operation, batch);
  s9* const target = batch(operation.target);
  const std::size_t lanes = batch.lanes;
  for (std::size_t lane = 0; lane < lanes; lane += hn::MaxLanes(kD16)) {
    hn::StoreU(f(sources, lane), kD16, target + lane);
  }
}

template <std::size_t kSources, bool kFloors, class F>
HWY_INLINE void for_lanes(const VectorOperation& operation, const Batch& batch, const F& f) {
  for_floored_lanes<kSources, kFloors ? kSources : 0>(operation, batch, f);
}

template <int kTerms, bool kFloors>
class Affine {
 public:
  explicit HWY_INLINE Affine(const Formula& f)
      : factor0_(set(f.factor[0])), factor1_(set(f.factor[1])), offset_(set(f.offset)) {}
  template <class X>
  HWY_INLINE V16 operator()(const X& x, std::size_t lane) const {
    const V16 sum = hn::Add(hn::Mul(x.get(0, lane), factor0_), offset_);
    return kTerms == 2 ? hn::Add(sum, hn::Mul(x.get(1, lane), factor1_)) : sum;
  }

 private:
  V16 factor0_, factor1_, offset_;
};

template <int kTerms, bool kFloors, bool kClamps>
HWY_NOINLINE void affine(const VectorOperation& operation, const Batch& batch) {
  const Affine<kTerms, kFloors> sum(operation.formula);
  const Clamp clamp(operation.formula);
  for_lanes<kTerms, kFloors>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const V16 v = sum(x, lane);
    return kClamps ? clamp(v) : v;
  });
}

// Halves up is a shift of the value plus one; toward zero adds the one to negative values only.
template <int kTerms>
HWY_NOINLINE void half_of_affine(const VectorOperation& operation, const Batch& batch) {
  const Affine<kTerms, true> sum(operation.formula);
  const Clamp clamp(operation.formula);
  const bool nearest = operation.formula.nearest;
  for_lanes<kTerms, true>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const V16 v = sum(x, lane);
    const V16 more = nearest ? set(1) : hn::BitCast(kD16, hn::ShiftRight<15>(hn::BitCast(kU16, v)));
    return clamp(hn::ShiftRight<1>(hn::Add(v, more)));
  });
}

template <int kTerms, bool kFloors, bool kNearest, int kDoublings, bool kAdds>
HWY_NOINLINE void unsigned_products(const VectorOperation& operation, const Batch& batch) {
  const Formula& f = operation.formula;
  const VU16 high = set_unsigned(f.clamps() ? f.high : hwy::LimitsMax<std::uint16_t>());
  for_lanes<2 * kTerms + (kAdds ? 1 : 0), kFloors>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const auto product = [&](std::size_t k)
                             HWY_ATTR { return hn::Mul(x.get_unsigned(2 * k, lane), x.get_unsigned(2 * k + 1, lane)); };
    VU16 sum = product(0);
    if (kTerms > 1) sum = hn::SaturatedAdd(sum, product(1));
    if (kTerms > 2) sum = hn::SaturatedAdd(sum, product(2));
    VU16 code = narrowed<kNearest>(doubled<kDoublings>(sum));
    if constexpr (kAdds) code = hn::Add(code, x.get_unsigned(2 * kTerms, lane));
    return hn::BitCast(kD16, hn::Min(code, high));
  });
}

// Narrows magnitudes, then restores the sign. 255 is odd: there are no ties, so both narrowings are symmetric.
template <bool kFloors, bool kPositiveFirst, bool kNearest, int kDoublings>
HWY_NOINLINE void signed_product(const VectorOperation& operation, const Batch& batch) {
  const Formula& f = operation.formula;
  const VU16 farthest = set_unsigned(f.clamps() ? f.high : hwy::LimitsMax<std::uint16_t>());
  for_floored_lanes<2, kFloors ? 1 : 0>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const V16 a = x.get(0, lane), b = x.get(1, lane);
    const VU16 n = hn::Mul(hn::BitCast(kU16, kPositiveFirst ? a : hn::Abs(a)), hn::BitCast(kU16, hn::Abs(b)));
    const VU16 code = hn::Min(narrowed<kNearest>(doubled<kDoublings>(n)), farthest);
    return kPositiveFirst ? with_sign(code, b) : with_signs(code, a, b);
  });
}

// Let n be the sum with its bias, and the reciprocal 2^k / one, rounded up to a float: at most 2^-23 of itself too
// large. |2^k n| is below 2^21 (six products of 256² times four) and its quotient below 2^13, where a number is at most
// 2^-12 away from a float. A float holds n exactly. So n · reciprocal is too large by less than 1 / (4 one), and is
// then moved by 2^-12 at most:
// - Where the quotient is whole the product is not below it, and neither is the float; else the next whole number is at
//   least 1 / (2 one) above, out of reach. So truncating is exact; for negative n the same with the signs changed.
// - One is odd. So with k >= 0 no quotient is a tie, but at least 1 / (2 one) away from one. With k = -1 the bias
//   has one half more: a tie is 1 / (4 one) away, and n being below 2^19, the product at most 1 / (32 one) too large.
template <int kTerms, bool kFloors, bool kNearest, bool kBiased>
HWY_NOINLINE void products(const VectorOperation& operation, const Batch& batch) {
  const Formula& f = operation.formula;
  const Clamp clamp(f);
  const VF32 bias = hn::Set(kF32, f.bias), reciprocal = hn::Set(kF32, f.reciprocal);
  for_lanes<2 * kTerms, kFloors>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const auto factor = [&](std::size_t k) HWY_ATTR { return x.get(k, lane); };
    Wide sum;
    if constexpr (kTerms == 1) {
      sum = multiply(factor(0), factor(1));
    } else {
      sum = multiply(factor(0), factor(1), factor(2), factor(3));
    }
    for (std::size_t k = 2; k < kTerms; k += 2) {
      const Wide more = k + 1 < kTerms
                            ? multiply(factor(2 * k), factor(2 * k + 1), factor(2 * k + 2), factor(2 * k + 3))
                            : multiply(factor(2 * k), factor(2 * k + 1));
      sum = {hn::Add(sum.first, more.first), hn::Add(sum.second, more.second)};
    }
    const auto code = [&](V32 n) HWY_ATTR {
      VF32 v = hn::ConvertTo(kF32, n);
      if (kBiased) v = hn::Add(v, bias);
      return to_integers(hn::Mul(v, reciprocal), kNearest);
    };
    return clamp(narrow_to_16(code(sum.first), code(sum.second)));
  });
}

template <bool kFloors>
HWY_NOINLINE void select(const VectorOperation& operation, const Batch& batch) {
  const V16 limit = set(operation.formula.low);
  for_lanes<3, kFloors>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    return hn::IfThenElse(hn::Lt(x.get(0, lane), limit), x.get(1, lane), x.get(2, lane));
  });
}

template <bool kFloors>
HWY_NOINLINE void select_odd(const VectorOperation& operation, const Batch& batch) {
  for_lanes<3, kFloors>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    return hn::IfThenElse(hn::TestBit(x.get(0, lane), set(1)), x.get(2, lane), x.get(1, lane));
  });
}

HWY_NOINLINE void copy(const VectorOperation& operation, const Batch& batch) {
  for_lanes<1, false>(operation, batch, [&](const auto& x, std::size_t lane) HWY_ATTR { return x.get(0, lane); });
}

using Run = void (*)(const VectorOperation&, const Batch&);

template <class F>
HWY_INLINE Run choose(bool flag, const F& f) {
  return flag ? f(std::true_type()) : f(std::false_type());
}

template <int kTerms, bool kFloors>
HWY_INLINE Run unsigned_products_of(const Formula& f) {
  return choose(f.nearest, [&](auto nearest) -> Run {
    constexpr bool kNearest = decltype(nearest)::value;
    if (f.adds) return unsigned_products<kTerms, kFloors, kNearest, 0, true>;
    return f.doublings == 0   ? unsigned_products<kTerms, kFloors, kNearest, 0, false>
           : f.doublings == 1 ? unsigned_products<kTerms, kFloors, kNearest, 1, false>
                              : unsigned_products<kTerms, kFloors, kNearest, 2, false>;
  });
}

template <bool kFloors, bool kPositiveFirst>
HWY_INLINE Run signed_product_of(const Formula& f) {
  return choose(f.nearest, [&](auto nearest) -> Run {
    constexpr bool kNearest = decltype(nearest)::value;
    return f.doublings == 0   ? signed_product<kFloors, kPositiveFirst, kNearest, 0>
           : f.doublings == 1 ? signed_product<kFloors, kPositiveFirst, kNearest, 1>
                              : signed_product<kFloors, kPositiveFirst, kNearest, 2>;
  });
}

template <bool kFloors>
HWY_INLINE Run products_of(const Formula& f) {
  return choose(f.nearest, [&](auto nearest) {
    constexpr bool kNearest = decltype(nearest)::value;
    // Sums of more than two products are dot products, which seldom have a bias: they always run the biased kernel.
    static constexpr Run kRuns[] = {products<3, kFloors, kNearest, true>, products<4, kFloors, kNearest, true>,
                                    products<5, kFloors, kNearest, true>, products<6, kFloors, kNearest, true>};
    if (f.terms > 2) return kRuns[f.terms - 3];
    return choose(f.bias != 0, [&](auto biased) -> Run {
      constexpr bool kBiased = decltype(biased)::value;
      return f.terms == 1 ? products<1, kFloors, kNearest, kBiased> : products<2, kFloors, kNearest, kBiased>;
    });
  });
}

template <bool kFloors>
HWY_INLINE Run kernel_of(const Formula& f) {
  switch (f.kernel) {
    case Kernel::affine:
      if (f.halves) return f.terms == 1 ? half_of_affine<1> : half_of_affine<2>;
      if (f.clamps()) return f.terms == 1 ? affine<1, kFloors, true> : affine<2, kFloors, true>;
      return f.terms == 1 ? affine<1, kFloors, false> : affine<2, kFloors, false>;
    case Kernel::unsigned_products:
      return f.terms == 1   ? unsigned_products_of<1, kFloors>(f)
             : f.terms == 2 ? unsigned_products_of<2, kFloors>(f)
                            : unsigned_products_of<3, kFloors>(f);
    case Kernel::signed_product:
      return f.positive_first ? signed_product_of<kFloors, true>(f) : signed_product_of<false, false>(f);
    case Kernel::products:
      return products_of<kFloors>(f);
    case Kernel::select:
      return select<kFloors>;
    case Kernel::select_odd:
      return select_odd<kFloors>;
    case Kernel::copy:
      break;
  }
  return copy;
}

// 32 KiB: together with the planes that are read they fit the first-level cache.
constexpr std::size_t kTemporaryLanes = 16384;
constexpr unsigned kBatchShift = 9;
static_assert(kBatchSize == std::size_t{1} << kBatchShift);

void run_code(const VectorCode& code, RegisterBatch& registers, std::size_t count, OutputBatch& out) {
  alignas(64) s9 temporaries[kTemporaryLanes];
  // As many lanes at once as leave room for all temporaries, of which there are never more than 512 (60 a stage).
  unsigned shift = kBatchShift;
  while ((code.temporaries << shift) > kTemporaryLanes) --shift;
  // Beside planes that are written; no operation writes these. NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  s9* const constants = const_cast<s9*>(code.constants.empty() ? nullptr : code.constants[0].lane.data());
  Batch batch{{registers.plane[0][0].data(), out.plane[0].data(), constants, temporaries},
              {kBatchShift, kBatchShift, kBatchShift, shift},
              0};
  for (std::size_t first = 0; first < count; first += batch.lanes) {
    batch.lanes = std::min(std::size_t{1} << shift, count - first);
    for (const VectorOperation& operation : code.operations) {
      const Formula& f = operation.formula;
      (f.floors == 0 ? kernel_of<false>(f) : kernel_of<true>(f))(operation, batch);
    }
    batch.base[0] += batch.lanes;
    batch.base[1] += batch.lanes;
  }
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {
namespace detail {
HWY_EXPORT(run_code);

void run_vector_code(const VectorCode& code, RegisterBatch& registers, std::size_t count, OutputBatch& out) {
  HWY_DYNAMIC_DISPATCH(run_code)(code, registers, count, out);
}
}  // namespace detail

const char* simd_target() {
  // Highway numbers targets so that the lowest set bit is the best one.
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(usable & -usable);
}

}  // namespace ninebit
#endif
