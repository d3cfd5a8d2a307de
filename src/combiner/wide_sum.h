// Sums of products, and the cheapest operation that narrows one to a code.
#pragma once

#include <vector>

#include "src/combiner/value_graph.h"

namespace ninebit::detail {

// A sum of products of mapped inputs, in units of 1 / one².
class WideSum {
 public:
  // x · y. x is never constant; y may be.
  struct Product {
    Linear x, y;
  };

  void add(const Linear& x, const Linear& y);
  void add(const WideSum& other);
  void add(int constant) { constant_ += constant; }

  [[nodiscard]] int constant() const { return constant_; }
  [[nodiscard]] const std::vector<Product>& products() const { return products_; }

 private:
  int constant_ = 0;
  std::vector<Product> products_;
};

// How a wide sum is narrowed to a code: clamp(narrow(sum · scale, one) + added, low, high).
struct Narrowed {
  Narrowing narrowing = Narrowing::toward_zero;
  Scale scale = Scale::none;
  int low = 0, high = 0;
  Linear added{};  // only with scale none and a sum that is not negative
};

// Whether the sum needs no multiplication or division: it has at most two products, each with a factor of one or minus
// one.
[[nodiscard]] bool is_affine(const ValueGraph& graph, const WideSum& sum);

Value narrow(ValueGraph& graph, const WideSum& sum, const Narrowed& how);

// Rules 3 to 8: returns the value that a general combiner writes for a wide sum.
Value combiner_output(ValueGraph& graph, WideSum sum, Scale scale, Bias bias);

}  // namespace ninebit::detail
