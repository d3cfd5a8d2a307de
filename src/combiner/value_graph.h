// The values that a program computes from one fragment's registers. Each value has one formula of earlier values, and
// equal formulas are one value.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/combiner/interval.h"
#include "src/combiner/vector_code.h"

namespace ninebit::detail {

using Value = std::uint16_t;  // a node's index in the graph

// The possible codes of a value, inclusive.
using Range = IntervalOf<int>;

// factor · value + offset; if `floored`, with max(0, value). A constant has factor 0.
struct Linear {
  Value value = 0;
  bool floored = false;
  int factor = 0;
  int offset = 0;

  [[nodiscard]] bool is_constant() const { return factor == 0; }
  friend bool operator==(const Linear&, const Linear&) = default;
};

// A source of an operation: a value or, if `floored`, max(0, value).
struct Operand {
  Value value = 0;
  bool floored = false;
  friend auto operator<=>(const Operand&, const Operand&) = default;
};

enum class Source : std::uint8_t { constant, input, operation };

class ValueGraph {
 public:
  struct Node {
    Source source = Source::constant;
    int number = 0;  // a constant's code; an input's 4 · register + component
    Formula formula;
    std::array<Value, kMostSources> of{};
    friend auto operator<=>(const Node&, const Node&) = default;
  };

  ValueGraph(const Datapath& datapath, BatchInputs inputs)
      : datapath_(datapath), lowest_input_(inputs == BatchInputs::not_negative ? 0 : datapath.lowest) {}

  Value constant(int code);
  Value input(Register reg, int component);

  // Returns the sum of the terms, scaled and clamped to [low, high]. At most two terms may be non-constant. Only the
  // scale of one half needs `narrowing`.
  Value affine(std::span<const Linear> terms, Scale scale, Narrowing narrowing, int low, int high);

  // Returns a linear value as a source; adds an operation if it needs one.
  Operand operand(const Linear& linear);

  // Returns an operand as a value.
  Value chosen(const Operand& operand);

  // Returns `by` >= one half ? yes : no.
  Value select(Value by, const Operand& no, const Operand& yes);
  // Returns max(0, `by`) is odd ? yes : no.
  Value select_odd(Value by, const Operand& no, const Operand& yes);

  // Adds an operation whose results are known to lie in `range`.
  Value add(Formula formula, std::span<const Operand> of, const Range& range);

  [[nodiscard]] const Range& range(Value v) const { return ranges_[v]; }
  [[nodiscard]] Range range(const Operand& operand) const;
  [[nodiscard]] Range range(const Linear& linear) const;
  [[nodiscard]] bool is_constant(Value v) const { return nodes_[v].source == Source::constant; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const Datapath& datapath() const { return datapath_; }

 private:
  Value find_or_add(const Node& node, const Range& range);

  Datapath datapath_;
  int lowest_input_;
  std::vector<Node> nodes_;
  std::vector<Range> ranges_;
  std::map<Node, Value> numbers_;
};

}  // namespace ninebit::detail
