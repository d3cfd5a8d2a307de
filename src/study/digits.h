// The digits of an index and the classes that their pairs fall into.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/result.h"
#include "ninebit/study/index_steps.h"

namespace ninebit {

// The components of a colour that hold one digit, all with the same value.
struct Digit {
  std::vector<int> components;
};

[[nodiscard]] std::vector<Digit> digits_of(StudyFormat format);

// The registers before the first stage: own index in primary, the other in texture0, a byte for each digit.
[[nodiscard]] RegisterFile comparison_registers(const HardwareProfile& profile, StudyFormat format,
                                                std::span<const std::uint8_t> own, std::span<const std::uint8_t> other);

// Pairs of a digit's values that no stage after the first can tell apart.
struct DigitClass {
  std::uint8_t own = 0, other = 0;  // one of them
  std::uint64_t pairs = 0;          // how many there are
  std::uint64_t equal = 0;          // how many of them pair a value with itself
};

// The classes of each digit. Reports a program whose first stage mixes digits in something that is read later.
[[nodiscard]] Result<std::vector<std::vector<DigitClass>>> digit_classes(const Program& program,
                                                                         const HardwareProfile& profile,
                                                                         StudyFormat format, int step);

}  // namespace ninebit
