// What people see of a sweep of shadows.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ninebit/study/report.h"
#include "src/study/part/sweep_axes.h"

namespace ninebit {

// The rows with the fewest and with the most wrong pixels, the first of several; nullptr where nothing was drawn.
[[nodiscard]] const StudyRow* best_row(std::span<const StudyRow> rows);
[[nodiscard]] const StudyRow* worst_row(std::span<const StudyRow> rows);

// The rows of a sweep that were drawn, at least one, and which of their columns the sweep changed.
struct SweepView {
  std::vector<const StudyRow*> rows;
  std::vector<std::string> columns;  // with two values at least
  std::vector<std::string> causes;
  const StudyRow* best;

  [[nodiscard]] bool changes(std::string_view column) const;
  // The row's values in the changed columns that are not left out: "map_size 512, index_step 2".
  [[nodiscard]] std::string label(const StudyRow& row, std::span<const std::string> left_out = {}) const;
  // The rows that differ from this one in these columns at most.
  [[nodiscard]] std::vector<const StudyRow*> beside(const StudyRow& row, std::span<const std::string> columns) const;
};

// A plot of wrong pixels for each numeric column that the sweep changed, with a series for each combination of the
// others, and one of their causes beside the best row.
[[nodiscard]] std::vector<Plot> sweep_plots(const SweepView& view);

// Wrong pixels by factor and units beside the best row; none where the sweep has not every combination of several.
[[nodiscard]] std::vector<HeatMap> offset_maps(const SweepView& view);

extern const std::vector<std::string> kOffsetColumns;

// All but the pictures. At least one row was drawn.
[[nodiscard]] StudyReport shadow_sweep_report(const SweptSettings& known, std::span<const SweepAxis> axes,
                                              std::span<const StudyRow> rows, std::size_t done, std::size_t units);

}  // namespace ninebit
