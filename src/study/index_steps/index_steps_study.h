// What the parts of the study of index steps share.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/study/index_steps.h"
#include "ninebit/study/report.h"

namespace ninebit {

// What one unit counts.
struct IndexStepsUnit {
  std::size_t profile = 0;  // of the options' profiles
  StudyFormat format = StudyFormat::channel;
  std::string variant;
  bool separate = false;
  Program program;
};

[[nodiscard]] StudyRow study_row(const IndexStepRow& row);
[[nodiscard]] IndexStepRow index_step_row(const StudyRow& row);

// The report on all rows: answers, tables and plots from the rows, pictures of what becomes of one channel's
// differences from the units' programs.
[[nodiscard]] StudyReport index_steps_report(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units,
                                             std::span<const StudyRow> rows);

// Heat maps and plots of one channel: which alpha a pair of values gives, and which differences come out equal at which
// step.
void add_channel_pictures(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units, StudyReport& report);

}  // namespace ninebit
