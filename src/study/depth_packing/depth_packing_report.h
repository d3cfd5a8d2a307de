// The report of the depth-packing study.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "ninebit/study/depth_packing_error.h"
#include "ninebit/study/report.h"

namespace ninebit {

inline constexpr std::string_view kSecondDigitTable = "second_digit";
inline constexpr int kChartDigit = 128;  // the highest digit in that table, as in the text that first showed it

[[nodiscard]] StudyReport depth_packing_report(const DepthPackingOptions& options, std::span<const StudyRow> rows);

// The plots and heat maps of the depth-packing study.

// The errors of a packing and storage at all depths of two digits, in steps of the second digit.
struct DigitGrid {
  const DepthPacking* packing;
  ChannelStorage storage;
  std::vector<float> shift;  // [highest][second]
  float largest = 0.0F;      // largest absolute shift

  // False for a packing whose digits are in the wrong order: it loses the depth, and would dwarf the others in a plot.
  [[nodiscard]] bool keeps_depth() const { return largest < 4096.0F; }
  [[nodiscard]] std::string name() const { return fmt::format("{}-{}", packing->name, name_of(storage)); }
};

// One for each packing and storage of the options.
[[nodiscard]] std::vector<DigitGrid> digit_grids(const DepthPackingOptions& options);

// The error by depth for each storage, the error around the middle of the range, and the shift of the second digit.
[[nodiscard]] std::vector<Plot> depth_packing_plots(const DepthPackingOptions& options,
                                                    const std::vector<DigitGrid>& grids);

// The shift by both digits for each packing that shifts by a step or more.
[[nodiscard]] std::vector<HeatMap> depth_packing_maps(const std::vector<DigitGrid>& grids);

}  // namespace ninebit
