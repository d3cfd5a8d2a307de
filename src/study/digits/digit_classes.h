// Sorts the pairs of a digit's values into classes that a comparison cannot distinguish.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ninebit/combiner/evaluate.h"
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

// The key of a pair of one digit's values: the numbers through which the pair affects the rest of a program.

// Makes keys. A program cannot distinguish pairs with equal keys. With a DigitSum a key is the digit's product of the
// second stage; otherwise it is the first stage's results in all components that depend on the digit and are read
// later. Doubles hold the numbers exactly: codes, 32-bit floats, or numerators over one common denominator. Use one
// object per thread.
class DigitKeys {
 public:
  // The program and the sum must outlive the object.
  DigitKeys(const Program& program, const ByComponent<unsigned>& after, const std::optional<DigitSum>& sum);
  ~DigitKeys();
  DigitKeys(const DigitKeys&) = delete;
  DigitKeys& operator=(const DigitKeys&) = delete;

  // The number of doubles in a key of this digit; may be 0.
  [[nodiscard]] std::size_t width(std::size_t digit) const;
  // Writes the key of the registers as they are before the first stage.
  void write(const RegisterFile& registers, std::size_t digit, double* key);

  class Numbers;  // evaluates in the program's arithmetic

 private:
  struct Place {
    std::size_t reg = 0, component = 0;
  };

  const std::optional<DigitSum>& sum_;
  std::array<std::vector<Place>, 3> places_;  // of each digit, without a DigitSum
  std::unique_ptr<Numbers> numbers_;
};

}  // namespace ninebit
