// Symbolic values: the primitives of arithmetic.inl build a graph of integer operations instead of computing. Every
// node has the interval of its value, so clamps without effect are dropped, and overflow of 32 bits is detected when
// the text is emitted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/combiner/interval.h"

namespace ninebit::emit {

class Graph;

using Interval = IntervalOf<std::int64_t>;

// The value type V of the rules: a constant, or a node of a graph.
struct V {
  Graph* graph = nullptr;  // nullptr: a constant
  int node = 0;
  std::int64_t constant = 0;

  [[nodiscard]] bool is_constant() const { return graph == nullptr; }
  [[nodiscard]] Interval range() const;
  [[nodiscard]] bool is_vector() const;
  friend bool operator==(const V&, const V&) = default;
};

enum class Opcode : std::uint8_t {
  input,                  // args: none; the node's name is its text
  add,                    // args[0] + args[1]
  sub,                    // args[0] - args[1]
  mul,                    // args[0] * args[1]
  min_of,                 // the smaller
  max_of,                 // the larger
  abs_of,                 // |args[0]|
  divide,                 // args[0] / args[1], args[0] >= 0, args[1] a constant > 0
  negate_where_negative,  // args[0] < 0 ? -args[1] : args[1]
  select_where_at_least,  // args[0] >= args[1] ? args[2] : args[3]
  sum_of_components       // of a vector
};

struct Node {
  Opcode opcode = Opcode::input;
  std::array<V, 4> args{};
  Interval range;
  std::string name;     // empty: an inner value
  bool named = false;   // declared in its own line even if used once
  bool vector = false;  // red, green and blue; the interval is that of each
};

// Nodes in the order of creation: arguments precede their users. Equal nodes are created once.
class Graph {
 public:
  Graph() = default;
  // Formulas are not for reading: no value has a name, which would end a simplification, and limits move inside sums
  // and quotients, where equal ones meet.
  enum class Purpose : bool { text, formulas };
  explicit Graph(Purpose purpose) : purpose_(purpose) {}
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  V input(std::string text, Interval range, bool vector = false);
  V make(Opcode opcode, const std::array<V, 4>& args, Interval range);

  // Names a value and returns true, unless it already has a name; constants and inputs keep their text.
  static bool name(const V& value, const std::string& name);
  // Replaces the name of a value that has one.
  static void rename(const V& value, const std::string& name);

  [[nodiscard]] const Node& operator[](int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] Purpose purpose() const { return purpose_; }

  // Whether a dividend may be negative: the result would then depend on the language.
  void refuse_division() { negative_division_ = true; }
  [[nodiscard]] bool negative_division() const { return negative_division_; }

 private:
  std::vector<Node> nodes_;
  bool negative_division_ = false;
  Purpose purpose_ = Purpose::text;
};

V set(int v);
V add(V a, V b);
V sub(V a, V b);
V mul(V a, V b);
V min_of(V a, V b);
V max_of(V a, V b);
V abs_of(V a);
V divide(V n, int d);
V negate_where_negative(V sign, V x);
V select_where_at_least(V v, V limit, V yes, V no);

// The sum of a value's red, green and blue, which are equal if it is not a vector. No rule has it: dot products do.
V sum_of_components(V a);

}  // namespace ninebit::emit
