// The values that a program computes of one fragment's registers: each is made once, by one formula of earlier values.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/datapath.h"
#include "src/combiner/vector_code.h"

namespace ninebit::detail {

using Value = std::uint16_t;  // its number in the graph

// All that a value can be: inclusive.
struct Range {
  int low = 0, high = 0;
};

// factor · value + offset, the value without its negative part where `floored`. A constant has factor 0.
struct Linear {
  Value value = 0;
  bool floored = false;
  int factor = 0;
  int offset = 0;

  [[nodiscard]] bool is_constant() const { return factor == 0; }
  friend bool operator==(const Linear&, const Linear&) = default;
};

// What an operation reads: a value, without its negative part where `floored`.
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
    int number = 0;  // the constant; or of an input: 4 · register + component
    Formula formula;
    std::array<Value, kMostSources> of{};
    friend auto operator<=>(const Node&, const Node&) = default;
  };

  explicit ValueGraph(const Datapath& datapath) : datapath_(datapath) {}

  Value constant(int code);
  Value input(Register reg, int component);

  // clamp(sum of the terms · 2^doublings, or one half of it) to [low, high]; at most two terms that are not constant.
  Value affine(std::span<const Linear> terms, Scale scale, Narrowing narrowing, int low, int high);

  // A linear value as an operation can read it.
  Operand operand(const Linear& linear);

  // `by` >= one half ? yes : no
  Value select(Value by, const Operand& no, const Operand& yes);
  // `by` odd, without its negative part ? yes : no
  Value select_odd(Value by, const Operand& no, const Operand& yes);

  // An operation whose results are known to lie in `range`.
  Value add(Formula formula, std::span<const Operand> of, const Range& range);

  [[nodiscard]] const Range& range(Value v) const { return ranges_[v]; }
  [[nodiscard]] Range range(const Operand& operand) const;
  [[nodiscard]] Range range(const Linear& linear) const;
  [[nodiscard]] bool is_constant(Value v) const { return nodes_[v].source == Source::constant; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const Datapath& datapath() const { return datapath_; }

 private:
  Value find_or_add(const Node& node, const Range& range);
  Value chosen(const Operand& operand);

  Datapath datapath_;
  std::vector<Node> nodes_;
  std::vector<Range> ranges_;
  std::map<Node, Value> numbers_;
};

}  // namespace ninebit::detail
