// The report of the depth-packing study.
#pragma once

#include <span>

#include "ninebit/study/depth_packing_error.h"

namespace ninebit {

inline constexpr std::string_view kSecondDigitTable = "second_digit";
inline constexpr int kChartDigit = 128;  // the highest digit in that table, as in the text that first showed it

[[nodiscard]] StudyReport depth_packing_report(const DepthPackingOptions& options, std::span<const StudyRow> rows);

}  // namespace ninebit
