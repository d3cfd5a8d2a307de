// The primitives that build text simplify as they go: every simplification keeps the value, and no value leaves its
// interval. Random expressions over all values of two small inputs.
#include "src/language/emit/emit_expression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

using emit::Graph;
using emit::Node;
using emit::Opcode;
using emit::V;
using Numbers = std::vector<std::int64_t>;

constexpr emit::Interval kX{-9, 8}, kY{2, 13};

// A value, and what it must be for each pair of x and y.
struct Sample {
  V value;
  Numbers expected;
};

std::int64_t computed(const Graph& graph, const V& v, std::int64_t x, std::int64_t y) {
  if (v.is_constant()) return v.constant;
  const Node& node = graph[v.node];
  if (node.opcode == Opcode::input) return node.name == "x" ? x : y;
  std::array<std::int64_t, 4> a{};
  for (std::size_t i = 0; i < 4; ++i) a[i] = computed(graph, node.args[i], x, y);
  switch (node.opcode) {
    case Opcode::input:
    case Opcode::sum_of_components:  // of vectors, which these expressions do not have
      break;
    case Opcode::add:
      return a[0] + a[1];
    case Opcode::sub:
      return a[0] - a[1];
    case Opcode::mul:
      return a[0] * a[1];
    case Opcode::min_of:
      return std::min(a[0], a[1]);
    case Opcode::max_of:
      return std::max(a[0], a[1]);
    case Opcode::abs_of:
      return a[0] < 0 ? -a[0] : a[0];
    case Opcode::divide:
      EXPECT_GE(a[0], 0);
      return a[0] / a[1];
    case Opcode::negate_where_negative:
      return a[0] < 0 ? -a[1] : a[1];
    case Opcode::select_where_at_least:
      return a[0] >= a[1] ? a[2] : a[3];
  }
  return 0;
}

Numbers combined(const Sample& a, const Sample& b, std::int64_t (*of)(std::int64_t, std::int64_t)) {
  Numbers result;
  for (std::size_t i = 0; i < a.expected.size(); ++i) result.push_back(of(a.expected[i], b.expected[i]));
  return result;
}

Sample constant(Random& random) {
  const int value = random.below(41) - 20;
  return {emit::set(value), Numbers(static_cast<std::size_t>((kX.high - kX.low + 1) * (kY.high - kY.low + 1)), value)};
}

Sample next_of(Random& random, const Sample& a, const Sample& b, const Sample& c) {
  using I = std::int64_t;
  const int divisor = 1 + random.below(12);
  switch (random.below(10)) {
    case 0:
      return {emit::add(a.value, b.value), combined(a, b, [](I p, I q) { return p + q; })};
    case 1:
      return {emit::sub(a.value, b.value), combined(a, b, [](I p, I q) { return p - q; })};
    case 2:
      return {emit::mul(a.value, b.value), combined(a, b, [](I p, I q) { return p * q; })};
    case 3:
      return {emit::min_of(a.value, b.value), combined(a, b, [](I p, I q) { return std::min(p, q); })};
    case 4:
      return {emit::max_of(a.value, b.value), combined(a, b, [](I p, I q) { return std::max(p, q); })};
    case 5:
      return {emit::abs_of(a.value), combined(a, a, [](I p, I) { return p < 0 ? -p : p; })};
    case 6:
      return {emit::negate_where_negative(a.value, b.value), combined(a, b, [](I p, I q) { return p < 0 ? -q : q; })};
    case 7: {
      Sample result{emit::select_where_at_least(a.value, b.value, c.value, a.value), {}};
      for (std::size_t i = 0; i < a.expected.size(); ++i) {
        result.expected.push_back(a.expected[i] >= b.expected[i] ? c.expected[i] : a.expected[i]);
      }
      return result;
    }
    case 8: {  // the quotient of a multiple and an offset, as narrowing makes them
      const int factor = 1 + random.below(12), plus = random.below(25) - 12;
      const V n = emit::add(emit::mul(a.value, emit::set(factor)), emit::set(plus));
      if (n.range().low < 0) return a;
      Sample result{emit::divide(n, divisor), a.expected};
      for (I& e : result.expected) e = (e * factor + plus) / divisor;
      return result;
    }
    default:
      if (a.value.range().low < 0) return a;
      Sample result{emit::divide(a.value, divisor), a.expected};
      for (I& n : result.expected) n /= divisor;
      return result;
  }
}

TEST(EmitExpression, SimplificationsKeepEveryValueInItsInterval) {
  int constants = 0, made = 0;
  for (std::uint64_t index = 0; index < cases_here<std::uint64_t>(6000); ++index) {
    Random random(0x65787072U, index);
    Graph graph;
    std::vector<Sample> samples{{graph.input("x", kX), {}}, {graph.input("y", kY), {}}};
    for (std::int64_t x = kX.low; x <= kX.high; ++x) {
      for (std::int64_t y = kY.low; y <= kY.high; ++y) {
        samples[0].expected.push_back(x);
        samples[1].expected.push_back(y);
      }
    }
    const auto any = [&] {
      if (random.one_in(3)) return constant(random);
      return samples[static_cast<std::size_t>(random.below(static_cast<int>(samples.size())))];
    };
    for (int step = 0; step < 6; ++step) {
      Sample next = next_of(random, any(), any(), any());
      if (random.one_in(8)) Graph::name(next.value, "named" + std::to_string(step));
      const emit::Interval range = next.value.range();
      std::size_t i = 0;
      for (std::int64_t x = kX.low; x <= kX.high; ++x) {
        for (std::int64_t y = kY.low; y <= kY.high; ++y, ++i) {
          ASSERT_EQ(computed(graph, next.value, x, y), next.expected[i])
              << "case " << index << ", step " << step << ", x = " << x << ", y = " << y;
          ASSERT_TRUE(range.low <= next.expected[i] && next.expected[i] <= range.high) << "case " << index;
        }
      }
      constants += next.value.is_constant() ? 1 : 0;
      ++made;
      if (range.low > -100000 && range.high < 100000) samples.push_back(std::move(next));
    }
    ASSERT_FALSE(graph.negative_division());
  }
  EXPECT_LT(constants * 2, made) << "most expressions should depend on their inputs";
}

}  // namespace
}  // namespace ninebit::test
