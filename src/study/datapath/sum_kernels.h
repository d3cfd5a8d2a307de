// AB + CD case by case in vector lanes, compiled once for every SIMD target and chosen at run time.
#pragma once

#include <cstdint>

#include "ninebit/numerics/datapath.h"
#include "ninebit/study/datapath_error.h"

namespace ninebit {

// Errors are whole numbers of 1 / (4 one²): the exact value of half a wide value is one.
struct SumTotals {
  std::uint64_t cases = 0;
  std::uint64_t inexact = 0;   // with an error other than 0
  std::int64_t max_error = 0;  // the largest size
  std::int64_t sum_of_sizes = 0;
  std::int64_t sum_of_errors = 0;  // with their signs
  std::int64_t sum_of_codes = 0;
  std::int64_t sum_of_squares = 0;  // of codes

  void add(const SumTotals& other);
  friend bool operator==(const SumTotals&, const SumTotals&) = default;
};

// All C and D from -one to one with one pair of A and B. For integer arithmetic.
[[nodiscard]] SumTotals sum_totals(const Datapath& datapath, const OutputForm& form, int a, int b);

}  // namespace ninebit
