// The kernels that multiply. They give the bits of arithmetic.inl's rules by other formulas. The comments here prove
// that these are exact, and tests try every input.
#if defined(NINEBIT_COMBINER_BATCH_PRODUCTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_COMBINER_BATCH_PRODUCTS_INL_H
#undef NINEBIT_COMBINER_BATCH_PRODUCTS_INL_H
#else
#define NINEBIT_COMBINER_BATCH_PRODUCTS_INL_H
#endif

#include <type_traits>

#include "src/combiner/batch_sources-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What is added to a quotient: nothing, the formula's offset, or the last source.
enum class Added { nothing, offset, source };

template <int kTerms, Reads kReads, bool kNearest, int kDoublings, Added kAdded>
HWY_NOINLINE void unsigned_products(const Operations& operations, const Batch& batch) {
  const Formula& f = operations.first->formula;
  const VU16 high = set_unsigned(f.clamps() ? f.high : hwy::LimitsMax<std::uint16_t>());
  const VU16 offset = set_unsigned(f.offset);
  constexpr std::size_t kSources = 2 * kTerms + (kAdded == Added::source ? 1 : 0);
  for_lanes<kSources, kReads>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const auto product = [&](std::size_t k)
                             HWY_ATTR { return hn::Mul(x.get_unsigned(2 * k, lane), x.get_unsigned(2 * k + 1, lane)); };
    VU16 sum = product(0);
    if (kTerms > 1) sum = hn::SaturatedAdd(sum, product(1));
    if (kTerms > 2) sum = hn::SaturatedAdd(sum, product(2));
    VU16 code = narrowed<kNearest, kDoublings>(sum);
    if constexpr (kAdded == Added::offset) code = hn::Add(code, offset);
    if constexpr (kAdded == Added::source) code = hn::Add(code, x.get_unsigned(2 * kTerms, lane));
    return hn::BitCast(kD16, hn::Min(code, high));
  });
}

// Narrows magnitudes, then restores the sign. 255 is odd: there are no ties, so both narrowings are symmetric.
template <Reads kReads, bool kPositiveFirst, bool kNearest, int kDoublings>
HWY_NOINLINE void signed_product(const Operations& operations, const Batch& batch) {
  const Formula& f = operations.first->formula;
  const VU16 farthest = set_unsigned(f.clamps() ? f.high : hwy::LimitsMax<std::uint16_t>());
  for_lanes<2, kReads>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const V16 a = x.get(0, lane), b = x.get(1, lane);
    const VU16 n = hn::Mul(hn::BitCast(kU16, kPositiveFirst ? a : hn::Abs(a)), hn::BitCast(kU16, hn::Abs(b)));
    const VU16 code = hn::Min(narrowed<kNearest, kDoublings>(n), farthest);
    return kPositiveFirst ? with_sign(code, b) : with_signs(code, a, b);
  });
}

// The sum fits into 16 bits, so it need not be taken apart.
template <int kTerms, Reads kReads, bool kNearest, int kDoublings>
HWY_NOINLINE void signed_sum(const Operations& operations, const Batch& batch) {
  const Formula& f = operations.first->formula;
  const V16 offset = set(f.offset);
  const VU16 farthest = set_unsigned(f.clamps() ? f.high : hwy::LimitsMax<std::uint16_t>());
  for_lanes<2 * kTerms, kReads>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    V16 sum = hn::Add(hn::Mul(x.get(0, lane), x.get(1, lane)), offset);
    if (kTerms > 1) sum = hn::Add(sum, hn::Mul(x.get(2, lane), x.get(3, lane)));
    const VU16 n = hn::BitCast(kU16, hn::Abs(sum));
    return with_sign(hn::Min(narrowed<kNearest, kDoublings>(n), farthest), sum);
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
template <int kTerms, Reads kReads, bool kNearest, bool kBiased>
HWY_NOINLINE void products(const Operations& operations, const Batch& batch) {
  const Formula& f = operations.first->formula;
  const Clamp clamp(f);
  const VF32 bias = hn::Set(kF32, f.bias), reciprocal = hn::Set(kF32, f.reciprocal);
  for_lanes<2 * kTerms, kReads>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
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

using Run = void (*)(const Operations&, const Batch&);

template <class F>
HWY_INLINE Run choose(bool flag, const F& f) {
  return flag ? f(std::true_type()) : f(std::false_type());
}

// Calls f<kReads>() with the first of the masks that covers the operation's lines. Differences need just its lines.
template <bool kDifferences, std::uint32_t kFirst, std::uint32_t... kMore, class F>
HWY_INLINE Run choose_lines(const VectorOperation& operation, const F& f) {
  if constexpr (sizeof...(kMore) > 0) {
    if ((operation.lines & ~kFirst) != 0) return choose_lines<kDifferences, kMore...>(operation, f);
  }
  if (operation.formula.floors == 0) return f.template operator()<Reads{0, kFirst, kDifferences}>();
  return f.template operator()<Reads{~0U, kFirst, kDifferences}>();
}

// The same, or with no lines.
template <bool kDifferences, std::uint32_t... kLines, class F>
HWY_INLINE Run choose_reads(const VectorOperation& operation, const F& f) {
  if (operation.lines != 0) return choose_lines<kDifferences, kLines...>(operation, f);
  return operation.formula.floors != 0 ? f.template operator()<kAllFloors>() : f.template operator()<kPlain>();
}

// The planner puts lines first in a product, and products with more lines first. Sums of more than three products, or
// of three that are not negative, have none.
template <bool kDifferences, int kTerms, class F>
HWY_INLINE Run choose_product_reads(const VectorOperation& operation, const F& f) {
  if constexpr (kTerms == 1) return choose_reads<kDifferences, 0b01, 0b11>(operation, f);
  if constexpr (kTerms == 2 && kDifferences) {
    return choose_reads<true, 0b0001, 0b0011, 0b0101, 0b0111, 0b1111>(operation, f);
  }
  if constexpr (kTerms == 2) return choose_reads<false, 0b0001, 0b0101, 0b1111>(operation, f);
  if constexpr (kTerms == 3 && !kDifferences) return choose_reads<false, 0b111111>(operation, f);
  return operation.formula.floors != 0 ? f.template operator()<kAllFloors>() : f.template operator()<kPlain>();
}

template <int kTerms>
HWY_INLINE Run unsigned_products_of(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  return choose_product_reads<true, kTerms>(operation, [&]<Reads kReads>() {
    return choose(f.nearest, [&](auto nearest) -> Run {
      constexpr bool kNearest = decltype(nearest)::value;
      // Only the final combiner adds, and it does not scale.
      if (f.adds) return unsigned_products<kTerms, kReads, kNearest, 0, Added::source>;
      if (f.offset != 0) return unsigned_products<kTerms, kReads, kNearest, 0, Added::offset>;
      return f.doublings == 0   ? unsigned_products<kTerms, kReads, kNearest, 0, Added::nothing>
             : f.doublings == 1 ? unsigned_products<kTerms, kReads, kNearest, 1, Added::nothing>
                                : unsigned_products<kTerms, kReads, kNearest, 2, Added::nothing>;
    });
  });
}

template <Reads kReads, bool kPositiveFirst>
HWY_INLINE Run signed_product_for(const Formula& f) {
  return choose(f.nearest, [&](auto nearest) -> Run {
    constexpr bool kNearest = decltype(nearest)::value;
    return f.doublings == 0   ? signed_product<kReads, kPositiveFirst, kNearest, 0>
           : f.doublings == 1 ? signed_product<kReads, kPositiveFirst, kNearest, 1>
                              : signed_product<kReads, kPositiveFirst, kNearest, 2>;
  });
}

HWY_INLINE Run signed_product_of(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  if (f.positive_first) {
    return choose_reads<false, 0b01, 0b10, 0b11>(operation,
                                                 [&]<Reads kReads>() { return signed_product_for<kReads, true>(f); });
  }
  if (operation.lines == 0) return signed_product_for<kPlain, false>(f);
  return choose_lines<false, 0b01, 0b11>(operation,
                                         [&]<Reads kReads>() { return signed_product_for<kReads, false>(f); });
}

template <int kTerms>
HWY_INLINE Run signed_sum_of(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  return choose_product_reads<false, kTerms>(operation, [&]<Reads kReads>() {
    return choose(f.nearest, [&](auto nearest) -> Run {
      constexpr bool kNearest = decltype(nearest)::value;
      return f.doublings == 0   ? signed_sum<kTerms, kReads, kNearest, 0>
             : f.doublings == 1 ? signed_sum<kTerms, kReads, kNearest, 1>
                                : signed_sum<kTerms, kReads, kNearest, 2>;
    });
  });
}

template <int kTerms>
HWY_INLINE Run products_for(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  return choose_product_reads<false, kTerms>(operation, [&]<Reads kReads>() {
    return choose(f.nearest, [&](auto nearest) {
      constexpr bool kNearest = decltype(nearest)::value;
      // Sums of more than three products are pairs of dot products, and rare: they always run the biased kernel.
      return choose(kTerms > 3 || f.bias != 0, [&](auto biased) -> Run {
        return products < kTerms, kReads, kNearest, kTerms <= 3 ? decltype(biased)::value : true > ;
      });
    });
  });
}

HWY_INLINE Run products_of(const VectorOperation& operation) {
  switch (operation.formula.terms) {
    case 1:
      return products_for<1>(operation);
    case 2:
      return products_for<2>(operation);
    case 3:
      return products_for<3>(operation);
    case 4:
      return products_for<4>(operation);
    case 5:
      return products_for<5>(operation);
    default:
      return products_for<6>(operation);
  }
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
