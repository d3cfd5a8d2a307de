#include "src/language/emit/emit_expression.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace ninebit::emit {
namespace {

V constant_of(std::int64_t value) {
  return {nullptr, 0, value};
}

V node_of(Opcode opcode, const V& a, const V& b, Interval range) {
  Graph* const graph = a.is_constant() ? b.graph : a.graph;
  return graph->make(opcode, {a, b, V{}, V{}}, range);
}

// The node of a value that may be simplified; nullptr for constants and for named values, which are used by name.
const Node* node_at(const V& v) {
  if (v.is_constant()) return nullptr;
  const Node& node = (*v.graph)[v.node];
  return node.named ? nullptr : &node;
}

// A value as a constant factor times a value; the factor is 1 if there is none.
struct Multiple {
  V of;
  std::int64_t factor = 1;
};

Multiple multiple_of(const V& v) {
  const Node* const node = node_at(v);
  if (node != nullptr && node->opcode == Opcode::mul && node->args[1].is_constant()) {
    return {node->args[0], node->args[1].constant};
  }
  return {v, 1};
}

// A value as a constant added to a value.
struct Offset {
  V of;
  std::int64_t plus = 0;
};

Offset offset_of(const V& v) {
  const Node* const node = node_at(v);
  if (node != nullptr && node->opcode == Opcode::add && node->args[1].is_constant()) {
    return {node->args[0], node->args[1].constant};
  }
  return {v, 0};
}

// A value as a constant minus a value.
struct Reflection {
  V of;
  std::int64_t from = 0;
};

std::optional<Reflection> reflection_of(const V& v) {
  const Node* const node = node_at(v);
  if (node == nullptr || node->opcode != Opcode::sub || !node->args[0].is_constant()) return std::nullopt;
  return Reflection{node->args[1], node->args[0].constant};
}

// A value as the smaller, or the larger, of a constant and a value.
struct Limit {
  V of;
  std::int64_t limit = 0;
};

std::optional<Limit> limit_of(Opcode opcode, const V& v) {
  const Node* const node = node_at(v);
  if (node == nullptr || node->opcode != opcode || !node->args[1].is_constant()) return std::nullopt;
  return Limit{node->args[0], node->args[1].constant};
}

V times(const V& v, std::int64_t factor) {
  return mul(v, constant_of(factor));
}

bool is_negation(const V& v) {
  const auto r = reflection_of(v);
  return r && r->from == 0;
}

std::int64_t floor_of_quotient(std::int64_t n, std::int64_t d) {
  return n / d - (n % d < 0 ? 1 : 0);
}

// Simplifies min_of and max_of of a multiple and a constant that its factor divides: the factor moves outward.
template <class Rule>
std::optional<V> inside_multiple(const V& a, const V& b, Rule rule) {
  if (!b.is_constant()) return std::nullopt;
  const Multiple m = multiple_of(a);
  if (m.factor <= 1 || b.constant % m.factor != 0) return std::nullopt;
  return times(rule(m.of, constant_of(b.constant / m.factor)), m.factor);
}

// In formulas, min_of or max_of of a sum or a quotient and a constant: the limit moves inside.
template <class Rule>
std::optional<V> inside_formula(const V& a, const V& b, Opcode limit, Rule rule) {
  const Node* const node = node_at(a);
  if (node == nullptr || !b.is_constant() || a.graph->purpose() != Graph::Purpose::formulas) return std::nullopt;
  if (const Offset o = offset_of(a); o.plus != 0) {
    return add(rule(o.of, constant_of(b.constant - o.plus)), constant_of(o.plus));
  }
  if (node->opcode != Opcode::divide || b.constant < 0) return std::nullopt;
  // The smallest dividend with that quotient, or the largest.
  const std::int64_t d = node->args[1].constant, dividend = b.constant * d + (limit == Opcode::min_of ? d - 1 : 0);
  return divide(rule(node->args[0], constant_of(dividend)), static_cast<int>(d));
}

}  // namespace

Interval V::range() const {
  return is_constant() ? Interval{constant, constant} : (*graph)[node].range;
}

bool V::is_vector() const {
  return !is_constant() && (*graph)[node].vector;
}

V Graph::input(std::string text, Interval range, bool vector) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].opcode == Opcode::input && nodes_[i].name == text) return {this, static_cast<int>(i), 0};
  }
  Node node;
  node.range = range;
  node.vector = vector;
  node.name = std::move(text);
  nodes_.push_back(std::move(node));
  return {this, static_cast<int>(nodes_.size()) - 1, 0};
}

V Graph::make(Opcode opcode, const std::array<V, 4>& args, Interval range) {
  if (range.low == range.high) return constant_of(range.low);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].opcode == opcode && nodes_[i].args == args) return {this, static_cast<int>(i), 0};
  }
  Node node;
  node.opcode = opcode;
  node.args = args;
  node.range = range;
  node.vector = opcode != Opcode::sum_of_components &&
                std::any_of(args.begin(), args.end(), [](const V& arg) { return arg.is_vector(); });
  nodes_.push_back(std::move(node));
  return {this, static_cast<int>(nodes_.size()) - 1, 0};
}

bool Graph::name(const V& value, const std::string& name) {
  if (value.is_constant()) return false;
  Node& node = value.graph->nodes_[static_cast<std::size_t>(value.node)];
  if (node.named || node.opcode == Opcode::input || value.graph->purpose_ == Purpose::formulas) return false;
  node.name = name;
  node.named = true;
  return true;
}

void Graph::rename(const V& value, const std::string& name) {
  value.graph->nodes_[static_cast<std::size_t>(value.node)].name = name;
}

V set(int v) {
  return constant_of(v);
}

V add(V a, V b) {
  if (a.is_constant() && b.is_constant()) return constant_of(a.constant + b.constant);
  if (a.is_constant()) std::swap(a, b);
  if (b == constant_of(0)) return a;
  if (const Offset o = offset_of(a); b.is_constant() && o.plus != 0) return add(o.of, constant_of(o.plus + b.constant));
  if (const auto r = reflection_of(a); b.is_constant() && r) return sub(constant_of(r->from + b.constant), r->of);
  if (is_negation(b)) return sub(a, node_at(b)->args[1]);
  if (is_negation(a)) return sub(b, node_at(a)->args[1]);
  if (a == b) return times(a, 2);
  const Multiple x = multiple_of(a), y = multiple_of(b);
  if (!b.is_constant() && x.factor == y.factor && x.factor != 1) return times(add(x.of, y.of), x.factor);
  if (!b.is_constant() && x.factor == -y.factor) {
    return x.factor > 0 ? times(sub(x.of, y.of), x.factor) : times(sub(y.of, x.of), y.factor);
  }
  return node_of(Opcode::add, a, b, a.range() + b.range());
}

V sub(V a, V b) {
  if (b.is_constant()) return add(a, constant_of(-b.constant));
  if (a == b) return constant_of(0);
  if (a.is_constant()) {
    if (const auto r = reflection_of(b)) return add(r->of, constant_of(a.constant - r->from));
    if (const Offset o = offset_of(b); o.plus != 0) return sub(constant_of(a.constant - o.plus), o.of);
  }
  if (is_negation(b)) return add(a, node_at(b)->args[1]);
  return node_of(Opcode::sub, a, b, a.range() - b.range());
}

V mul(V a, V b) {
  if (a.is_constant() && b.is_constant()) return constant_of(a.constant * b.constant);
  if (a.is_constant()) std::swap(a, b);
  if (b.is_constant()) {
    if (b.constant == 0) return b;
    if (b.constant == 1) return a;
    const Multiple m = multiple_of(a);
    if (m.factor != 1) return mul(m.of, constant_of(m.factor * b.constant));
    if (is_negation(a)) return times(node_at(a)->args[1], -b.constant);
  }
  return node_of(Opcode::mul, a, b, product(a.range(), b.range(), a == b));
}

V min_of(V a, V b) {
  const Interval p = a.range(), q = b.range();
  if (p.high <= q.low) return a;
  if (q.high <= p.low) return b;
  if (a.is_constant()) std::swap(a, b);
  if (const auto limit = limit_of(Opcode::min_of, a); b.is_constant() && limit) {
    return min_of(limit->of, constant_of(std::min(limit->limit, b.constant)));
  }
  if (const auto moved = inside_multiple(a, b, min_of)) return *moved;
  if (const auto moved = inside_formula(a, b, Opcode::min_of, min_of)) return *moved;
  return node_of(Opcode::min_of, a, b, {std::min(p.low, q.low), std::min(p.high, q.high)});
}

V max_of(V a, V b) {
  const Interval p = a.range(), q = b.range();
  if (p.low >= q.high) return a;
  if (q.low >= p.high) return b;
  if (a.is_constant()) std::swap(a, b);
  if (const auto limit = limit_of(Opcode::max_of, a); b.is_constant() && limit) {
    return max_of(limit->of, constant_of(std::max(limit->limit, b.constant)));
  }
  // The lower limit moves inside the upper one, so that equal limits meet.
  if (const auto limit = limit_of(Opcode::min_of, a); b.is_constant() && limit && b.constant <= limit->limit) {
    return min_of(max_of(limit->of, b), constant_of(limit->limit));
  }
  if (const auto moved = inside_multiple(a, b, max_of)) return *moved;
  if (const auto moved = inside_formula(a, b, Opcode::max_of, max_of)) return *moved;
  return node_of(Opcode::max_of, a, b, {std::max(p.low, q.low), std::max(p.high, q.high)});
}

V abs_of(V a) {
  const Interval p = a.range();
  if (p.low >= 0) return a;
  if (p.high <= 0) return sub(set(0), a);
  const Multiple m = multiple_of(a);
  if (m.factor != 1) return times(abs_of(m.of), std::abs(m.factor));
  return node_of(Opcode::abs_of, a, constant_of(0), {0, std::max(-p.low, p.high)});
}

V divide(V n, int d) {
  const Interval p = n.range();
  if (n.is_constant() && n.constant >= 0) return constant_of(n.constant / d);
  if (p.low < 0) {
    if (!n.is_constant()) n.graph->refuse_division();
    return n;
  }
  // (of * f + plus) / d, rounded down: a factor common to f and d cancels, and whole multiples of d in plus come out.
  const Offset o = offset_of(n);
  const Multiple m = multiple_of(o.of);
  if (const std::int64_t common = std::gcd(m.factor, std::int64_t{d}); common > 1) {
    const V reduced = add(times(m.of, m.factor / common), constant_of(floor_of_quotient(o.plus, common)));
    return divide(reduced, static_cast<int>(d / common));
  }
  if (d == 1) return n;
  const std::int64_t whole = floor_of_quotient(o.plus, d);
  if (whole > 0 && o.of.range().low + (o.plus - whole * d) >= 0) {
    return add(divide(add(o.of, constant_of(o.plus - whole * d)), d), constant_of(whole));
  }
  return node_of(Opcode::divide, n, constant_of(d), {p.low / d, p.high / d});
}

V negate_where_negative(V sign, V x) {
  const Interval s = sign.range(), p = x.range();
  if (s.low >= 0) return x;
  if (s.high < 0) return sub(set(0), x);
  // A positive multiple has the sign of the value itself, and the magnitude of a value with that value's sign is the
  // value.
  const Multiple m = multiple_of(sign), magnitude = multiple_of(x);
  if (m.factor > 1) return negate_where_negative(m.of, x);
  const Node* const node = node_at(magnitude.of);
  if (node != nullptr && node->opcode == Opcode::abs_of && node->args[0] == sign) {
    return times(sign, magnitude.factor);
  }
  return node_of(Opcode::negate_where_negative, sign, x, either(p, -p));
}

V sum_of_components(V a) {
  if (!a.is_vector()) return times(a, 3);
  const Interval p = a.range();
  return node_of(Opcode::sum_of_components, a, constant_of(0), {3 * p.low, 3 * p.high});
}

V select_where_at_least(V v, V limit, V yes, V no) {
  if (v.range().low >= limit.range().high || yes == no) return yes;
  if (v.range().high < limit.range().low) return no;
  Graph* const graph = v.is_constant() ? limit.graph : v.graph;
  return graph->make(Opcode::select_where_at_least, {v, limit, yes, no}, either(yes.range(), no.range()));
}

}  // namespace ninebit::emit
