// AB + CD over all inputs, one by one: every register code from -one to one for each of A, B, C and D. With nine bits
// these are 511^4 = 68,184,176,641 cases.
//
// Each case is evaluated by the rules of arithmetic.inl in vector lanes and compared with exact integer arithmetic
// in units of 1 / (4 one²). datapath_error.h computes the same numbers independently, by counting wide values.
#pragma once

#include <memory>
#include <span>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/datapath_error.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// One unit for each form and each value of A. Reports a profile whose arithmetic is not integer, and empty `forms`.
//
// Rows of the table "rows", one for each unit:
//   profile, form, a
//   cases, exact, inexact   all inputs with this A; inputs whose result is exact; the others
//   max_error_codes         the largest absolute error, in codes
//   sum_of_sizes_codes_times_4one    the sum of absolute errors in codes, times 4 one: a whole number
//   sum_of_errors_codes_times_4one   the sum of signed errors in codes, times 4 one: a whole number
//   sum_of_codes, sum_of_squares   checksums: the sums of all results and of their squares. If narrowing is
//                           symmetric, sum_of_codes is 0, because each case has a partner with all signs changed.
[[nodiscard]] Result<std::unique_ptr<Study>> exhaustive_sum_study(StudyQuestion question,
                                                                  const HardwareProfile& profile,
                                                                  std::span<const OutputForm> forms);

}  // namespace ninebit
