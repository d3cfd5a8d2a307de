// The error of each datapath operation against exact arithmetic, over all inputs.
//
// Nothing is sampled. A sum of products depends only on its wide value, so each wide value is evaluated once and
// weighted by the number of inputs that give it: the 511^6 inputs of a dot product have 390,151 wide values.
// exhaustive_sum.h evaluates the inputs of AB + CD one by one.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// One of the six legal pairs of scale and bias, which a general combiner applies to a wide value before narrowing it.
struct OutputForm {
  Scale scale = Scale::none;  // applied after the bias
  Bias bias = Bias::none;     // applied before the scale
  std::string_view name;      // "-1/2, x2"
};

// All six, the plain one first.
inline constexpr std::array kOutputForms{OutputForm{Scale::none, Bias::none, "x1"},
                                         OutputForm{Scale::by_two, Bias::none, "x2"},
                                         OutputForm{Scale::by_four, Bias::none, "x4"},
                                         OutputForm{Scale::by_one_half, Bias::none, "x1/2"},
                                         OutputForm{Scale::none, Bias::by_negative_one_half, "-1/2, x1"},
                                         OutputForm{Scale::by_two, Bias::by_negative_one_half, "-1/2, x2"}};

// Measures every operation of every profile with integer arithmetic, over all codes from -one to one. For each pair of
// these profiles whose codes stand for the same numbers, counts the inputs on which their codes differ. Profiles with
// another arithmetic are skipped; reports if no profile is left. A unit is one kind of operation of a profile or pair.
//
// An error is a result's code minus the exact value in codes (the real number times one), which is clamped where the
// extension clamps.
//
// Rows of the table "rows", one for each operation and form of a profile:
//   profile
//   operation, form          "mapping", "product", "dot product", …; the mapping, or the output's scale and bias
//   cases, exact, distinct   all inputs; inputs without an error; number of different result codes
//   max_error_codes, mean_error_codes   the largest and the mean absolute error, in codes
//   mean_bias_codes          the mean signed error, in codes
//   worst, worst_code, worst_exact_codes   the first inputs with the largest error, as codes; the result; the exact
//                            value in codes
//
// Rows of the table "differences": first, second (the profiles), operation, form, cases, differ (inputs with different
// codes).
[[nodiscard]] Result<std::unique_ptr<Study>> datapath_study(StudyQuestion question,
                                                            std::span<const HardwareProfile> profiles);

}  // namespace ninebit
