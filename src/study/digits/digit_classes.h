// Pairs of a digit's values, sorted into classes that a comparison cannot tell apart.
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
  std::uint64_t pairs = 1;          // how many there are
  std::uint64_t equal = 1;          // how many of them pair a value with itself
};

// All 65,536 pairs of bytes of each digit, classified once for every step.
class DigitClasses {
 public:
  // `sum`: the program's, if the classes shall be in the order of their products. Reports a program whose first stage
  // mixes digits in something that is read later, and Fault::cancelled.
  [[nodiscard]] static Result<DigitClasses> of(const Program& program, const HardwareProfile& profile,
                                               StudyFormat format, const std::optional<DigitSum>& sum,
                                               const GoOn& go_on);

  [[nodiscard]] std::size_t digits() const { return digits_.size(); }
  // The classes of a digit that may hold these values: those that have members.
  [[nodiscard]] std::vector<PairClass> among(std::size_t digit, std::span<const std::uint8_t> values) const;

 private:
  struct OfDigit {
    std::vector<std::uint32_t> of_pair;  // 256 own + other: the number of the pair's class, in the order of the keys
    std::vector<PairClass> classes;      // without counts
  };
  std::vector<OfDigit> digits_;
};

}  // namespace ninebit
