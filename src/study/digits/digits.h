// The digits of an index: the channels that hold it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/index_steps.h"
#include "src/study/digits/digit_flow.h"

namespace ninebit {

inline constexpr std::size_t kMostDigits = 3;

// A byte for each digit. Digits that a format does not have are ignored.
using DigitBytes = std::array<std::uint8_t, kMostDigits>;

// The components of a colour that hold one digit; all have the same value.
struct Digit {
  std::array<int, 3> component{};
  std::size_t count = 1;
  [[nodiscard]] std::span<const int> components() const { return {component.data(), count}; }
};

[[nodiscard]] std::span<const Digit> digits_of(StudyFormat format);

// The registers before the first stage: own index in primary, the other in texture0.
[[nodiscard]] RegisterFile comparison_registers(const HardwareProfile& profile, StudyFormat format,
                                                const DigitBytes& own, const DigitBytes& other);

// For each register component, the set of digits that it depends on before the first stage. Bit d stands for digit d.
[[nodiscard]] ByComponent<unsigned> digits_before_first_stage(StudyFormat format);

// The number of inputs for each wide value.

// Counts for the wide values -limit … limit: count[limit + w] inputs give w.
struct WideCounts {
  int limit = 0;
  std::vector<std::uint64_t> count;
  [[nodiscard]] std::uint64_t of(int wide) const { return count[static_cast<std::size_t>(limit + wide)]; }
};

// Counts of the products of two mapped inputs, each from -one to one.
[[nodiscard]] WideCounts product_counts(int one);

// Counts of the sums of all pairs of a value of `first` and a value of `second`. Counts must stay below 2^63.
[[nodiscard]] WideCounts sum_counts(const WideCounts& first, const WideCounts& second);

}  // namespace ninebit
