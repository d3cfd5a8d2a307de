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
                     {datapath_.lowest, datapath_.one});
}

Value ValueGraph::add(const Formula& formula, std::span<const Value> of, const Range& range) {
  if (range.low == range.high) return constant(range.low);
  Node node{.source = Source::operation, .number = 0, .formula = formula, .of = {}};
  std::copy(of.begin(), of.end(), node.of.begin());
  return find_or_add(node, range);
}

Range ValueGraph::range(const Linear& linear) const {
  if (linear.is_constant()) return {linear.offset, linear.offset};
  Range r = range(linear.value);
  if (linear.floored) r = {std::max(r.low, 0), std::max(r.high, 0)};
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
    const auto like =
        std::find_if(kept.begin(), kept.end(), [&](const Linear& other) {
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
  std::vector<Value> of;
  for (const Linear& term : kept) {
    const Range r = range(term);
    sum = {sum.low + r.low, sum.high + r.high};
    f.floored[of.size()] = term.floored;
    f.factor[of.size()] = term.factor;
    of.push_back(term.value);
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
  const Range result{std::clamp(sum.low, low, high), std::clamp(sum.high, low, high)};
  const bool is_itself = f.terms == 1 && f.factor[0] == 1 && f.offset == 0 && !f.floored[0] && !f.halves;
  if (is_itself && f.low == f.high) return of[0];
  return add(f, of, result);
}

Value ValueGraph::materialize(const Linear& linear) {
  const Range r = range(linear);
  return affine({&linear, 1}, Scale::none, Narrowing::toward_zero, r.low, r.high);
}

Value ValueGraph::select(Value by, Value no, Value yes) {
  if (no == yes || range(by).high < datapath_.half) return no;
  if (range(by).low >= datapath_.half) return yes;
  const Range a = range(no), b = range(yes);
  return add({.kernel = Kernel::select, .low = datapath_.half}, std::array{by, no, yes},
             {std::min(a.low, b.low), std::max(a.high, b.high)});
}

}  // namespace ninebit::detail
