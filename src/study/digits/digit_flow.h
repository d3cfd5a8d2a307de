// How the digits of an index flow through a program: what depends on which of them after the first stage, and whether
// the second stage sums them up.
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

// Sets of digits, a bit for each, that the registers' components depend on after the first stage, given what they
// depend on before it.
[[nodiscard]] ByComponent<unsigned> digits_after_first_stage(const Program& program,
                                                             const ByComponent<unsigned>& before);

// The components that a stage from number `first` on, or the final combiner, reads: at least those that matter.
[[nodiscard]] ByComponent<bool> read_from_stage(const Program& program, int first);

// A product of the second stage.
struct ProductTerm {
  std::size_t channel = 0;  // 0 to 2: of the RGB portion; 3: the alpha portion
  bool cd = false;          // C·D, otherwise A·B
};

// A comparison that sums its digits: the alpha that leaves the final combiner is a function of one sum of products of
// the second and last stage, among them at most one of each digit. Whatever the arithmetic, it then does not fall (or,
// where `falling`, not rise) when one product grows: additions, the bias, the scale, narrowing, the clamps and the
// final combiner's mapping are monotone functions each, also in rounded floats.
struct DigitSum {
  std::array<std::optional<ProductTerm>, 3> of_digit{};
  bool falling = false;
};

// Empty: the program is of another form. `after` is what digits_after_first_stage says.
[[nodiscard]] std::optional<DigitSum> digit_sum(const Program& program, const ByComponent<unsigned>& after);

}  // namespace ninebit
