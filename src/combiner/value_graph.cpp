#include "src/combiner/value_graph.h"

#include <algorithm>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::detail {

Value ValueGraph::find_or_add(const Node& node, const Range& range) {
  const auto [at, is_new] = numbers_.try_emplace(node, static_cast<Value>(nodes_.size()));
  if (is_new) {
    nodes_.push_back(node);
    ranges_.push_back(range);
  }
  return at->second;
}

Value ValueGraph::constant(int code) {
  return find_or_add({.source = Source::constant, .number = code, .formula = {}, .of = {}}, {code, code});
}

Value ValueGraph::input(Register reg, int component) {
  const int number = 4 * static_cast<int>(reg) + component;
  return find_or_add({.source = Source::input, .number = number, .formula = {}, .of = {}},
                     {lowest_input_, datapath_.one});
}

Value ValueGraph::add(Formula formula, std::span<const Operand> of, const Range& range) {
  if (range.low == range.high) return constant(range.low);
  Node node{.source = Source::operation, .number = 0, .formula = formula, .of = {}};
  for (std::size_t k = 0; k < of.size(); ++k) {
    node.of[k] = of[k].value;
    // The floor of a value that cannot be negative is dropped, so that equal operations compare equal.
    if (of[k].floored && ranges_[of[k].value].low < 0) node.formula.floors |= 1U << k;
  }
  return find_or_add(node, range);
}

Range ValueGraph::range(const Operand& operand) const {
  const Range& r = ranges_[operand.value];
  return operand.floored ? Range{std::max(r.low, 0), std::max(r.high, 0)} : r;
}

Range ValueGraph::range(const Linear& linear) const {
  if (linear.is_constant()) return {linear.offset, linear.offset};
  const Range r = range(Operand{linear.value, linear.floored});
  const int x = linear.factor * r.low + linear.offset, y = linear.factor * r.high + linear.offset;
  return {std::min(x, y), std::max(x, y)};
}

Value ValueGraph::affine(std::span<const Linear> terms, Scale scale, Narrowing narrowing, int low, int high) {
  const int doublings = scale == Scale::by_two ? 1 : scale == Scale::by_four ? 2 : 0;
  Formula f{.kernel = Kernel::affine, .terms = 0};
  std::vector<Linear> kept;
  for (Linear term : terms) {
    f.offset += term.offset << doublings;
    if (term.is_constant()) continue;
    term.offset = 0;
    term.factor <<= doublings;
    term.floored = term.floored && range(term.value).low < 0;
    const auto like = std::find_if(kept.begin(), kept.end(), [&](const Linear& other) {
      return other.value == term.value && other.floored == term.floored;
    });
    if (like == kept.end()) {
      kept.push_back(term);
    } else if (like->factor += term.factor; like->factor == 0) {
      kept.erase(like);
    }
  }
  std::sort(kept.begin(), kept.end(), [](const Linear& a, const Linear& b) { return a.value < b.value; });
  Range sum{f.offset, f.offset};
  std::vector<Operand> of;
  for (const Linear& term : kept) {
    const Range r = range(term);
    sum = sum + r;
    f.factor[of.size()] = term.factor;
    of.push_back({term.value, term.floored});
  }
  f.terms = static_cast<int>(of.size());
  f.halves = scale == Scale::by_one_half;
  if (f.halves) {
    f.nearest = narrowing == Narrowing::nearest_halves_up;
    const int most = std::max(std::abs(sum.low), std::abs(sum.high)) + 1;
    sum = {reference::narrow(narrowing, sum.low, 2, most), reference::narrow(narrowing, sum.high, 2, most)};
  }
  if (sum.low < low || sum.high > high) {
    f.low = low;
    f.high = high;
  }
  const Range result = clamped(sum, low, high);
  if (result.low == result.high) return constant(result.low);
  const bool is_itself = f.terms == 1 && f.factor[0] == 1 && f.offset == 0 && !of[0].floored && !f.halves;
  if (is_itself && !f.clamps()) return of[0].value;
  return add(f, of, result);
}

Operand ValueGraph::operand(const Linear& linear) {
  if (linear.factor == 1 && linear.offset == 0) return {linear.value, linear.floored && range(linear.value).low < 0};
  const Range r = range(linear);
  return {affine({&linear, 1}, Scale::none, Narrowing::toward_zero, r.low, r.high), false};
}

Value ValueGraph::chosen(const Operand& operand) {
  const Range r = range(operand);
  const Linear linear{operand.value, operand.floored, 1, 0};
  return affine({&linear, 1}, Scale::none, Narrowing::toward_zero, r.low, r.high);
}

Value ValueGraph::select(Value by, const Operand& no, const Operand& yes) {
  const bool is_no = no == yes || range(by).high < datapath_.half, is_yes = range(by).low >= datapath_.half;
  if (is_no || is_yes) return chosen(is_no ? no : yes);
  return add({.kernel = Kernel::select, .low = datapath_.half}, std::array{Operand{by}, no, yes},
             either(range(no), range(yes)));
}

Value ValueGraph::select_odd(Value by, const Operand& no, const Operand& yes) {
  const Range bits = range(Operand{by, true});
  if (no == yes || bits.low == bits.high) return chosen(no == yes || bits.low % 2 == 0 ? no : yes);
  return add({.kernel = Kernel::select_odd}, std::array{Operand{by, true}, no, yes}, either(range(no), range(yes)));
}

}  // namespace ninebit::detail
