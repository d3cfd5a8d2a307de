// The flow of an index's digits through a program: the components that depend on each digit after the first stage, and
// whether the second stage sums the digits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"

namespace ninebit {

// A value for each component of each register.
template <class T>
using ByComponent = std::array<std::array<T, 4>, kRegisterCount>;

// For each register component, the set of digits that it depends on after the first stage, given the sets before it.
// Bit d stands for digit d.
[[nodiscard]] ByComponent<unsigned> digits_after_first_stage(const Program& program,
                                                             const ByComponent<unsigned>& before);

// The components that the final combiner or a stage numbered `first` or higher reads. May include components that do
// not affect the result.
[[nodiscard]] ByComponent<bool> read_from_stage(const Program& program, int first);

// A product of the second stage.
struct ProductTerm {
  std::size_t channel = 0;  // 0 to 2: of the RGB portion; 3: the alpha portion
  bool cd = false;          // true: C·D, false: A·B
};

// A comparison that sums its digits: the final combiner's alpha is a function of one sum of products of the second and
// last stage, with at most one product for each digit. In every arithmetic, alpha is then a non-decreasing (`falling`:
// non-increasing) function of each product: additions, the bias, the scale, narrowing, the clamps and the final
// combiner's mapping are each monotone, also in rounded floats.
struct DigitSum {
  std::array<std::optional<ProductTerm>, 3> of_digit{};
  bool falling = false;
};

// Empty if the program has another form. `after` is the result of digits_after_first_stage.
[[nodiscard]] std::optional<DigitSum> digit_sum(const Program& program, const ByComponent<unsigned>& after);

}  // namespace ninebit
