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

// The rows of the index-steps study, put in order, and their plots.

// The rows of one profile, format and variant, by step.
struct IndexLadder {
  std::string profile, variant;
  StudyFormat format = StudyFormat::channel;
  std::vector<IndexStepRow> steps;

  // The smallest safe step, and the largest step with a false match; nullptr if there is none.
  [[nodiscard]] const IndexStepRow* safe() const;
  [[nodiscard]] const IndexStepRow* lossy() const;
};

[[nodiscard]] std::vector<IndexLadder> index_ladders(std::span<const StudyRow> rows);

// The share of the pairs that are false matches.
[[nodiscard]] double false_share(const FalseMatches& count);

// Adds, for each format, a plot of the first variant with a line for each profile, and one of the first profile with a
// line for each variant; one line alone if there are no others. Formats with the same lines share a plot.
void add_ladder_plots(const IndexStepsOptions& options, const std::vector<IndexLadder>& ladders, StudyReport& report);

}  // namespace ninebit
