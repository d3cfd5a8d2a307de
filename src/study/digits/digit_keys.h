// The key of a pair of one digit's values: the numbers through which the pair affects the rest of a program.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "src/study/digits/digit_flow.h"

namespace ninebit {

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
