// How far each operation of the datapath is from exact arithmetic, over all of its inputs.
//
// Nothing is sampled. A sum of products depends on its wide value alone, so that a wide value is evaluated once and
// counted as often as inputs give it: a dot product's 511^6 inputs have 390,151 wide values. exhaustive_sum.h evaluates
// the inputs of AB + CD one by one.
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

// What a general combiner does to a wide value before it is narrowed: one of the six legal pairs of scale and bias.
struct OutputForm {
  Scale scale = Scale::none;  // after the bias
  Bias bias = Bias::none;     // before the scale
  std::string_view name;      // "-1/2, x2"
};
inline constexpr std::array kOutputForms{OutputForm{Scale::none, Bias::none, "x1"},
                                         OutputForm{Scale::by_two, Bias::none, "x2"},
                                         OutputForm{Scale::by_four, Bias::none, "x4"},
                                         OutputForm{Scale::by_one_half, Bias::none, "x1/2"},
                                         OutputForm{Scale::none, Bias::by_negative_one_half, "-1/2, x1"},
                                         OutputForm{Scale::by_two, Bias::by_negative_one_half, "-1/2, x2"}};

// Measures every operation of every profile with integer arithmetic, over all codes from -one to one; and of each pair
// of them whose codes stand for the same numbers, on how many inputs they give different codes. Other profiles have no
// errors of operations to count; reports where there is none left. A unit is one kind of operation of a profile or
// pair.
//
// An error is a result's code / one minus the exact value, which is clamped where the extension clamps.
//
// Rows of the table "rows", one for each operation and form of a profile:
//   profile
//   operation, form          "mapping", "product", "dot product", …; the mapping, or the output's scale and bias
//   cases, exact, distinct   inputs, each counted once; those without an error; different codes that come out
//   max_error, mean_error    the largest size of an error, and the mean one
//   mean_bias                the mean error with its sign
//   worst, worst_code, worst_exact   the first inputs with the largest error, as codes; what comes out; what should
//
// Rows of the table "differences": first, second (the profiles), operation, form, cases, differ (inputs with different
// codes).
[[nodiscard]] Result<std::unique_ptr<Study>> datapath_study(StudyQuestion question,
                                                            std::span<const HardwareProfile> profiles);

}  // namespace ninebit
