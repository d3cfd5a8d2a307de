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

// Returns n · 2^doublings / 255, rounded down or to nearest: exact while n · 2^doublings is at most 65407, at least 256
// beyond.
// - Without a shift, to nearest or without doublings: let m be n + 128 / 2^doublings to nearest, n + 1 down. Both ask
//   for k = (m · 2^doublings - 1) / 255 rounded down. So m · 2^doublings is 255k + r with r from 1 to 255, and 257
//   times as much is 65536k + 257r - k. Its high half is k while k is at most 257.
// - With a shift, rounded down: 0x8081 / 2^23 = (1 + 127 / 2^23) / 255 is close enough.
template <int kShift>
class Quotient {
 public:
  explicit HWY_INLINE Quotient(const Formula& f)
      : added_(set_unsigned(f.nearest ? 128 >> f.doublings : 1)),
        factor_(set_unsigned(kShift == 0 ? 257 << f.doublings : 0x8081)) {}
  HWY_INLINE VU16 operator()(VU16 n) const {
    if constexpr (kShift == 0) return hn::MulHigh(hn::SaturatedAdd(n, added_), factor_);
    return hn::ShiftRight<kShift>(hn::MulHigh(n, factor_));
  }

 private:
  VU16 added_, factor_;
};

// The term that is added to a quotient: nothing, the formula's offset, or the last source.
enum class Added { nothing, offset, source };

template <int kTerms, Reads kReads, int kShift, Added kAdded>
HWY_NOINLINE void unsigned_products(const Operations& operations, const Batch& batch) {
  const Formula& f = operations.first->formula;
  const Quotient<kShift> quotient(f);
  const VU16 high = set_unsigned(f.high);
  const VU16 offset = set_unsigned(f.offset);
  constexpr std::size_t kSources = 2 * kTerms + (kAdded == Added::source ? 1 : 0);
  for_lanes<kSources, kReads>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const auto product = [&](std::size_t k)
                             HWY_ATTR { return hn::Mul(x.get_unsigned(2 * k, lane), x.get_unsigned(2 * k + 1, lane)); };
    VU16 sum = product(0);
    if (kTerms > 1) sum = hn::SaturatedAdd(sum, product(1));
    if (kTerms > 2) sum = hn::SaturatedAdd(sum, product(2));
    VU16 code = quotient(sum);
    if constexpr (kAdded == Added::offset) code = hn::Add(code, offset);
    if constexpr (kAdded == Added::source) code = hn::Add(code, x.get_unsigned(2 * kTerms, lane));
    return hn::BitCast(kD16, hn::Min(code, high));
  });
}

// Narrows magnitudes, then restores the sign. 255 is odd: there are no ties, so both narrowings are symmetric.
enum class Signs { any, positive_first, positive_part };

template <Reads kReads, Signs kSigns, int kShift>
HWY_NOINLINE void signed_product(const Operations& operations, const Batch& batch) {
  const Formula& f = operations.first->formula;
  const Quotient<kShift> quotient(f);
  const VU16 farthest = set_unsigned(f.high);
  for_lanes<2, kReads>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    const V16 a = x.get(0, lane), b = x.get(1, lane);
    const VU16 first = hn::BitCast(kU16, kSigns == Signs::any ? hn::Abs(a) : a);
    const VU16 second = hn::BitCast(kU16, kSigns == Signs::positive_part ? hn::Max(b, set(0)) : hn::Abs(b));
    const VU16 code = hn::Min(quotient(hn::Mul(first, second)), farthest);
    if constexpr (kSigns == Signs::positive_part) return hn::BitCast(kD16, code);
    return kSigns == Signs::positive_first ? with_sign(code, b) : with_signs(code, a, b);
  });
}

// The sum fits into 16 bits, so it need not be taken apart.
template <int kTerms, Reads kReads, bool kPositivePart, int kShift>
HWY_NOINLINE void signed_sum(const Operations& operations, const Batch& batch) {
  const Formula& f = operations.first->formula;
  const Quotient<kShift> quotient(f);
  const V16 offset = set(f.offset);
  const VU16 farthest = set_unsigned(f.high);
  for_lanes<2 * kTerms, kReads>(operations, batch, [&](const auto& x, std::size_t lane) HWY_ATTR {
    V16 sum = hn::Add(hn::Mul(x.get(0, lane), x.get(1, lane)), offset);
    if (kTerms > 1) sum = hn::Add(sum, hn::Mul(x.get(2, lane), x.get(3, lane)));
    const VU16 n = hn::BitCast(kU16, kPositivePart ? hn::Max(sum, set(0)) : hn::Abs(sum));
    const VU16 code = hn::Min(quotient(n), farthest);
    return kPositivePart ? hn::BitCast(kD16, code) : with_sign(code, sum);
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
    const auto biased = [&](V32 n) HWY_ATTR {
      const VF32 v = hn::ConvertTo(kF32, n);
      return kBiased ? hn::Add(v, bias) : v;
    };
    return clamp(integers_of_products<kNearest>(biased(sum.first), biased(sum.second), reciprocal));
  });
}

using Run = void (*)(const Operations&, const Batch&);

template <class F>
HWY_INLINE Run choose(bool flag, const F& f) {
  return flag ? f(std::true_type()) : f(std::false_type());
}

// Calls f<kShift>() with the shift of a formula's quotient.
template <class F>
HWY_INLINE Run choose_shift(const Formula& formula, const F& f) {
  if (formula.nearest || formula.doublings == 0) return f.template operator()<0>();
  return formula.doublings == 1 ? f.template operator()<6>() : f.template operator()<5>();
}

HWY_INLINE Reads reads_of(const VectorOperation& operation) {
  Reads reads{.floors = operation.formula.floors};
  for (std::size_t k = 0; k < kMostSources; ++k) {
    const std::uint32_t bit = operation.lines & 1U << k;
    const int factor = operation.line[k].factor;
    (factor == -1 ? reads.differences : factor == 1 ? reads.sums : reads.lines) |= bit;
  }
  return reads;
}

// Processors without AVX2 are rare: there each kernel reads in the one way that serves every operation, as the others
// would double the time that this file takes to compile.
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_SSE4
constexpr bool kReadsInOneWay = true;
#else
constexpr bool kReadsInOneWay = false;
#endif

// Calls f<kReads>() with the first that covers what the operation needs; the last always does.
template <Reads kFirst, Reads... kMore, class F>
HWY_INLINE Run choose_reads(const Reads& needed, const F& f) {
  if constexpr (kReadsInOneWay) {
    return f.template operator()<Reads{.floors = ~0U, .lines = ~0U}>();
  } else {
    if constexpr (sizeof...(kMore) > 0) {
      if (!kFirst.covers(needed)) return choose_reads<kMore...>(needed, f);
    }
    return f.template operator()<kFirst>();
  }
}

// The planner puts lines first in a product, and products with more lines first. All lines of unsigned products are
// differences, and sums of three such products have none.
template <int kTerms, std::uint32_t kFloors, class F>
HWY_INLINE Run choose_unsigned_reads(const Reads& needed, const F& f) {
  constexpr auto difference = [](std::uint32_t mask) { return Reads{.floors = kFloors, .differences = mask}; };
  if constexpr (kTerms == 1) return choose_reads<difference(0), difference(0b01), difference(0b11)>(needed, f);
  if constexpr (kTerms == 2) {
    return choose_reads<difference(0), difference(0b0001), difference(0b0011), difference(0b0101), difference(0b0111),
                        difference(0b1111)>(needed, f);
  }
  return choose_reads<difference(0)>(needed, f);
}

// Sums of more than three products have no lines. Lines beside floors are rare.
template <int kTerms, class F>
HWY_INLINE Run choose_signed_reads(const Reads& needed, const F& f) {
  constexpr Reads kFloorsAndLines{.floors = ~0U, .lines = ~0U};
  if constexpr (kTerms == 1) {
    return choose_reads<kPlain, Reads{.differences = 0b01}, Reads{.sums = 0b01},
                        Reads{.differences = 0b01, .sums = 0b10}, Reads{.lines = 0b01}, Reads{.lines = 0b11},
                        kAllFloors, Reads{.floors = ~0U, .lines = 0b01}, kFloorsAndLines>(needed, f);
  }
  if constexpr (kTerms == 2) {
    return choose_reads<kPlain, Reads{.differences = 0b0001}, Reads{.differences = 0b0101}, Reads{.sums = 0b0001},
                        Reads{.differences = 0b0001, .sums = 0b0010}, Reads{.lines = 0b0001}, Reads{.lines = 0b0101},
                        Reads{.lines = 0b1111}, kAllFloors, Reads{.floors = ~0U, .lines = 0b0101}, kFloorsAndLines>(
        needed, f);
  }
  if constexpr (kTerms == 3) {
    return choose_reads<kPlain, Reads{.differences = 0b010101}, Reads{.lines = 0b111111}, kAllFloors, kFloorsAndLines>(
        needed, f);
  }
  return choose_reads<kPlain, kAllFloors>(needed, f);
}

// The first factor is not negative, and has its place.
template <class F>
HWY_INLINE Run choose_positive_first_reads(const Reads& needed, const F& f) {
  return choose_reads<kPlain, Reads{.differences = 0b01}, Reads{.differences = 0b10}, Reads{.sums = 0b10},
                      Reads{.differences = 0b01, .sums = 0b10}, Reads{.differences = 0b11}, Reads{.lines = 0b10},
                      Reads{.lines = 0b11}, kAllFloors, Reads{.floors = ~0U, .lines = 0b10},
                      Reads{.floors = ~0U, .lines = ~0U}>(needed, f);
}

// Sums of two products seldom fit into 16 bits.
template <class F>
HWY_INLINE Run choose_rare_reads(const Reads& needed, const F& f) {
  return choose_reads<kPlain, Reads{.differences = 0b0001}, Reads{.lines = 0b0101}, Reads{.lines = 0b1111}, kAllFloors,
                      Reads{.floors = ~0U, .lines = ~0U}>(needed, f);
}

template <int kTerms>
HWY_INLINE Run unsigned_products_of(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  const auto with = [&]<Reads kReads>() -> Run {
    // Only the final combiner adds, and it does not scale.
    if (f.adds) return unsigned_products<kTerms, kReads, 0, Added::source>;
    if (f.offset != 0) return unsigned_products<kTerms, kReads, 0, Added::offset>;
    return choose_shift(f,
                        [&]<int kShift>() -> Run { return unsigned_products<kTerms, kReads, kShift, Added::nothing>; });
  };
  const Reads needed = reads_of(operation);
  return needed.floors == 0 ? choose_unsigned_reads<kTerms, 0>(needed, with)
                            : choose_unsigned_reads<kTerms, ~0U>(needed, with);
}

HWY_INLINE Run signed_product_of(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  const Reads needed = reads_of(operation);
  const auto with = [&]<Signs kSigns, Reads kReads>() -> Run {
    return choose_shift(f, [&]<int kShift>() -> Run { return signed_product<kReads, kSigns, kShift>; });
  };
  if (!f.positive_first) {
    return choose_signed_reads<1>(needed,
                                  [&]<Reads kReads>() { return with.template operator()<Signs::any, kReads>(); });
  }
  return choose_positive_first_reads(needed, [&]<Reads kReads>() {
    return f.positive_part ? with.template operator()<Signs::positive_part, kReads>()
                           : with.template operator()<Signs::positive_first, kReads>();
  });
}

template <int kTerms>
HWY_INLINE Run signed_sum_of(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  const auto with = [&]<Reads kReads>() -> Run {
    return choose_shift(f, [&]<int kShift>() -> Run {
      return f.positive_part ? signed_sum<kTerms, kReads, true, kShift> : signed_sum<kTerms, kReads, false, kShift>;
    });
  };
  const Reads needed = reads_of(operation);
  if constexpr (kTerms == 1) return choose_signed_reads<1>(needed, with);
  return choose_rare_reads(needed, with);
}

template <int kTerms>
HWY_INLINE Run products_for(const VectorOperation& operation) {
  const Formula& f = operation.formula;
  return choose_signed_reads<kTerms>(reads_of(operation), [&]<Reads kReads>() {
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
