#include "src/combiner/wide_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::detail {
namespace {

// The largest dividend that 16-bit lanes divide exactly; the quotients of larger ones come out as 256 at least.
constexpr int kMostNarrowed = 65407;

// A product of two operands of the graph.
struct Factors {
  Operand x, y;
  Range range;
  friend bool operator<(const Factors& a, const Factors& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); }
};

Linear negative(const Linear& linear) {
  return {linear.value, linear.floored, -linear.factor, -linear.offset};
}

// Two factors of which one is never positive change their signs: other kernels multiply by what is not negative.
std::vector<Factors> factors_of(ValueGraph& graph, const WideSum& sum) {
  std::vector<Factors> all;
  for (WideSum::Product p : sum.products()) {
    if (graph.range(p.x).high <= 0 || graph.range(p.y).high <= 0) p = {negative(p.x), negative(p.y)};
    Factors f{graph.operand(p.x), graph.operand(p.y), {}};
    if (f.y < f.x) std::swap(f.x, f.y);
    f.range = product(graph.range(f.x), graph.range(f.y), f.x == f.y);
    all.push_back(f);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Returns the code of one wide value, not limited to a range.
int code_of(const Datapath& d, const Narrowed& how, int wide) {
  const int scaled = reference::scale_output(how.scale, wide), unit = 2 * d.one;
  return reference::narrow(how.narrowing, scaled, unit, std::abs(scaled) / unit + 1);
}

Range clamped(const Range& r, const Narrowed& how) {
  return ninebit::clamped(r, how.low, how.high);
}

int doublings_of(Scale scale) {
  return scale == Scale::by_two ? 1 : scale == Scale::by_four ? 2 : 0;
}

std::vector<Operand> operands_of(const std::vector<Factors>& factors) {
  std::vector<Operand> operands;
  for (const Factors& f : factors) {
    operands.push_back(f.x);
    operands.push_back(f.y);
  }
  return operands;
}

// Returns a sum that needs no products, plus `added`, as an affine value; empty if it has more than two terms.
std::optional<Value> as_affine(ValueGraph& graph, const WideSum& sum, const Narrowed& how) {
  const int one = graph.datapath().one;
  const bool adds = !how.added.is_constant();
  if (!is_affine(graph, sum) || sum.constant() % one != 0 || sum.products().size() + (adds ? 1 : 0) > 2) return {};
  std::vector<Linear> terms;
  for (const WideSum::Product& p : sum.products()) {
    const int sign = p.y.offset / one;
    terms.push_back({p.x.value, p.x.floored, sign * p.x.factor, sign * p.x.offset});
  }
  terms.push_back({0, false, 0, sum.constant() / one});
  terms.push_back(how.added);
  return graph.affine(terms, how.scale, how.narrowing, how.low, how.high);
}

// 16 bits suffice for products that are not negative; batch_kernels.cpp proves that the bits are the same.
std::optional<Value> as_unsigned(ValueGraph& graph, const WideSum& sum, const std::vector<Factors>& factors,
                                 const Narrowed& how, const Range& quotient) {
  int most = 0;
  for (const Factors& f : factors) {
    if (f.range.low < 0 || f.range.high > 65535) return {};
    most += f.range.high << doublings_of(how.scale);
  }
  const bool is_exact = most <= kMostNarrowed;
  if (graph.datapath().one != 255 || sum.constant() != 0 || how.scale == Scale::by_one_half || factors.size() > 3 ||
      (!is_exact && how.high > 256)) {
    return {};
  }
  const Range added = graph.range(how.added);
  if (added.low < 0) return {};
  Formula f{.kernel = Kernel::unsigned_products,
            .terms = static_cast<int>(factors.size()),
            .nearest = how.narrowing == Narrowing::nearest_halves_up,
            .doublings = doublings_of(how.scale)};
  std::vector<Operand> of = operands_of(factors);
  if (how.added.is_constant()) {
    f.offset = how.added.offset;
  } else if (added.high > 0) {
    f.adds = true;
    of.push_back(graph.operand(how.added));
  }
  const Range raw = quotient + added;
  if (!is_exact || raw.high > how.high) {
    f.low = 0;
    f.high = how.high;
  }
  return graph.add(f, of, clamped(raw, how));
}

std::optional<Value> as_signed_product(ValueGraph& graph, const WideSum& sum, const std::vector<Factors>& factors,
                                       const Narrowed& how, const Range& quotient) {
  if (graph.datapath().one != 255 || sum.constant() != 0 || how.scale == Scale::by_one_half || factors.size() != 1 ||
      !how.added.is_constant() || how.added.offset != 0) {
    return {};
  }
  const Range& r = factors[0].range;
  const int most = std::max(-r.low, r.high);
  if (most > 65535 || ((most << doublings_of(how.scale)) > kMostNarrowed && how.high > 256)) return {};
  Formula f{.kernel = Kernel::signed_product,
            .nearest = how.narrowing == Narrowing::nearest_halves_up,
            .doublings = doublings_of(how.scale)};
  if (quotient.low < how.low || quotient.high > how.high) {
    if (how.low != -how.high) return {};
    f.low = how.low;
    f.high = how.high;
  }
  std::vector<Operand> of = operands_of(factors);
  if (graph.range(of[0]).low < 0) std::swap(of[0], of[1]);
  f.positive_first = graph.range(of[0]).low >= 0;
  return graph.add(f, of, clamped(quotient, how));
}

// Partial sums may overflow: only the whole sum must fit.
std::optional<Value> as_signed_sum(ValueGraph& graph, const WideSum& sum, const std::vector<Factors>& factors,
                                   const Narrowed& how, const Range& wide, const Range& quotient) {
  const int most = std::max(-wide.low, wide.high);
  if (graph.datapath().one != 255 || how.scale == Scale::by_one_half || factors.size() > 2 || most > kMost16 ||
      how.added != Linear{} || ((most << doublings_of(how.scale)) > kMostNarrowed && how.high > 256)) {
    return {};
  }
  Formula f{.kernel = Kernel::signed_sum,
            .terms = static_cast<int>(factors.size()),
            .nearest = how.narrowing == Narrowing::nearest_halves_up,
            .doublings = doublings_of(how.scale),
            .offset = sum.constant()};
  if (quotient.low < how.low || quotient.high > how.high) {
    if (how.low != -how.high) return {};
    f.low = how.low;
    f.high = how.high;
  }
  return graph.add(f, operands_of(factors), clamped(quotient, how));
}

// Returns 1 / divisor as a float that is not below it.
float reciprocal_above(int divisor) {
  const float nearest = 1.0F / static_cast<float>(divisor);
  return static_cast<double>(nearest) * divisor < 1.0 ? std::nextafter(nearest, 1.0F) : nearest;
}

Value as_products(ValueGraph& graph, const WideSum& sum, const std::vector<Factors>& factors, const Narrowed& how,
                  const Range& quotient) {
  const bool nearest = how.narrowing == Narrowing::nearest_halves_up;
  const bool halves = how.scale == Scale::by_one_half;
  Formula f{.kernel = Kernel::products, .terms = static_cast<int>(factors.size()), .nearest = nearest};
  // `one` is odd, so ties occur only with the scale of one half. Adding one half more rounds them up.
  f.bias = static_cast<float>(sum.constant()) + (nearest && halves ? 0.5F : 0.0F);
  f.reciprocal =
      reciprocal_above(graph.datapath().one) * (halves ? 0.5F : static_cast<float>(1 << doublings_of(how.scale)));
  if (how.added == Linear{}) {
    if (quotient.low < how.low || quotient.high > how.high) {
      f.low = how.low;
      f.high = how.high;
    }
    return graph.add(f, operands_of(factors), clamped(quotient, how));
  }
  const Value whole = graph.add(f, operands_of(factors), quotient);
  const std::array<Linear, 2> terms{Linear{whole, false, 1, 0}, how.added};
  return graph.affine(terms, Scale::none, how.narrowing, how.low, how.high);
}

}  // namespace

void WideSum::add(const Linear& x, const Linear& y) {
  if (x.is_constant() && y.is_constant()) {
    constant_ += x.offset * y.offset;
  } else if (x.is_constant()) {
    add(y, x);
  } else if (!(y.is_constant() && y.offset == 0)) {
    products_.push_back({x, y});
  }
}

void WideSum::add(const WideSum& other) {
  constant_ += other.constant_;
  products_.insert(products_.end(), other.products_.begin(), other.products_.end());
}

bool is_affine(const ValueGraph& graph, const WideSum& sum) {
  return sum.products().size() <= 2 &&
         std::all_of(sum.products().begin(), sum.products().end(), [&](const WideSum::Product& p) {
           return p.y.is_constant() && std::abs(p.y.offset) == graph.datapath().one;
         });
}

Value narrow(ValueGraph& graph, const WideSum& sum, const Narrowed& how) {
  const Datapath& d = graph.datapath();
  if (sum.products().empty()) {
    const std::array<Linear, 2> terms{Linear{0, false, 0, code_of(d, how, sum.constant())}, how.added};
    return graph.affine(terms, Scale::none, how.narrowing, how.low, how.high);
  }
  if (const auto value = as_affine(graph, sum, how)) return *value;
  const std::vector<Factors> factors = factors_of(graph, sum);
  Range wide{sum.constant(), sum.constant()};
  for (const Factors& f : factors) wide = wide + f.range;
  const Range quotient{code_of(d, how, wide.low), code_of(d, how, wide.high)};
  if (const auto value = as_unsigned(graph, sum, factors, how, quotient)) return *value;
  if (const auto value = as_signed_product(graph, sum, factors, how, quotient)) return *value;
  if (const auto value = as_signed_sum(graph, sum, factors, how, wide, quotient)) return *value;
  return as_products(graph, sum, factors, how, quotient);
}

Value combiner_output(ValueGraph& graph, WideSum sum, Scale scale, Bias bias) {
  const Datapath& d = graph.datapath();
  sum.add(reference::add_bias(d, bias, 0));
  const Narrowed whole{.narrowing = d.general_narrowing, .low = d.lowest_output, .high = d.one};
  Narrowed scaled = whole;
  scaled.scale = scale;
  if (d.narrowing_point == NarrowingPoint::after_scale || scale == Scale::none) return narrow(graph, sum, scaled);
  // A value that is doubled may also be clamped before that; one that is halved may not.
  Narrowed first = whole;
  if (scale == Scale::by_one_half) {
    first.low = -kMost16;
    first.high = kMost16;
  }
  const Linear code{narrow(graph, sum, first), false, 1, 0};
  return graph.affine({&code, 1}, scale, d.general_narrowing, d.lowest_output, d.one);
}

}  // namespace ninebit::detail
