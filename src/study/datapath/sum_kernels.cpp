// The rules of arithmetic.inl on vectors of 32-bit lanes, with exact arithmetic for comparison.
#include "src/study/datapath/sum_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "src/numerics/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/study/datapath/sum_kernels.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/combiner/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// 1 / d as a float, rounded up.
constexpr std::array<float, 511> reciprocals() {
  std::array<float, 511> out{};
  for (int d = 1; d <= 510; ++d) {
    float r = 1.0F / static_cast<float>(d);
    if (static_cast<double>(r) * d < 1.0) r = std::bit_cast<float>(std::bit_cast<std::uint32_t>(r) + 1);
    out[static_cast<std::size_t>(d)] = r;
  }
  return out;
}
constexpr std::array<float, 511> kReciprocals = reciprocals();

// The primitives that arithmetic.inl requires.
namespace lanes {
using V = V32;
HWY_INLINE V set(int v) {
  return hn::Set(kD32, v);
}
HWY_INLINE V add(V a, V b) {
  return hn::Add(a, b);
}
HWY_INLINE V sub(V a, V b) {
  return hn::Sub(a, b);
}
HWY_INLINE V mul(V a, V b) {
  return hn::Mul(a, b);
}
HWY_INLINE V min_of(V a, V b) {
  return hn::Min(a, b);
}
HWY_INLINE V max_of(V a, V b) {
  return hn::Max(a, b);
}
HWY_INLINE V abs_of(V a) {
  return hn::Abs(a);
}
// Exact floor of n / d. A float holds n < 2^24 exactly. The reciprocal is too large by at most 2^-23 of itself, and the
// product is rounded by at most 2^-24 of itself; so with n / d < 2^13 the quotient is too large by less than 0.0015.
// The next whole number is at least 1 / 510 > 0.0019 above n / d. Rounding does not take the quotient below a whole
// number that n / d reaches.
HWY_INLINE V divide(V n, int d) {
  const VF32 reciprocal = hn::Set(kF32, kReciprocals[static_cast<std::size_t>(d)]);
  return to_integers(hn::Mul(hn::ConvertTo(kF32, n), reciprocal), false);
}
HWY_INLINE V negate_where_negative(V sign, V x) {
  const V all = hn::BroadcastSignBit(sign);
  return hn::Sub(hn::Xor(x, all), all);
}
HWY_INLINE V select_where_at_least(V v, V limit, V yes, V no) {
  return hn::IfThenElse(hn::Lt(v, limit), no, yes);
}
#define NINEBIT_RULE HWY_INLINE
#include "ninebit/combiner/arithmetic.inl"
#undef NINEBIT_RULE
}  // namespace lanes

HWY_INLINE std::int64_t sum_of_lanes(V32 v) {
  return hn::GetLane(hn::SumOfLanes(kD32, v));
}

// Evaluates every C, with D in lanes. Scale and narrowing are template arguments; the other choices are read once.
template <Scale kScale, Narrowing kNarrowing, NarrowingPoint kPoint>
HWY_NOINLINE SumTotals totals(const Datapath& given, Bias bias, int a, int b) {
  Datapath d = given;
  d.general_narrowing = kNarrowing;
  d.narrowing_point = kPoint;
  constexpr int kDoublings = kScale == Scale::by_one_half ? 0
                             : kScale == Scale::none      ? 1
                             : kScale == Scale::by_two    ? 2
                                                          : 3;
  const int one = d.one, square = one * one;
  const V32 ab = lanes::mul(lanes::set(a), lanes::set(b)), unit = lanes::set(4 * one), yes = lanes::set(1);
  const V32 half = lanes::set(bias == Bias::none ? 0 : square);  // in units of 1 / (2 one²)
  const V32 lowest = lanes::set(-4 * square), highest = lanes::set(4 * square);
  V32 most = lanes::set(0), inexact = most, sizes = most, errors = most, codes = most, squares = most;

  // `some` keeps the lanes that are cases.
  const auto visit = [&](V32 product, const auto& some) HWY_ATTR {
    const V32 wide = hn::Add(ab, product);
    const V32 code = some(lanes::combiner_output(d, kScale, bias, wide));
    // (wide - half) · scale in units of 1 / (4 one²), clamped to a register's range [-1, 1].
    const V32 scaled = hn::ShiftLeft<kDoublings>(hn::Sub(hn::Add(wide, wide), half));
    const V32 exact = some(hn::Min(hn::Max(scaled, lowest), highest));
    const V32 error = hn::Sub(hn::Mul(code, unit), exact);
    const V32 size = hn::Abs(error);
    most = hn::Max(most, size);
    inexact = hn::Add(inexact, hn::Min(size, yes));
    sizes = hn::Add(sizes, size);
    errors = hn::Add(errors, error);
    codes = hn::Add(codes, code);
    squares = hn::Add(squares, hn::Mul(code, code));
  };

  const int n = 2 * one + 1, count = static_cast<int>(hn::Lanes(kD32)), rest = n % count;
  const auto tail = hn::FirstN(kD32, static_cast<std::size_t>(rest));
  const V32 step = lanes::set(count);
  SumTotals out;
  for (int c = -one; c <= one; ++c) {
    const V32 factor = lanes::set(c);
    V32 ds = hn::Iota(kD32, -one);
    inexact = sizes = errors = codes = squares = lanes::set(0);
    for (int i = 0; i < n / count; ++i) {
      visit(hn::Mul(factor, ds), [](V32 v) HWY_ATTR { return v; });
      ds = hn::Add(ds, step);
    }
    if (rest != 0) visit(hn::Mul(factor, ds), [&](V32 v) HWY_ATTR { return hn::IfThenElseZero(tail, v); });
    // No error exceeds 9 one² and a row has at most 511 of them: all sums fit into 32 bits.
    out.inexact += static_cast<std::uint64_t>(sum_of_lanes(inexact));
    out.sum_of_sizes += sum_of_lanes(sizes);
    out.sum_of_errors += sum_of_lanes(errors);
    out.sum_of_codes += sum_of_lanes(codes);
    out.sum_of_squares += sum_of_lanes(squares);
  }
  out.cases = static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(n);
  out.max_error = hn::GetLane(hn::MaxOfLanes(kD32, most));
  return out;
}

using Run = SumTotals (*)(const Datapath&, Bias, int, int);

template <Scale kScale>
HWY_INLINE Run run_of(const Datapath& d) {
  constexpr Narrowing kZero = Narrowing::toward_zero, kNearest = Narrowing::nearest_halves_up;
  constexpr NarrowingPoint kEarly = NarrowingPoint::before_scale, kLate = NarrowingPoint::after_scale;
  if (d.narrowing_point == kEarly) {
    return d.general_narrowing == kZero ? totals<kScale, kZero, kEarly> : totals<kScale, kNearest, kEarly>;
  }
  return d.general_narrowing == kZero ? totals<kScale, kZero, kLate> : totals<kScale, kNearest, kLate>;
}

SumTotals run_totals(const Datapath& d, const OutputForm& form, int a, int b) {
  const Run run = form.scale == Scale::none      ? run_of<Scale::none>(d)
                  : form.scale == Scale::by_two  ? run_of<Scale::by_two>(d)
                  : form.scale == Scale::by_four ? run_of<Scale::by_four>(d)
                                                 : run_of<Scale::by_one_half>(d);
  return run(d, form.bias, a, b);
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {
namespace detail {
HWY_EXPORT(run_totals);

SumTotals dispatched_totals(const Datapath& d, const OutputForm& form, int a, int b) {
  return HWY_DYNAMIC_DISPATCH(run_totals)(d, form, a, b);
}
}  // namespace detail

SumTotals sum_totals(const Datapath& datapath, const OutputForm& form, int a, int b) {
  return detail::dispatched_totals(datapath, form, a, b);
}

void SumTotals::add(const SumTotals& other) {
  cases += other.cases;
  inexact += other.inexact;
  max_error = std::max(max_error, other.max_error);
  sum_of_sizes += other.sum_of_sizes;
  sum_of_errors += other.sum_of_errors;
  sum_of_codes += other.sum_of_codes;
  sum_of_squares += other.sum_of_squares;
}

}  // namespace ninebit
#endif
