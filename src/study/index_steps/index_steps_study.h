// Declarations shared by the files of the index-steps study.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/study/index_steps.h"
#include "ninebit/study/report.h"

namespace ninebit {

// The work of one unit.
struct IndexStepsUnit {
  std::size_t profile = 0;  // index into the options' profiles
  StudyFormat format = StudyFormat::channel;
  std::string variant;
  bool separate = false;
  Program program;
};

[[nodiscard]] StudyRow study_row(const IndexStepRow& row);
[[nodiscard]] IndexStepRow index_step_row(const StudyRow& row);

// The report on all rows: answers, tables and plots from the rows; pictures of one channel's differences from the
// units' programs.
[[nodiscard]] StudyReport index_steps_report(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units,
                                             std::span<const StudyRow> rows);

// Adds heat maps and plots of one channel: the alpha of each pair of values, and each step's differences that compare
// equal.
void add_channel_pictures(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units, StudyReport& report);

}  // namespace ninebit
