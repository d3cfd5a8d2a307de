// Intervals of whole numbers: the rules by which the range of a sum, a product or a choice follows from those of its
// values. Three analyses share them. They stay apart because each walks through something else: the compiler of batches
// through linear forms that fit lanes of 16 bits (value_graph.h), the emitters through the rules' own operations
// (language/emit/emit_expression.h), and explain through terms of text (language/explain/explain_terms.h).
#pragma once

#include <algorithm>

namespace ninebit {

template <class Number>
struct IntervalOf {
  Number low = 0, high = 0;  // inclusive
  friend constexpr bool operator==(const IntervalOf&, const IntervalOf&) = default;
};

template <class Number>
[[nodiscard]] constexpr IntervalOf<Number> operator+(const IntervalOf<Number>& a, const IntervalOf<Number>& b) {
  return {a.low + b.low, a.high + b.high};
}

template <class Number>
[[nodiscard]] constexpr IntervalOf<Number> operator-(const IntervalOf<Number>& a) {
  return {-a.high, -a.low};
}

template <class Number>
[[nodiscard]] constexpr IntervalOf<Number> operator-(const IntervalOf<Number>& a, const IntervalOf<Number>& b) {
  return a + -b;
}

// `same`: both factors are the same value, whose square is not negative.
template <class Number>
[[nodiscard]] constexpr IntervalOf<Number> product(const IntervalOf<Number>& a, const IntervalOf<Number>& b,
                                                   bool same) {
  const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {same ? std::max(low, Number{0}) : low, high};
}

// The smallest interval that holds both.
template <class Number>
[[nodiscard]] constexpr IntervalOf<Number> either(const IntervalOf<Number>& a, const IntervalOf<Number>& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

template <class Number>
[[nodiscard]] constexpr IntervalOf<Number> clamped(const IntervalOf<Number>& a, Number low, Number high) {
  return {std::clamp(a.low, low, high), std::clamp(a.high, low, high)};
}

}  // namespace ninebit
