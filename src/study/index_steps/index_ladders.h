// The rows of the index-steps study, put in order, and their plots.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ninebit/study/index_steps.h"
#include "ninebit/study/report.h"

namespace ninebit {

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
