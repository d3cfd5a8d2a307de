// The report of a program's error study.
#pragma once

#include <cstddef>
#include <span>

#include "ninebit/combiner/program.h"
#include "ninebit/study/report.h"
#include "src/study/datapath/program_inputs.h"

namespace ninebit {

// The report on the rows of `done` of `units` units. If the fragments are all combinations of two components, it
// includes a map of the error with one pixel per fragment.
[[nodiscard]] StudyReport program_report(const Program& program, const Fragments& fragments,
                                         std::span<const StudyRow> rows, std::size_t done, std::size_t units);

}  // namespace ninebit
