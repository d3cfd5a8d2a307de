// Sorts the pairs of a digit's values into classes that a comparison cannot distinguish.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/result.h"
#include "src/study/digits/digit_flow.h"
#include "src/study/digits/digits.h"

namespace ninebit {

struct PairClass {
  std::uint8_t own = 0, other = 0;  // one of its pairs
  std::uint64_t pairs = 1;          // number of pairs
  std::uint64_t equal = 1;          // number of pairs with equal values
};

// All 65,536 pairs of bytes of each digit, classified once for every step.
class DigitClasses {
 public:
  // With the program's `sum`, the classes are ordered by their products. Reports a program whose first stage mixes
  // digits in a component that is read later, and Fault::cancelled.
  [[nodiscard]] static Result<DigitClasses> of(const Program& program, const HardwareProfile& profile,
                                               StudyFormat format, const std::optional<DigitSum>& sum,
                                               const GoOn& go_on);

  [[nodiscard]] std::size_t digits() const { return digits_.size(); }
  // The classes of a digit that holds one of these values. Empty classes are left out.
  [[nodiscard]] std::vector<PairClass> among(std::size_t digit, std::span<const std::uint8_t> values) const;

 private:
  struct OfDigit {
    std::vector<std::uint32_t>
        of_pair;                     // class number of each pair, at index 256 own + other; in the order of the keys
    std::vector<PairClass> classes;  // without counts
  };
  std::vector<OfDigit> digits_;
};

}  // namespace ninebit
