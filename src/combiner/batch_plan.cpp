#include "src/combiner/batch_plan.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace ninebit::detail {
namespace {

// An operation moves forward past fewer others than this: the planes that it reads and writes are held for longer.
constexpr std::size_t kFarthestMove = 24;

// No more operations than this take in a line that each could.
constexpr int kMostReaders = 4;

bool multiplies(const Formula& f) {
  return f.kernel == Kernel::unsigned_products || f.kernel == Kernel::signed_product ||
         f.kernel == Kernel::signed_sum || f.kernel == Kernel::products;
}

class Planner {
 public:
  explicit Planner(const ValueGraph& graph) : graph_(graph), uses_(graph.nodes().size()) {}

  std::vector<PlannedOperation> run(std::span<const Value> wanted) {
    count_uses(wanted);
    std::vector<PlannedOperation> operations;
    for (std::size_t v = 0; v < uses_.size(); ++v) {
      if (uses_[v].all == 0 || graph_.nodes()[v].source != Source::operation || is_folded(v)) continue;
      operations.push_back(planned(static_cast<Value>(v)));
    }
    return in_order(std::move(operations));
  }

 private:
  struct Uses {
    int all = 0, as_factor = 0, in_pairs = 0, floored = 0;
    bool positive = false;  // only the value's positive part is computed
  };

  // Readers come after what they read, so that all uses of a value are counted before its own sources' are.
  void count_uses(std::span<const Value> wanted) {
    for (const Value v : wanted) ++uses_[v].all;
    for (std::size_t v = uses_.size(); v-- > 0;) {
      const ValueGraph::Node& node = graph_.nodes()[v];
      if (uses_[v].all == 0 || node.source != Source::operation) continue;
      uses_[v].positive = uses_[v].floored == uses_[v].all && can_be_positive(static_cast<Value>(v));
      const Formula& f = node.formula;
      for (std::size_t k = 0; k < static_cast<std::size_t>(f.sources()); ++k) {
        Uses& uses = uses_[node.of[k]];
        ++uses.all;
        uses.as_factor += can_be_line(node, k) ? 1 : 0;
        uses.in_pairs += can_be_line(node, k) && f.terms <= 2 ? 1 : 0;
        uses.floored += f.is_floored(k) || (uses_[v].positive && is_choice(f, k)) ? 1 : 0;
      }
    }
  }

  // Whether the source is one of the two that a select chooses from.
  static bool is_choice(const Formula& f, std::size_t k) {
    return (f.kernel == Kernel::select || f.kernel == Kernel::select_odd) && k > 0;
  }

  // Whether computing max(0, value) instead of the value costs nothing.
  [[nodiscard]] bool can_be_positive(Value v) const {
    const Formula& f = graph_.nodes()[v].formula;
    if (graph_.range(v).high <= 0) return false;  // no limits
    switch (f.kernel) {
      case Kernel::affine:
        return f.clamps();
      case Kernel::products:
      case Kernel::signed_sum:
        return true;
      case Kernel::signed_product:
        return f.positive_first;
      case Kernel::select:
      case Kernel::select_odd:
        return is_operation(graph_.nodes()[v].of[1]) && is_operation(graph_.nodes()[v].of[2]);
      case Kernel::unsigned_products:
      case Kernel::copy:
        break;
    }
    return false;
  }

  [[nodiscard]] bool is_operation(Value v) const { return graph_.nodes()[v].source == Source::operation; }

  // Moves the floors of a value's readers into its own formula, and those of its sources to where they come from.
  [[nodiscard]] Formula with_floors_moved(Value v) const {
    const ValueGraph::Node& node = graph_.nodes()[v];
    Formula f = node.formula;
    for (std::size_t k = 0; k < static_cast<std::size_t>(f.sources()); ++k) {
      const bool floored =
          f.is_floored(k) || (uses_[v].positive && is_choice(f, k) && graph_.range(node.of[k]).low < 0);
      const std::uint32_t bit = 1U << k;
      f.floors = floored && !uses_[node.of[k]].positive ? f.floors | bit : f.floors & ~bit;
    }
    if (!uses_[v].positive || f.kernel == Kernel::select || f.kernel == Kernel::select_odd) return f;
    f.positive_part = f.kernel == Kernel::signed_product || f.kernel == Kernel::signed_sum;
    f.low = 0;
    f.high = std::min(f.high, graph_.range(v).high);
    return f;
  }

  // Whether a kernel may map the source. Those of unsigned products only subtract.
  [[nodiscard]] bool can_be_line(const ValueGraph::Node& node, std::size_t k) const {
    const Formula& f = node.formula;
    const bool is_factor = multiplies(f) && f.terms <= 3 && k < 2 * static_cast<std::size_t>(f.terms);
    if (!is_factor || f.is_floored(k)) return false;
    const ValueGraph::Node& source = graph_.nodes()[node.of[k]];
    return f.kernel != Kernel::unsigned_products || (f.terms <= 2 && source.formula.factor[0] == -1);
  }

  // A line with the factor 1 or -1 is one instruction: several operations may take it in rather than read a plane.
  [[nodiscard]] bool is_folded(std::size_t v) const {
    const ValueGraph::Node& node = graph_.nodes()[v];
    const Formula& f = node.formula;
    if (node.source != Source::operation || f.kernel != Kernel::affine || f.terms != 1 || f.halves || f.clamps() ||
        uses_[v].as_factor != uses_[v].all) {
      return false;
    }
    const bool is_short = std::abs(f.factor[0]) == 1 && (!f.is_floored(0) || uses_[node.of[0]].positive);
    return uses_[v].all == 1 || (is_short && uses_[v].in_pairs == uses_[v].all && uses_[v].all <= kMostReaders);
  }

  // A factor of a product.
  struct Factor {
    Value of = 0;
    bool floored = false, has_line = false;
    Line line;
    // Kernels have more forms for the first factors of products: longer lines come first.
    [[nodiscard]] int rank() const { return !has_line ? 0 : line.factor == 1 ? 1 : line.factor == -1 ? 2 : 3; }
  };

  [[nodiscard]] Factor factor(const ValueGraph::Node& node, std::size_t k) const {
    const Value v = node.of[k];
    if (!is_folded(v)) return {v, node.formula.is_floored(k) && !uses_[v].positive, false, {}};
    const ValueGraph::Node& inner = graph_.nodes()[v];
    const Formula f = with_floors_moved(v);
    return {inner.of[0], f.is_floored(0), true, {static_cast<s9>(f.factor[0]), static_cast<s9>(f.offset)}};
  }

  [[nodiscard]] PlannedOperation planned(Value v) const {
    const ValueGraph::Node& node = graph_.nodes()[v];
    PlannedOperation operation{.value = v, .formula = with_floors_moved(v), .of = node.of};
    if (!multiplies(node.formula)) return operation;
    struct Product {
      Factor x, y;
      [[nodiscard]] int lines() const { return (x.has_line ? 1 : 0) + (y.has_line ? 1 : 0); }
    };
    std::vector<Product> products;
    for (std::size_t k = 0; k < 2 * static_cast<std::size_t>(node.formula.terms); k += 2) {
      Product p{factor(node, k), factor(node, k + 1)};
      if (p.y.rank() > p.x.rank() && !node.formula.positive_first) std::swap(p.x, p.y);
      products.push_back(p);
    }
    std::stable_sort(products.begin(), products.end(),
                     [](const Product& a, const Product& b) { return a.lines() > b.lines(); });
    for (std::size_t i = 0; i < products.size(); ++i) {
      set(operation, 2 * i, products[i].x);
      set(operation, 2 * i + 1, products[i].y);
    }
    return operation;
  }

  static void set(PlannedOperation& operation, std::size_t k, const Factor& factor) {
    const std::uint32_t bit = 1U << k;
    operation.of[k] = factor.of;
    operation.line[k] = factor.line;
    operation.lines |= factor.has_line ? bit : 0;
    operation.formula.floors = (operation.formula.floors & ~bit) | (factor.floored ? bit : 0);
  }

  // Takes the first operation that is ready, then those like it.
  [[nodiscard]] std::vector<PlannedOperation> in_order(std::vector<PlannedOperation> operations) const {
    std::vector<bool> waits(uses_.size());
    for (const PlannedOperation& operation : operations) waits[operation.value] = true;
    const auto is_ready = [&](const PlannedOperation& operation) {
      const auto sources = operation.of.begin();
      return std::none_of(sources, sources + operation.formula.sources(), [&](Value v) { return waits[v]; });
    };
    std::vector<PlannedOperation> ordered;
    for (std::size_t first = 0; first < operations.size(); ++first) {
      if (!waits[operations[first].value]) continue;
      const PlannedOperation& leader = operations[first];
      const std::size_t end = std::min(first + kFarthestMove, operations.size());
      for (std::size_t i = first; i < end; ++i) {
        const PlannedOperation& next = operations[i];
        if (!waits[next.value] || !next.is_like(leader) || !is_ready(next)) continue;
        waits[next.value] = false;
        ordered.push_back(next);
      }
    }
    return ordered;
  }

  const ValueGraph& graph_;
  std::vector<Uses> uses_;
};

}  // namespace

std::vector<PlannedOperation> plan(const ValueGraph& graph, std::span<const Value> wanted) {
  return Planner(graph).run(wanted);
}

}  // namespace ninebit::detail
