// The report of the datapath study: sentences, tables, plots and maps.
#pragma once

#include <span>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/report.h"

namespace ninebit {

// The report on the rows of `done` of `units` units.
[[nodiscard]] StudyReport datapath_report(std::span<const HardwareProfile> profiles, std::span<const StudyRow> rows,
                                          std::size_t done, std::size_t units);

// Maps with one pixel per case, for operations of two inputs: the errors of one profile (geforce2 if present), and the
// cases in which each pair of profiles with the same `one` differs. Empty maps are left out.
[[nodiscard]] std::vector<HeatMap> datapath_maps(std::span<const HardwareProfile> profiles);

// A value for a sentence: avoids printing -0.000.
[[nodiscard]] inline double plain(double value) {
  return value > -0.0005 && value < 0.0005 ? 0.0 : value;
}

// `part` in percent of `whole`; 0 if both are 0.
[[nodiscard]] double percent(std::uint64_t part, std::uint64_t whole);

}  // namespace ninebit
