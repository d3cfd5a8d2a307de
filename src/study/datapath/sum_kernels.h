// AB + CD case by case in vector lanes, compiled for every SIMD target and selected at run time.
#pragma once

#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/datapath_error.h"

namespace ninebit {

// Errors are whole multiples of 1 / (4 one²), because even half of a wide value is such a multiple.
struct SumTotals {
  std::uint64_t cases = 0;
  std::uint64_t inexact = 0;       // cases with an error other than 0
  std::int64_t max_error = 0;      // the largest absolute error
  std::int64_t sum_of_sizes = 0;   // of absolute errors
  std::int64_t sum_of_errors = 0;  // of signed errors
  std::int64_t sum_of_codes = 0;
  std::int64_t sum_of_squares = 0;  // of codes

  void add(const SumTotals& other);
  friend bool operator==(const SumTotals&, const SumTotals&) = default;
};

// Evaluates all C and D from -one to one with one pair of A and B. For integer arithmetic.
[[nodiscard]] SumTotals sum_totals(const Datapath& datapath, const OutputForm& form, int a, int b);

}  // namespace ninebit
