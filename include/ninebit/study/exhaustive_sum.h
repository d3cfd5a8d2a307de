// AB + CD over all of its inputs, one by one: every register code from -one to one for each of A, B, C and D, which are
// 511^4 = 68,184,176,641 cases with nine bits.
//
// Each case is evaluated by the rules of arithmetic.inl in vector lanes and compared with exact arithmetic in whole
// numbers, in units of 1 / (4 one²). datapath_error.h gets the same numbers by counting wide values; neither shares
// with the other how it does so.
#pragma once

#include <memory>
#include <span>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/datapath_error.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// One unit for each form and each value of A. Reports a profile whose arithmetic is not integer, and a missing form.
//
// Rows of the table "rows", one a unit:
//   profile, form, a
//   cases, exact, inexact   all inputs with this A; those whose result is the exact value; the others
//   max_error               the largest size of an error, in real numbers
//   sum_of_sizes            of all errors' sizes, in units of 1 / (4 one²)
//   sum_of_errors           the same with their signs
//   sum_of_codes, sum_of_squares   of all results and of their squares: checksums. Where narrowing is symmetric the
//   first
//                           is 0, as each case has one with all signs changed.
[[nodiscard]] Result<std::unique_ptr<Study>> exhaustive_sum_study(StudyQuestion question,
                                                                  const HardwareProfile& profile,
                                                                  std::span<const OutputForm> forms);

}  // namespace ninebit
